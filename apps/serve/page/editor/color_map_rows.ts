// A colour map: its name, file or points, its colours with the field's histogram, its range, and colours beside it.
import {colorScale} from "./color_scale.js";
import type {Context} from "./context.js";
import {choice, number, placed, row} from "../controls.js";
import type {Entry} from "./entry.js";
import type {ColorMap} from "../scene.js";
import {colorAt} from "./palette.js";
import {objectNode} from "./schema.js";
import {keysBut, objectRows} from "./schema_rows.js";

const own = "own points", ofFile = "file";
/** Of a map that is taken as points to begin with. */
const nFirstPoints = 5;

export function colorMapRows({place, label, node, value, part, put, context}: Entry): Element[] {
  const map = (value ?? {}) as ColorMap;
  const {name, points, file, space: _space, ...rest} = map;
  const keys = objectNode(node);
  const kind = points ? own : file ? ofFile : name ?? "";
  const field = String(part.color_field ?? part.field ?? context.sceneField);
  const choose = row("colours", choice("Colour map", ["", ...(keys.properties.name.enum ?? []), own], kind, async (word) => {
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
    ...objectRows(place, map, keys, context, points ? ["points", "space"] : ["file"], `${label} `),
    ...objectRows(place, map, keys, context, keysBut(keys, "name", "points", "file", "space", "range"), `${label} `),
  ];
}

/** Points at equal distances. */
function evenly(palette: number[][]): number[][] {
  return Array.from({length: nFirstPoints}, (_, i) => {
    const at = i / (nFirstPoints - 1);
    return [at, ...colorAt(palette, at).map((part) => Number(part.toPrecision(4)))];
  });
}

/** Both ends, or none. */
function rangeInputs(place: string, map: ColorMap, {set}: Context): HTMLInputElement[] {
  const change = () => {
    const [low, high] = inputs.map((input) => (input.value === "" ? null : Number(input.value)));
    if ((low === null) === (high === null)) {
      set(`${place}/range`, low === null ? null : [low, high], "range");
    }
  };
  const inputs = ["Lower", "Upper"].map((name, i) => number(`${name} end of the range`, map.range?.[i] ?? null, change));
  return inputs;
}
