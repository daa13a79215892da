// Rows of controls for the keys of an object of the scene, made from its schema.
import {button, check, choice, colorControls, element, number, numbers, placed, row, slider, text} from "./controls.js";
import {colorMapRows} from "./color_map_rows.js";
import {planeRows} from "./plane_rows.js";
import {pointRows} from "./point_rows.js";
import {sceneText} from "./scene_text.js";
import {formats, isMeaningful, resolved, start, withValue} from "./schema.js";

/** @typedef {Record<string, any>} Json */
/** @typedef {import("./editor.js").Context} Context */
/**
 * A value of the scene. `place`: its JSON Pointer; `label`: for screen readers; `part`: the object that holds it; `put` sets
 * another value, null for none; `check` raises what would be wrong with it.
 * @typedef {{place: string, caption: string, label: string, node: Json, value: any, part: Json, context: Context,
 *            put: (value: any, isDone?: boolean) => void, check: (value: any) => Promise<any>}} Entry
 */

/** These have controls of their own, say what others do, or are the server's matter. */
const elsewhere = ["type", "visible", "lights", "point", "normal", "path", "more_paths", "plugin"];

/**
 * @param {string} place of the object @param {Json} part the object @param {Json} node its schema @param {Context} context
 * @param {string[]} [keys] which of its keys @param {string} [label] what comes before their names
 * @returns {Element[]}
 */
export function objectRows(place, part, node, context, keys = Object.keys(node.properties), label = "") {
  const shown = keys.filter((key) => !elsewhere.includes(key) && isMeaningful(node, key, part));
  return shown.flatMap((key) => {
    const caption = key.replaceAll("_", " ").replace("color", "colour");
    /** @param {any} value @returns {[string, any]} what it changes */
    const change = (value) => {
      const next = withValue(node, part, key, value);
      const isAlone = Object.keys(part).every((other) => other === key || other in next);
      return isAlone ? [`${place}/${key}`, value] : [place, next];
    };
    return rowsOf({place: `${place}/${key}`, caption, label: label + caption, node: resolved(node.properties[key]), value: part[key], part, context,
      put: (value, isDone = true) => context.set(...change(value), caption, isDone),
      check: (value) => context.check(...change(value))});
  });
}

/** @param {Json} node @param {string[]} but */
export const keysBut = (node, ...but) => Object.keys(node.properties).filter((key) => !but.includes(key));

/** @param {Entry} entry @returns {Element[]} */
function rowsOf(entry) {
  const {node} = entry;
  const make = node.kind === "color_map" ? colorMapRows : node.kind === "plane" ? planeRows
    : node.kind?.endsWith("color") || (node.minItems === 3 && node.maxItems === 4) ? colorRows
    : node.properties ? partRows
    : node.anyOf ? wordOrColorRows
    : node.enum ? wordRows
    : makers[node.type];
  const rows = make?.(entry) ?? [];
  rows.filter((one) => !one.hasAttribute("title")).forEach((one) => one.setAttribute("title", node.description ?? ""));
  if (rows.length > 0) {
    placed(entry.place, rows[0]);
  }
  return rows;
}

/** @type {Record<string, (entry: Entry) => Element[]>} */
const makers = {
  boolean: ({caption, label, node, value, put}) => [row("", check(caption, value ?? node.default, put, label))],
  string: textRows,
  number: numberRows,
  integer: numberRows,
  array: arrayRows,
};

/** @param {Json} node @returns {string | undefined} the list of what may be chosen */
const listOf = (node) => (formats.includes(node.format) ? `${node.format}s` : undefined);

/** @param {Entry} entry */
function textRows(entry) {
  const {label, node, value, put, context} = entry;
  // An empty text may be something else than none.
  const mayBeEmpty = node.examples?.includes("");
  const {input, rows} = sceneText(entry, value ?? "", (words) => (mayBeEmpty ? words : words || null), listOf(node));
  input.placeholder = node.format === "field" ? context.sceneField : "";
  input.hidden = mayBeEmpty && value === undefined;
  if (mayBeEmpty) {
    input.before(check("own", value !== undefined, (is) => put(is ? "" : null), `own ${label}`));
  }
  return rows;
}

/** @param {Entry} entry */
function numberRows({caption, label, node, value, put}) {
  const isShare = node.minimum === 0 && node.maximum === 1;
  return [row(caption, isShare ? slider(label, [0, 1], value ?? node.default, put) : number(label, value ?? null, put, node))];
}

/** @param {Entry} entry */
function wordRows({caption, label, node, value, put}) {
  return [row(caption, choice(label, node.default ? node.enum : ["", ...node.enum], value ?? node.default ?? "", (word) => put(word || null)))];
}

/** @param {Entry} entry */
function colorRows({caption, label, value, put, node, context}) {
  const own = check(value ? "" : "own", value !== undefined, (is) => put(is ? start(node, context) : null), `own ${label}`);
  return [row(caption, own, ...(value ? colorControls(label, value, put, node.maxItems) : []))];
}

/**
 * A word, or a colour.
 * @param {Entry} entry
 */
function wordOrColorRows({caption, label, node, value, put}) {
  const words = ["", ...node.anyOf.flatMap((/** @type {Json} */ one) => one.enum ?? []), "own"];
  const isOwn = Array.isArray(value);
  return [
    row(caption, choice(label, words, isOwn ? "own" : value ?? "", (word) => put(word === "own" ? [0, 0, 0] : word || null))),
    ...(isOwn ? [row("", ...colorControls(label, value, put))] : []),
  ];
}

/**
 * An object that may be there, or a text in its place.
 * @param {Entry} entry
 */
function partRows(entry) {
  const {place, caption, label, node, value, put, context} = entry;
  const isThere = typeof value === "object";
  const begin = async () => put(await (context.begin[node.kind]?.() ?? start(node, context)));
  return [
    row("", check(caption, isThere, (is) => (is ? begin() : put(null)), label)),
    ...(isThere ? [group(label, objectRows(place, value, node, context, undefined, `${label} `))]
      : node.mayBeText ? sceneText({...entry, caption: `${caption} file`, label: `${label} file`}, value ?? "", (words) => words || null).rows : []),
  ];
}

/** @param {string} label @param {Element[]} rows */
const group = (label, rows) => element("div", {className: "part", role: "group", "aria-label": label}, rows);

/** @param {Entry} entry @returns {Element[]} */
function arrayRows(entry) {
  const {caption, label, node, value, put, context} = entry;
  const items = resolved(node.items ?? {});
  const isFixed = node.minItems === node.maxItems && node.minItems <= 3;
  if (items.type === "array" && items.kind === undefined) {
    return pointRows(entry, items);
  }
  if (items.type === "array" || items.properties) {
    return listRows(entry, items);
  }
  if (items.type === "string") {
    const parts = (/** @type {string} */ words) => (words ? words.split(",").map((word) => word.trim()).filter(Boolean) : null);
    return sceneText(entry, (value ?? []).join(", "), parts, listOf(node)).rows;
  }
  if (isFixed) {
    return node.minItems < 3 ? [row(caption, ...vector(entry))] : [...(caption ? [row(caption)] : []), element("p", {className: "row"}, vector(entry))];
  }
  // Of elements there are also ranges.
  const written = (value ?? []).map((/** @type {any} */ one) => (Array.isArray(one) ? one.join("-") : String(Number(one.toPrecision(9)))));
  return [row(caption, text(label, written.join(", "), (words) => {
    const all = node.items ? numbers(words) : ranges(words);
    if (all || words === "") {
      put(all);
    } else {
      context.refuse(`${label}: '${words}' are no numbers`);
    }
  }))];
}

/**
 * As 3, 7, 10-20.
 * @param {string} words
 */
function ranges(words) {
  const all = words.split(/[\s,;]+/).filter(Boolean);
  return all.length > 0 && all.every((word) => /^\d+(-\d+)?$/.test(word))
    ? all.map((word) => (word.includes("-") ? word.split("-").map(Number) : Number(word))) : null;
}

/**
 * Two or three numbers; all of them, or none.
 * @param {Entry} entry
 */
function vector({label, node, value, put}) {
  const names = node.minItems === 3 ? ["x", "y", "z"] : ["from", "to"];
  const change = () => {
    const all = inputs.map((input) => input.value);
    if (all.every((one) => one === "")) {
      put(null);
    } else if (all.every((one) => one !== "")) {
      put(all.map(Number));
    }
  };
  const inputs = names.map((name, i) => number(`${label} ${name}`, value ? Number(value[i].toPrecision(9)) : null, change, node));
  return inputs;
}

/**
 * Entries that are added and removed.
 * @param {Entry} entry @param {Json} items their schema
 */
function listRows({place, caption, label, value, put, context}, items) {
  /** @type {any[]} */
  const all = value ?? [];
  const rows = all.flatMap((one, i) => {
    const name = `${label} ${i + 1}`;
    const removal = button("Remove", () => put(all.length > 1 ? all.filter((_, j) => j !== i) : null), {"aria-label": `Remove ${name}`});
    const own = items.properties
      ? [group(name, objectRows(`${place}/${i}`, one, items, context, undefined, `${name} `))]
      : rowsOf({place: `${place}/${i}`, caption: "", label: name, node: items, value: one, part: {}, context,
        put: (other, isDone) => other && context.set(`${place}/${i}`, other, caption, isDone),
        check: (other) => context.check(`${place}/${i}`, other)});
    return [row(`${caption} ${i + 1}`, removal), ...own];
  });
  const more = () => context.more[caption]?.(all) ?? [...all, start(items, context)];
  return [...rows, row(all.length > 0 ? "" : caption, button(`Add to ${caption}`, () => put(more()), {"aria-label": `Add to ${label}`}))];
}
