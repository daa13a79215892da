// Rows of controls for the keys of an object of the scene, made from its schema.
import {colorMapRows} from "./color_map_rows.js";
import type {Context} from "./context.js";
import {button, check, choice, colorControls, element, number, numbers, placed, row, slider, text} from "../controls.js";
import type {Entry} from "./entry.js";
import {planeRows} from "./plane_rows.js";
import {pointRows} from "./point_rows.js";
import type {Json, JsonObject} from "../scene.js";
import {sceneText} from "./scene_text.js";
import {formats, isMeaningful, objectNode, resolved, start, withValue} from "./schema.js";
import type {ObjectNode, SchemaNode} from "./schema.js";

/** These have controls of their own, say what others do, or are the server's matter. */
const elsewhere = ["type", "visible", "lights", "point", "normal", "path", "more_paths", "plugin"];

/** Of the object `part` at a place. `keys`: which of its keys; `label`: what comes before their names. */
export function objectRows(place: string, part: JsonObject, node: ObjectNode, context: Context, keys = Object.keys(node.properties), label = ""): Element[] {
  const shown = keys.filter((key) => !elsewhere.includes(key) && isMeaningful(node, key, part));
  return shown.flatMap((key) => {
    const caption = key.replaceAll("_", " ").replace("color", "colour");
    /** What another value changes. */
    const change = (value: Json | undefined): [string, Json | undefined] => {
      const next = withValue(node, part, key, value);
      const isAlone = Object.keys(part).every((other) => other === key || other in next);
      return isAlone ? [`${place}/${key}`, value] : [place, next];
    };
    return rowsOf({place: `${place}/${key}`, caption, label: label + caption, node: resolved(node.properties[key]), value: part[key], part, context,
      put: (value, isDone = true) => context.set(...change(value), caption, isDone),
      check: (value) => context.check(...change(value))});
  });
}

export const keysBut = (node: ObjectNode, ...but: string[]) => Object.keys(node.properties).filter((key) => !but.includes(key));

type Rows = (entry: Entry) => Element[];

function rowsOf(entry: Entry): Element[] {
  const rows = makerOf(entry.node)?.(entry) ?? [];
  rows.filter((one) => !one.hasAttribute("title")).forEach((one) => one.setAttribute("title", entry.node.description ?? ""));
  if (rows.length > 0) {
    placed(entry.place, rows[0]);
  }
  return rows;
}

function makerOf(node: SchemaNode): Rows | undefined {
  const isColor = node.kind?.endsWith("color") || (node.minItems === 3 && node.maxItems === 4);
  return node.kind === "color_map" ? colorMapRows : node.kind === "plane" ? planeRows : isColor ? colorRows
    : node.properties ? partRows : node.anyOf ? wordOrColorRows : node.enum ? wordRows : makers[node.type ?? ""];
}

const makers: Record<string, Rows | undefined> = {
  boolean: ({caption, label, node, value, put}) => [row("", check(caption, Boolean(value ?? node.default), put, label))],
  string: textRows,
  number: numberRows,
  integer: numberRows,
  array: arrayRows,
};

/** The list of what may be chosen. */
const listOf = (node: SchemaNode) => (node.format && formats.includes(node.format) ? `${node.format}s` : undefined);

function textRows(entry: Entry): Element[] {
  const {label, node, value, put, context} = entry;
  // An empty text may be something else than none.
  const mayBeEmpty = node.examples?.includes("") ?? false;
  const {input, rows} = sceneText(entry, String(value ?? ""), (words) => (mayBeEmpty ? words : words || null), listOf(node));
  input.placeholder = node.format === "field" ? context.sceneField : "";
  input.hidden = mayBeEmpty && value === undefined;
  if (mayBeEmpty) {
    input.before(check("own", value !== undefined, (is) => put(is ? "" : null), `own ${label}`));
  }
  return rows;
}

const numberOrNull = (value: Json | undefined) => (typeof value === "number" ? value : null);

function numberRows({caption, label, node, value, put}: Entry): Element[] {
  const isShare = node.minimum === 0 && node.maximum === 1;
  return [row(caption, isShare ? slider(label, [0, 1], numberOrNull(value ?? node.default) ?? 0, put) : number(label, numberOrNull(value), put, node))];
}

function wordRows({caption, label, node, value, put}: Entry): Element[] {
  const words = node.enum ?? [];
  return [row(caption, choice(label, node.default ? words : ["", ...words], String(value ?? node.default ?? ""), (word) => put(word || null)))];
}

function colorRows({caption, label, value, put, node, context}: Entry): Element[] {
  const own = check(value ? "" : "own", value !== undefined, (is) => put(is ? start(node, context) : null), `own ${label}`);
  return [row(caption, own, ...(value ? colorControls(label, value as number[], put, node.maxItems) : []))];
}

/** A word, or a colour. */
function wordOrColorRows({caption, label, node, value, put}: Entry): Element[] {
  const words = ["", ...(node.anyOf ?? []).flatMap((one) => one.enum ?? []), "own"];
  const isOwn = Array.isArray(value);
  return [
    row(caption, choice(label, words, isOwn ? "own" : String(value ?? ""), (word) => put(word === "own" ? [0, 0, 0] : word || null))),
    ...(isOwn ? [row("", ...colorControls(label, value as number[], put))] : []),
  ];
}

/** An object that may be there, or a text in its place. */
function partRows(entry: Entry): Element[] {
  const {place, caption, label, node, value, put, context} = entry;
  const isThere = typeof value === "object";
  const begin = async () => put(await (context.begin[node.kind ?? ""]?.() ?? start(node, context)));
  return [
    row("", check(caption, isThere, (is) => (is ? begin() : put(null)), label)),
    ...(isThere ? [group(label, objectRows(place, value as JsonObject, objectNode(node), context, undefined, `${label} `))]
      : node.mayBeText ? sceneText({...entry, caption: `${caption} file`, label: `${label} file`}, String(value ?? ""), (words) => words || null).rows : []),
  ];
}

const group = (label: string, rows: Element[]) => element("div", {className: "part", role: "group", "aria-label": label}, rows);

function arrayRows(entry: Entry): Element[] {
  const {caption, label, node, value, put, context} = entry;
  const items = resolved(node.items ?? {});
  const isFixed = node.minItems !== undefined && node.minItems === node.maxItems && node.minItems <= 3;
  if (items.type === "array" && items.kind === undefined) {
    return pointRows(entry, items);
  }
  if (items.type === "array" || items.properties) {
    return listRows(entry, items);
  }
  if (items.type === "string") {
    const parts = (words: string) => (words ? words.split(",").map((word) => word.trim()).filter(Boolean) : null);
    return sceneText(entry, ((value ?? []) as string[]).join(", "), parts, listOf(node)).rows;
  }
  if (isFixed) {
    return node.minItems === 2 ? [row(caption, ...vector(entry))] : [...(caption ? [row(caption)] : []), element("p", {className: "row"}, vector(entry))];
  }
  // Of elements there are also ranges.
  const written = ((value ?? []) as (number | number[])[]).map((one) => (Array.isArray(one) ? one.join("-") : String(Number(one.toPrecision(9)))));
  return [row(caption, text(label, written.join(", "), (words) => {
    const all = node.items ? numbers(words) : ranges(words);
    if (all || words === "") {
      put(all);
    } else {
      context.refuse(`${label}: '${words}' are no numbers`);
    }
  }))];
}

/** As 3, 7, 10-20. */
function ranges(words: string): (number | number[])[] | null {
  const all = words.split(/[\s,;]+/).filter(Boolean);
  return all.length > 0 && all.every((word) => /^\d+(-\d+)?$/.test(word))
    ? all.map((word) => (word.includes("-") ? word.split("-").map(Number) : Number(word))) : null;
}

/** Two or three numbers; all of them, or none. */
function vector({label, node, value, put}: Entry): HTMLInputElement[] {
  const names = node.minItems === 3 ? ["x", "y", "z"] : ["from", "to"];
  const change = () => {
    const all = inputs.map((input) => input.value);
    if (all.every((one) => one === "")) {
      put(null);
    } else if (all.every((one) => one !== "")) {
      put(all.map(Number));
    }
  };
  const inputs = names.map((name, i) => number(`${label} ${name}`, value ? Number((value as number[])[i].toPrecision(9)) : null, change, node));
  return inputs;
}

/** Entries that are added and removed. `items`: their schema. */
function listRows({place, caption, label, value, put, context}: Entry, items: SchemaNode): Element[] {
  const all = (value ?? []) as Json[];
  const rows = all.flatMap((one, i) => {
    const name = `${label} ${i + 1}`;
    const removal = button("Remove", () => put(all.length > 1 ? all.filter((_, j) => j !== i) : null), {"aria-label": `Remove ${name}`});
    const own = items.properties
      ? [group(name, objectRows(`${place}/${i}`, one as JsonObject, objectNode(items), context, undefined, `${name} `))]
      : rowsOf({place: `${place}/${i}`, caption: "", label: name, node: items, value: one, part: {}, context,
        put: (other, isDone) => { if (other) { context.set(`${place}/${i}`, other, caption, isDone); } },
        check: (other) => context.check(`${place}/${i}`, other)});
    return [row(`${caption} ${i + 1}`, removal), ...own];
  });
  const more = () => context.more[caption]?.(all) ?? [...all, start(items, context)];
  return [...rows, row(all.length > 0 ? "" : caption, button(`Add to ${caption}`, () => put(more()), {"aria-label": `Add to ${label}`}))];
}
