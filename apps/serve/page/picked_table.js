// The values at a point, as a table.
import {element} from "./controls.js";

/** @typedef {Record<string, any>} Json */

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
