// A colour map: its name, file or points, its colours with the field's histogram, its range, and colours beside it.
import {choice, number, placed, row} from "./controls.js";
import {colorScale} from "./color_scale.js";
import {keysBut, objectRows} from "./schema_rows.js";

/** @typedef {Record<string, any>} Json */

const own = "own points", ofFile = "file";
/** Of a map that is taken as points to begin with. */
const nFirstPoints = 5;

/** @param {import("./schema_rows.js").Entry} entry */
export function colorMapRows({place, label, node, value, part, put, context}) {
  /** @type {Json} */
  const map = value ?? {};
  const {name, points, file, space, ...rest} = map;
  const kind = points ? own : file ? ofFile : name ?? "";
  const field = part.color_field ?? part.field ?? context.sceneField;
  const choose = row("colours", choice("Colour map", ["", ...node.properties.name.enum, own], kind, async (word) => {
    if (word === own) {
      const shown = await context.histograms.palette(value ? map : context.scene.color_map ?? {});
      put({...rest, points: evenly(shown)});
    } else if (word !== ofFile) {
      put(word ? {...rest, name: word} : null);
    }
  }));
  // The scene has colours, whatever it says.
  return value === undefined && place !== "/color_map" ? [choose] : [
    choose,
    ...colorScale(place, map, field, context),
    placed(`${place}/range`, row("range", ...rangeInputs(place, map, context))),
    ...objectRows(place, map, node, context, points ? ["points", "space"] : ["file"], `${label} `),
    ...objectRows(place, map, node, context, keysBut(node, "name", "points", "file", "space", "range"), `${label} `),
  ];
}

/**
 * Points at equal distances.
 * @param {number[][]} palette
 */
function evenly(palette) {
  return Array.from({length: nFirstPoints}, (_, i) => {
    const at = i / (nFirstPoints - 1);
    const behind = Math.max(1, palette.findIndex((point) => point[0] >= at));
    const [from, to] = [palette[behind - 1], palette[Math.min(behind, palette.length - 1)]];
    const share = to[0] > from[0] ? (at - from[0]) / (to[0] - from[0]) : 0;
    return [at, ...[1, 2, 3].map((c) => Number((from[c] + share * (to[c] - from[c])).toPrecision(4)))];
  });
}

/**
 * Both ends, or none.
 * @param {string} place @param {Json} map @param {import("./editor.js").Context} context
 */
function rangeInputs(place, map, {set}) {
  const change = () => {
    const [low, high] = inputs.map((input) => (input.value === "" ? null : Number(input.value)));
    if ((low === null) === (high === null)) {
      set(`${place}/range`, low === null ? null : [low, high], "range");
    }
  };
  const inputs = ["Lower", "Upper"].map((name, i) => number(`${name} end of the range`, map.range?.[i] ?? null, change));
  return inputs;
}
