// Panels for the scene and the item that is selected. They show what the scene says, and send places with new values.
import {check, choice, colorRow, element, number, numbers, row, slider, text} from "./controls.js";
import {annotationRows} from "./annotation_editor.js";
import {colorScale} from "./color_scale.js";
import {lightingRows, lightRows} from "./light_editor.js";
import {transferEditor} from "./transfer.js";

/** @typedef {Record<string, any>} Json */
/** @typedef {(pointer: string, value: any, name: string, isDone?: boolean) => void} Set */
/**
 * What panels know and do. `release` ends a movement of the hand.
 * @typedef {{scene: Json, volume: Json, set: Set, release: () => void, histograms: ReturnType<typeof import("./histograms.js").makeHistograms>}} Context
 */

const maps = ["", "viridis", "magma", "inferno", "plasma", "cividis", "coolwarm", "gray"];

/** @param {Context} context @returns {string} */
export const sceneField = ({scene, volume}) => scene.field ?? volume.fields[0]?.name ?? "";

/**
 * Rows for a colour map at a place.
 * @param {string} place @param {Json | undefined} map @param {string} field @param {Context} context
 */
function mapRows(place, map, field, context) {
  const {set} = context;
  const range = map?.range ?? [null, null];
  const setRange = (/** @type {any[]} */ ends) => {
    if (ends[0] === null && ends[1] === null) {
      set(`${place}/color_map/range`, null, "range");
    } else if (ends[0] !== null && ends[1] !== null) {
      set(`${place}/color_map/range`, ends, "range");
    }
  };
  const low = number("Lower end of the range", range[0], (value) => setRange([value, high.value === "" ? null : Number(high.value)]));
  const high = number("Upper end of the range", range[1], (value) => setRange([low.value === "" ? null : Number(low.value), value]));
  low.placeholder = high.placeholder = "auto";
  const shown = map?.points || map?.file ? "own" : map?.name ?? "";
  const isOwn = place === "" || map !== undefined;
  return [
    row("Colours", choice("Colour map", maps, shown, (name) => set(`${place}/color_map`, name ? {...(map?.range ? {range: map.range} : {}), name} : null, "colour map"))),
    ...(isOwn ? colorScale(place, map ?? {}, field, context) : []),
    row("Range", low, high),
    row("", check("logarithmic", map?.scale === "logarithmic", (is) => set(`${place}/color_map/scale`, is ? "logarithmic" : null, "scale"))),
  ];
}

/** @param {HTMLElement} parent @param {Context} context */
export function showScene(parent, context) {
  const {scene, volume, set} = context;
  const names = element("datalist", {id: "fields"}, volume.fields.map((/** @type {Json} */ field) => element("option", {value: field.name})));
  const field = sceneField(context);
  parent.replaceChildren(
    names,
    row("Field", text("Field or expression", field, (value) => set("/field", value || null, "field"), "fields")),
    ...mapRows("", scene.color_map, field, context),
    row("", check("contours", Boolean(scene.contours), (is) => set("/contours", is ? {} : null, "contours"))),
    row("", check("mesh lines", Boolean(scene.mesh_lines), (is) => set("/mesh_lines", is ? {} : null, "mesh lines"))),
    ...lightingRows(context),
    ...annotationRows(context),
    colorRow("Background", (scene.image?.background ?? [1, 1, 1]).slice(0, 3), (rgb) => set("/image/background", [...rgb, scene.image?.background?.[3] ?? 1], "background")),
  );
}

/**
 * Along its normal.
 * @param {string} place @param {Json} surface @param {Json} volume @param {Set} set
 */
function planeRows(place, surface, volume, set) {
  const plane = surface.plane ?? planeThrough(surface);
  const normal = plane.slice(0, 3);
  const length = Math.hypot(...normal);
  const [ax, ay, az, bx, by, bz] = volume.bounds;
  const corners = [ax, bx].flatMap((x) => [ay, by].flatMap((y) => [az, bz].map((z) => x * normal[0] + y * normal[1] + z * normal[2])));
  /** @type {[number, number]} */
  const ends = [Math.min(...corners) / length, Math.max(...corners) / length];
  const put = (/** @type {number[]} */ values, /** @type {boolean} */ isDone) => {
    const {point, normal: own, ...rest} = surface;
    set(place, {...rest, plane: values}, "plane", isDone);
  };
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const buttons = ["x", "y", "z"].map((name, i) => {
    const button = /** @type {HTMLButtonElement} */ (element("button", {"aria-label": `Across ${name}`}, [name]));
    button.onclick = () => put([...axes[i], -(volume.bounds[i] + volume.bounds[i + 3]) / 2], true);
    return button;
  });
  return [
    row("Position", slider("Position of the plane", ends, -plane[3] / length, (at, isDone) => put([...normal, -at * length], isDone))),
    row("Across", ...buttons),
    row("Plane", text("a, b, c, d of the plane a x + b y + c z + d = 0", plane.map((/** @type {number} */ x) => Number(x.toPrecision(6))).join(", "), (words) => {
      const values = numbers(words);
      if (values?.length === 4) {
        put(values, true);
      }
    })),
  ];
}

/** @param {Json} surface */
function planeThrough(surface) {
  const [n, p] = [surface.normal ?? [0, 0, 1], surface.point ?? [0, 0, 0]];
  return [...n, -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2])];
}

/** @param {string} place @param {Json} surface @param {Json} volume @param {Set} set */
function shapeRows(place, surface, volume, set) {
  if (surface.type === "plane") {
    return planeRows(place, surface, volume, set);
  }
  if (surface.type === "isosurface") {
    return [row("Values", text("Values of the isosurfaces", surface.values.join(", "), (words) => set(`${place}/values`, numbers(words), "values")))];
  }
  const rows = [];
  for (const key of ["radius", "major_radius", "minor_radius", "from_radius", "to_radius"]) {
    if (key in surface) {
      rows.push(row(key.replace("_", " "), number(key.replace("_", " "), surface[key], (value) => set(`${place}/${key}`, value, key))));
    }
  }
  for (const key of ["center", "axis", "from", "to", "expression", "flow"]) {
    if (key in surface) {
      const isText = typeof surface[key] === "string";
      rows.push(row(key, text(key, isText ? surface[key] : surface[key].join(", "), (words) => set(`${place}/${key}`, isText ? words : numbers(words), key))));
    }
  }
  return rows;
}

/** @param {HTMLElement} parent @param {Json} item @param {Context} context */
export function showItem(parent, item, context) {
  const {scene, volume, set} = context;
  const place = item.pointer;
  if (item.kind === "volume") {
    const own = scene.volume_rendering ?? {};
    const field = own.field ?? sceneField(context);
    parent.replaceChildren(
      row("Field", text("Field of the volume", own.field ?? "", (value) => set(`${place}/field`, value || null, "field"), "fields")),
      ...transferEditor(own, field, context),
      ...mapRows(place, own.color_map, field, context));
    return;
  }
  if (item.kind !== "surface") {
    parent.replaceChildren(...lightRows(place, scene.lighting?.lights?.[Number(place.split("/").pop())] ?? {}, context));
    return;
  }
  const surface = scene.surfaces?.[item.index] ?? {};
  const key = surface.type === "isosurface" ? "color_field" : "field";
  parent.replaceChildren(
    ...shapeRows(place, surface, volume, set),
    row("Opacity", slider("Opacity", [0, 1], surface.opacity ?? 1, (value, isDone) => set(`${place}/opacity`, value, "opacity", isDone))),
    row("Field", text("Field of the item", surface[key] ?? "", (value) => set(`${place}/${key}`, value || null, "field"), "fields")),
    ...mapRows(place, surface.color_map, surface[key] ?? surface.field ?? sceneField(context), context),
    row("", check("contours", Boolean(surface.contours), (is) => set(`${place}/contours`, is ? {} : null, "contours"))),
    row("", check("mesh lines", Boolean(surface.mesh_lines), (is) => set(`${place}/mesh_lines`, is ? {} : null, "mesh lines"))),
    row("", check("light", surface.lighting !== false, (is) => set(`${place}/lighting`, is, "light"))));
}

/** @param {Json} picked */
export function pickedTable(picked) {
  if (!picked.hit) {
    return element("p", {}, ["Nothing is there."]);
  }
  const lines = (/** @type {any} */ value) => (Array.isArray(value) ? value.map((x) => element("div", {}, [String(x)])) : [String(value ?? "unknown")]);
  const rows = [["element", picked.element], ["xi", picked.xi], ["position", picked.position]];
  if (picked.also?.length) {
    rows.push(["also in", picked.also.join(", ")]);
  }
  for (const field of picked.fields) {
    rows.push([`${field.name}${field.unit ? ` (${field.unit})` : ""}`, field.values]);
    rows.push([`grad ${field.name}`, field.gradients]);
  }
  rows.push(["Jacobian", picked.jacobian], ["order", picked.order]);
  const body = rows.map(([name, value]) => element("tr", {}, [element("th", {scope: "row"}, [name]), element("td", {}, lines(value))]));
  const table = element("table", {}, body);
  return picked.remark ? element("div", {}, [table, element("p", {}, [picked.remark])]) : table;
}
