// What is written on the picture.
import {check, choice, colorRow, row, slider, text} from "./controls.js";

/** @typedef {import("./editor.js").Context} Context */

/** @param {Context} context */
export function annotationRows({scene, set}) {
  const annotation = scene.image?.annotation;
  const isThere = Boolean(annotation) && annotation !== "none";
  const own = annotation instanceof Object ? annotation : {};
  const put = (/** @type {string} */ key, /** @type {any} */ value, isDone = true) => {
    const {[key]: _, ...rest} = own;
    set("/image/annotation", value === null ? rest : {...rest, [key]: value}, `annotation ${key}`, isDone);
  };
  return [
    row("", check("annotation", isThere, (is) => set("/image/annotation", is ? "default" : "none", "annotation"))),
    ...(isThere ? [
      row("Title", text("Title of the picture", own.title ?? "", (value) => put("title", value))),
      row("", check("the volume's name as title", own.title === undefined, (is) => put("title", is ? null : ""))),
      row("", check("axes", own.axes !== false, (is) => put("axes", is)), check("colour bars", own.color_bars !== false, (is) => put("color_bars", is))),
      row("Bars at the", choice("Side of the colour bars", ["left", "right"], own.bar_side ?? "right", (side) => put("bar_side", side))),
      row("Text size", slider("Text size", [0.01, 0.1], own.text_size ?? 0.026, (value, isDone) => put("text_size", value, isDone))),
      row("", check("own text colour", Boolean(own.color), (is) => put("color", is ? [0, 0, 0] : null))),
      ...(own.color ? [colorRow("Text colour", own.color, (rgb) => put("color", rgb))] : []),
    ] : []),
  ];
}
