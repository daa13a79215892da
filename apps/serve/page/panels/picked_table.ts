// The values at a point, as a table.
import {element} from "../controls.js";
import type {Picked} from "../messages.js";
import type {Json} from "../scene.js";
import {valueTable} from "./value_table.js";

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
  return picked.remark ? element("div", {}, [valueTable(rows), element("p", {}, [picked.remark])]) : valueTable(rows);
}
