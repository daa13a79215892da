// What the schema says of the keys of a scene: the one by which scene files are read.

/** @typedef {Record<string, any>} Json */

/** @type {Json} */
export const schema = await (await fetch("scene.schema.json")).json();

/**
 * A key's node with what it refers to, whose name is its `kind`; of alternatives the one with keys.
 * @param {Json} node @returns {Json}
 */
export function resolved(node) {
  const kind = node.$ref?.split("/").pop();
  const whole = kind ? {...schema.$defs[kind], ...node, kind} : node;
  const object = whole.anyOf?.map(resolved).find((/** @type {Json} */ one) => one.properties);
  const mayBeText = whole.anyOf?.some((/** @type {Json} */ one) => one.type === "string");
  return object ? {...object, description: whole.description, mayBeText} : whole;
}

/**
 * Whether a key means something beside the values of others.
 * @param {Json} node of the object @param {string} key @param {Json} part the object
 */
export const isMeaningful = (node, key, part) => Object.entries(node.properties[key].with ?? {}).every(
  ([other, values]) => values.includes(part[other] ?? node.properties[other].default));

/**
 * An object with another value under a key, without what means nothing beside it; null removes.
 * @param {Json} node of the object @param {Json} part @param {string} key @param {any} value
 */
export function withValue(node, part, key, value) {
  const next = {...part, [key]: value};
  /** @param {string} one @param {string} other */
  const excludes = (one, other) => node.properties[one].excludes?.includes(other);
  const stays = (/** @type {string} */ other) => (value === null ? other !== key : !excludes(key, other) && !excludes(other, key));
  return Object.fromEntries(Object.entries(next).filter(([other]) => stays(other) && isMeaningful(node, other, next)));
}

/**
 * Something to begin with.
 * @param {Json} node @param {import("./editor.js").Context} context @returns {any}
 */
export function start(node, context) {
  const whole = resolved(node);
  const b = context.volume.bounds;
  const middle = [0, 1, 2].map((i) => (b[i] + b[i + 3]) / 2);
  /** @type {Json} */
  const kinds = {plane: [1, 0, 0, -middle[0]], vector: context.picked() ?? middle, color: [0.5, 0.5, 0.5]};
  if (whole.properties) {
    return Object.fromEntries((whole.required ?? []).map((/** @type {string} */ key) => [key, start(whole.properties[key], context)]));
  }
  if (whole.type === "array") {
    return kinds[whole.kind] ?? Array(whole.minItems ?? 0).fill(whole.items && resolved(whole.items).type === "array" ? start(whole.items, context) : 0.5);
  }
  return whole.default ?? whole.enum?.[0] ?? (whole.type === "string" ? offers(whole.format, context)[0] ?? "text" : whole.minimum ?? 1);
}

/** What texts may be that name something. */
export const formats = ["field", "flow", "displacement", "group", "surface"];

/** @param {string} format @param {import("./editor.js").Context} context @returns {string[]} */
export function offers(format, {scene, volume}) {
  /** @param {Json[]} list */
  const names = (list) => list.map((one) => one.name).filter(Boolean);
  return format === "surface" ? names(scene.surfaces ?? []) : format === "field" ? names(volume.fields) : volume[`${format}s`] ?? [];
}
