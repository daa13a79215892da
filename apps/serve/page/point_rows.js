// Points of a function of values: numbers, or colours.
import {button, colorControls, element, number, numbers, row} from "./controls.js";
import {start} from "./schema.js";

/** So many have a row each; more are lines of a text. */
const mostRows = 12;

/**
 * In the middle of the widest gap.
 * @param {number[][]} points
 */
export function middlePoint(points) {
  let widest = 0;
  for (let i = 1; i + 1 < points.length; ++i) {
    widest = points[i + 1][0] - points[i][0] > points[widest + 1][0] - points[widest][0] ? i : widest;
  }
  const [from, to] = [points[widest], points[Math.min(widest + 1, points.length - 1)]];
  return from.map((x, i) => (x + to[i]) / 2);
}

/** @param {number[][]} points @param {number[]} point */
export function withPoint(points, point) {
  const behind = points.findIndex((other) => other[0] > point[0]);
  return behind < 0 ? [...points, point] : [...points.slice(0, behind), point, ...points.slice(behind)];
}

/**
 * Each is a value and what is there: a number, or a colour.
 * @param {import("./schema_rows.js").Entry} entry @param {Record<string, any>} items their schema
 */
export function pointRows(entry, items) {
  const {place, caption, label, value, put, context} = entry;
  /** @type {number[][]} */
  const all = value ?? [];
  const add = row(all.length > 0 ? "" : caption, button(`Add to ${caption}`, () => {
    put(all.length > 0 ? withPoint(all, middlePoint(all)) : [start(items, context)]);
  }, {"aria-label": `Add to ${label}`}));
  if (all.length > mostRows) {
    return [row(caption), textRow(entry, items), add];
  }
  const rows = all.map((point, i) => {
    const name = `${label} ${i + 1}`;
    const set = (/** @type {number[]} */ other) => context.set(`${place}/${i}`, other, caption);
    const part = (/** @type {number} */ at, /** @type {string} */ word) => number(`${name} ${word}`, Number(point[at].toPrecision(9)), (x) => {
      if (x !== null) {
        set(point.map((old, j) => (j === at ? x : old)));
      }
    });
    return row(i === 0 ? caption : "", part(0, "value"),
      ...(items.minItems === 4 ? colorControls(name, point.slice(1), (color) => set([point[0], ...color])) : [part(1, caption)]),
      button("✕", () => put(all.length > 1 ? all.filter((_, j) => j !== i) : null), {"aria-label": `Remove ${name}`, title: "Remove"}));
  });
  return [...rows, add];
}

/**
 * A line for each.
 * @param {import("./schema_rows.js").Entry} entry @param {Record<string, any>} items
 */
function textRow({label, value, put, context}, items) {
  const words = value.map((/** @type {number[]} */ point) => point.map((x) => Number(x.toPrecision(9))).join(", ")).join("\n");
  const area = /** @type {HTMLTextAreaElement} */ (element("textarea", {value: words, rows: mostRows, spellcheck: false,
    "aria-label": `${label}: ${items.minItems} numbers a line`}));
  area.onchange = () => {
    const all = area.value.split("\n").filter((line) => line.trim() !== "").map(numbers);
    if (all.every((point) => point?.length === items.minItems)) {
      put(all.length > 0 ? all : null);
    } else {
      context.refuse(`${label}: each line needs ${items.minItems} numbers`);
    }
  };
  return element("p", {className: "row"}, [area]);
}
