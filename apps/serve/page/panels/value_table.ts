// Names and values as a table.
import {element} from "../controls.js";
import type {Json} from "../scene.js";

/** What is not known is null, or missing. */
const linesOf = (value: Json | undefined) => (Array.isArray(value) ? value.map((x) => element("div", {}, [String(x)])) : [String(value ?? "unknown")]);

export function valueTable(rows: [string, Json | undefined][]): HTMLTableElement {
  return element("table", {}, rows.map(([name, value]) => element("tr", {}, [element("th", {scope: "row"}, [name]), element("td", {}, linesOf(value))])));
}
