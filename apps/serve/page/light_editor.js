// Light: what comes from everywhere and from the eye, highlights, and single lights.
import {check, colorRow, number, row, slider} from "./controls.js";

/** @typedef {Record<string, any>} Json */
/** @typedef {import("./editor.js").Context} Context */

/** What "default" means. */
const usual = {ambient: [0.3, 0.3, 0.3], headlight: [0.7, 0.7, 0.7], specular: 0, exponent: 30};

/** @param {Context} context */
export function lightingRows({scene, set}) {
  const isLit = Boolean(scene.lighting) && scene.lighting !== "none";
  const own = {...usual, ...(scene.lighting instanceof Object ? scene.lighting : {})};
  const put = (/** @type {string} */ key, /** @type {any} */ value, isDone = true) =>
    set("/lighting", {...(scene.lighting instanceof Object ? scene.lighting : {}), [key]: value}, key, isDone);
  return [
    row("", check("light", isLit, (is) => set("/lighting", is ? "default" : null, "light"))),
    ...(isLit ? [
      colorRow("Ambient", own.ambient, (rgb) => put("ambient", rgb)),
      colorRow("Headlight", own.headlight, (rgb) => put("headlight", rgb)),
      row("Highlights", slider("Strength of highlights", [0, 1], own.specular, (value, isDone) => put("specular", value, isDone))),
      row("Sharpness", slider("Sharpness of highlights", [1, 200], own.exponent, (value, isDone) => put("exponent", value, isDone))),
    ] : []),
  ];
}

/** @param {string} place @param {Json} light @param {Context} context */
export function lightRows(place, light, {set}) {
  const key = light.type === "point" ? "position" : "direction";
  const vector = light[key] ?? [0, 0, -1];
  const put = (/** @type {number[]} */ value) => {
    if (key === "position" || value.some((x) => x !== 0)) {
      set(`${place}/${key}`, value, key);
    }
  };
  return [
    row(key === "position" ? "Position" : "Direction", ...["x", "y", "z"].map((name, i) => number(`${key} ${name}`, Number(vector[i].toPrecision(9)), (value) => {
      if (value !== null) {
        put(vector.map((/** @type {number} */ old, /** @type {number} */ j) => (i === j ? value : old)));
      }
    }))),
    colorRow("Colour", light.color ?? [1, 1, 1], (rgb) => set(`${place}/color`, rgb, "colour")),
  ];
}
