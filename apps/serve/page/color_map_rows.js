// A colour map: its name, its colours with the field's histogram, its range, and colours beside it.
import {choice, number, row} from "./controls.js";
import {colorScale} from "./color_scale.js";
import {keysBut, objectRows} from "./schema_rows.js";

/** @typedef {Record<string, any>} Json */

/** @param {import("./schema_rows.js").Entry} entry */
export function colorMapRows({place, label, node, value, part, put, context}) {
  /** @type {Json} */
  const map = value ?? {};
  const name = map.points || map.file ? "own" : map.name ?? "";
  const field = part.color_field ?? part.field ?? context.sceneField;
  const choose = row("colours", choice("Colour map", ["", ...node.properties.name.enum], name, (word) => {
    const {name: _, points, file, space, ...rest} = map;
    put(word ? {...rest, name: word} : null);
  }));
  // The scene has colours, whatever it says.
  return value === undefined && place !== "/color_map" ? [choose] : [
    choose,
    ...colorScale(place, map, field, context),
    row("range", ...rangeInputs(place, map, context)),
    ...objectRows(place, map, node, context, keysBut(node, "name", "points", "file", "space", "range"), `${label} `),
  ];
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
