// The values at a point, as a table.
import {element} from "../controls.js";
import type {Picked} from "../messages.js";
import type {Json} from "../scene.js";

/** What is not known is null, or missing. */
const linesOf = (value: Json | undefined) => (Array.isArray(value) ? value.map((x) => element("div", {}, [String(x)])) : [String(value ?? "unknown")]);

export function table(rows: [string, Json | undefined][]): HTMLTableElement {
  return element("table", {}, rows.map(([name, value]) => element("tr", {}, [element("th", {scope: "row"}, [name]), element("td", {}, linesOf(value))])));
}

export function pickedTable(picked: Picked): Element {
  if (!picked.hit) {
    return element("p", {}, ["Nothing is there."]);
  }
  const rows: [string, Json | undefined][] = [["element", picked.element], ["xi", picked.xi], ["position", picked.position]];
  if (picked.also?.length) {
    rows.push(["also in", picked.also.join(", ")]);
  }
  for (const field of picked.fields) {
    rows.push([`${field.name}${field.unit ? ` (${field.unit})` : ""}`, field.values]);
    rows.push([`grad ${field.name}`, field.gradients]);
  }
  rows.push(["Jacobian", picked.jacobian], ["order", picked.order]);
  return picked.remark ? element("div", {}, [table(rows), element("p", {}, [picked.remark])]) : table(rows);
}
