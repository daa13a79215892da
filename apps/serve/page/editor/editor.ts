// Panels for the scene and the item that is selected. They show what the scene says, and send places with new values.
import type {Context} from "./context.js";
import {element} from "../controls.js";
import type {Item} from "../messages.js";
import {formats, objectNode, offers, schema} from "./schema.js";
import {keysBut, objectRows} from "./schema_rows.js";
import {transferEditor} from "./transfer.js";

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

const imageKeys = objectNode(keys.image), densityKeys = objectNode(keys.volume_rendering), cameraKeys = objectNode(keys.camera);
const lightKeys = objectNode(objectNode(keys.lighting).properties.lights.items);
const surfaceKeys = objectNode(keys.surfaces.items);
/** Wires have no lines on them, and are not lit by themselves. */
const wireKeys = {...surfaceKeys, properties: {...surfaceKeys.properties, lighting: {...surfaceKeys.properties.lighting, default: false}}};

export function showScene(context: Context) {
  const {scene} = context;
  for (const [id, names] of Object.entries(panels)) {
    document.getElementById(id)?.replaceChildren(...objectRows("", scene, schema, context, names));
  }
  document.getElementById("picture-editor")?.append(
    ...objectRows("/image", scene.image ?? {}, imageKeys, context, keysBut(imageKeys, "size")),
    ...objectRows("", scene, schema, context, keysBut(schema, ...elsewhere, ...Object.values(panels).flat())));
  document.getElementById("offers")?.replaceChildren(...formats.map((format) =>
    element("datalist", {id: `${format}s`}, offers(format, context).map((name) => element("option", {value: name})))));
}

export function showCamera(context: Context) {
  document.getElementById("camera-editor")?.replaceChildren(...objectRows("/camera", context.scene.camera ?? {}, cameraKeys, context, undefined, "camera "));
}

export function itemRows(item: Item, context: Context): Element[] {
  const {scene} = context;
  const place = item.pointer;
  const index = Number(place.split("/").pop());
  if (item.kind === "volume") {
    const own = scene.volume_rendering ?? {};
    return [
      ...objectRows(place, own, densityKeys, context, ["field"]),
      ...(own.transfer ? [] : transferEditor(own, own.field ?? context.sceneField, context)),
      ...objectRows(place, own, densityKeys, context, keysBut(densityKeys, "field", "peaks", own.opacity ? "" : "unit_distance"))];
  }
  if (item.kind === "light") {
    return objectRows(place, scene.lighting?.lights?.[index] ?? {}, lightKeys, context);
  }
  const surface = scene.surfaces?.[index];
  const isWire = surface?.type === "wireframe";
  return objectRows(place, surface ?? {}, isWire ? wireKeys : surfaceKeys, context, keysBut(surfaceKeys, ...(isWire ? ["contours", "mesh_lines"] : [])));
}
