// Panels for the scene and the item that is selected. They show what the scene says, and send places with new values.
import {element} from "./controls.js";
import {formats, offers, resolved, schema} from "./schema.js";
import {keysBut, objectRows} from "./schema_rows.js";
import {transferEditor} from "./transfer.js";

/** @typedef {Record<string, any>} Json */
/** @typedef {(pointer: string, value: any, name: string, isDone?: boolean) => void} Set */
/**
 * What panels know and do. `check` raises what is wrong with a value at a place; `release` ends a movement of the hand; `refuse`
 * says what is wrong with what was typed; `picked` is the point that was clicked at last; `begin` makes objects of a kind, and
 * `more` lists of a name with an entry more, where the schema does not say enough.
 * @typedef {{scene: Json, volume: Json, sceneField: string, set: Set, check: (pointer: string, value: any) => Promise<any>,
 *            release: () => void, refuse: (text: string) => void, picked: () => number[] | null,
 *            begin: Record<string, () => Promise<Json>>, more: Record<string, (all: any[]) => any[]>,
 *            histograms: ReturnType<typeof import("./histograms.js").makeHistograms>}} Context
 */

const keys = schema.properties;
/** Keys of the scene by the panel that has them. */
const panels = {
  "volume-editor": ["threshold", "warp", "volumes"],
  "color-editor": ["field", "color_map", "contours", "mesh_lines", "lic"],
  "picture-editor": ["lighting", "precision", "subdivisions"],
  "animation-editor": ["animation"],
};
/** Items, views, the camera and the picture have theirs; the volume is the server's. */
const elsewhere = ["version", "volume", "camera", "views", "image", "isosurfaces", "volume_rendering", "surfaces"];

/** @param {Context} context */
export function showScene(context) {
  const {scene} = context;
  for (const [id, names] of Object.entries(panels)) {
    document.getElementById(id)?.replaceChildren(...objectRows("", scene, schema, context, names));
  }
  document.getElementById("picture-editor")?.append(
    ...objectRows("/image", scene.image ?? {}, keys.image, context, keysBut(keys.image, "size")),
    ...objectRows("", scene, schema, context, keysBut(schema, ...elsewhere, ...Object.values(panels).flat())));
  document.getElementById("offers")?.replaceChildren(...formats.map((format) =>
    element("datalist", {id: `${format}s`}, offers(format, context).map((name) => element("option", {value: name})))));
}

/** @param {Context} context */
export function showCamera(context) {
  const camera = resolved(keys.camera);
  document.getElementById("camera-editor")?.replaceChildren(...objectRows("/camera", context.scene.camera ?? {}, camera, context, undefined, "camera "));
}

/** @param {HTMLElement} parent @param {Json} item @param {Context} context */
export function showItem(parent, item, context) {
  const {scene} = context;
  const place = item.pointer;
  const index = Number(place.split("/").pop());
  if (item.kind === "volume") {
    const own = scene.volume_rendering ?? {};
    const graph = own.transfer ? [] : transferEditor(own, own.field ?? context.sceneField, context);
    parent.replaceChildren(
      ...objectRows(place, own, keys.volume_rendering, context, ["field"]),
      ...graph,
      ...objectRows(place, own, keys.volume_rendering, context, keysBut(keys.volume_rendering, "field", "peaks", own.opacity ? "" : "unit_distance")));
  } else if (item.kind === "light") {
    parent.replaceChildren(...objectRows(place, scene.lighting?.lights?.[index] ?? {}, resolved(keys.lighting).properties.lights.items, context));
  } else {
    const surface = scene.surfaces?.[index] ?? {};
    const isWire = surface.type === "wireframe";
    // Wires have no lines on them, and are not lit by themselves.
    const but = isWire ? ["contours", "mesh_lines"] : [];
    parent.replaceChildren(...objectRows(place, surface, isWire ? unlit : keys.surfaces.items, context, keysBut(keys.surfaces.items, ...but)));
  }
}

const surfaceKeys = keys.surfaces.items;
const unlit = {...surfaceKeys, properties: {...surfaceKeys.properties, lighting: {...surfaceKeys.properties.lighting, default: false}}};
