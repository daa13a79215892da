// Points of a function of values: numbers, or colours.
import {button, colorControls, element, number, numbers, row} from "../controls.js";
import type {Entry} from "./entry.js";
import {start} from "./schema.js";
import type {SchemaNode} from "./schema.js";

/** So many have a row each; more are lines of a text. */
const mostRows = 12;

/** In the middle of the widest gap. */
export function middlePoint(points: number[][]): number[] {
  let widest = 0;
  for (let i = 1; i + 1 < points.length; ++i) {
    widest = points[i + 1][0] - points[i][0] > points[widest + 1][0] - points[widest][0] ? i : widest;
  }
  const [from, to] = [points[widest], points[Math.min(widest + 1, points.length - 1)]];
  return from.map((x, i) => (x + to[i]) / 2);
}

export function withPoint(points: number[][], point: number[]): number[][] {
  const behind = points.findIndex((other) => other[0] > point[0]);
  return behind < 0 ? [...points, point] : [...points.slice(0, behind), point, ...points.slice(behind)];
}

/** Each is a value and what is there: a number, or a colour. `items`: their schema. */
export function pointRows(entry: Entry, items: SchemaNode): Element[] {
  const {place, caption, label, put, context} = entry;
  const all = (entry.value ?? []) as number[][];
  const add = row(all.length > 0 ? "" : caption, button(`Add to ${caption}`, () => {
    put(all.length > 0 ? withPoint(all, middlePoint(all)) : [start(items, context)]);
  }, {"aria-label": `Add to ${label}`}));
  if (all.length > mostRows) {
    return [row(caption), textRow(entry, all, items), add];
  }
  const rows = all.map((point, i) => {
    const name = `${label} ${i + 1}`;
    const set = (other: number[]) => context.set(`${place}/${i}`, other, caption);
    const part = (at: number, word: string) => number(`${name} ${word}`, Number(point[at].toPrecision(9)), (x) => {
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

/** A line for each. */
function textRow({label, put, context}: Entry, all: number[][], items: SchemaNode): Element {
  const words = all.map((point) => point.map((x) => Number(x.toPrecision(9))).join(", ")).join("\n");
  const area = element("textarea", {value: words, rows: mostRows, spellcheck: false, "aria-label": `${label}: ${items.minItems ?? 2} numbers a line`});
  area.onchange = () => {
    const points = area.value.split("\n").filter((line) => line.trim() !== "").map((line) => numbers(line) ?? []);
    if (points.every((point) => point.length === items.minItems)) {
      put(points.length > 0 ? points : null);
    } else {
      context.refuse(`${label}: each line needs ${items.minItems ?? 2} numbers`);
    }
  };
  return element("p", {className: "row"}, [area]);
}
