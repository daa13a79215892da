// Panels for the scene and the item that is selected. They show what the scene says, and send places with new values.
import {colorControls, element, row} from "./controls.js";
import {formats, offers, resolved, schema} from "./schema.js";
import {keysBut, objectRows} from "./schema_rows.js";
import {transferEditor} from "./transfer.js";

/** @typedef {Record<string, any>} Json */
/** @typedef {(pointer: string, value: any, name: string, isDone?: boolean) => void} Set */
/**
 * What panels know and do. `release` ends a movement of the hand; `refuse` says what is wrong with what was typed; `picked` is the
 * point that was clicked at last.
 * @typedef {{scene: Json, volume: Json, sceneField: string, set: Set, release: () => void, refuse: (text: string) => void,
 *            picked: () => number[] | null, histograms: ReturnType<typeof import("./histograms.js").makeHistograms>}} Context
 */

const keys = schema.properties;
/** Keys of the scene by the panel that has them. */
const panels = {
  "volume-editor": ["threshold", "warp", "volumes"],
  "color-editor": ["field", "color_map", "contours", "mesh_lines"],
  "picture-editor": ["lighting", "precision", "subdivisions"],
};

/** @param {Context} context */
export function showScene(context) {
  const {scene, set} = context;
  for (const [id, names] of Object.entries(panels)) {
    document.getElementById(id)?.replaceChildren(...objectRows("", scene, schema, context, names));
  }
  const background = scene.image?.background ?? [1, 1, 1, 1];
  document.getElementById("picture-editor")?.append(
    ...objectRows("/image", scene.image ?? {}, keys.image, context, ["samples", "annotation"]),
    row("background", ...colorControls("Background", background.slice(0, 3), (rgb) => set("/image/background", [...rgb, background[3] ?? 1], "background"))));
  document.getElementById("offers")?.replaceChildren(...formats.map((format) =>
    element("datalist", {id: `${format}s`}, offers(format, context).map((name) => element("option", {value: name})))));
}

/** @param {HTMLElement} parent @param {Json} item @param {Context} context */
export function showItem(parent, item, context) {
  const {scene} = context;
  const place = item.pointer;
  const index = Number(place.split("/").pop());
  if (item.kind === "volume") {
    const own = scene.volume_rendering ?? {};
    parent.replaceChildren(
      ...objectRows(place, own, keys.volume_rendering, context, ["field"]),
      ...transferEditor(own, own.field ?? context.sceneField, context),
      ...objectRows(place, own, keys.volume_rendering, context,
        keysBut(keys.volume_rendering, "field", "transfer", "density", "opacity", "peaks", own.opacity ? "" : "unit_distance")));
  } else if (item.kind === "light") {
    parent.replaceChildren(...objectRows(place, scene.lighting?.lights?.[index] ?? {}, resolved(keys.lighting).properties.lights.items, context));
  } else {
    const surface = scene.surfaces?.[index] ?? {};
    // Wires have a colour alone.
    const but = surface.type === "wireframe" ? ["field", "color_map", "contours", "mesh_lines", "lighting"] : [];
    parent.replaceChildren(...objectRows(place, surface, keys.surfaces.items, context, keysBut(keys.surfaces.items, ...but)));
  }
}
