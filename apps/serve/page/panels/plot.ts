// A plot of values along a line, with jumps as gaps, and a cursor for the mouse and the arrow keys.
import {scale, short, ticks} from "../axis.js";
import {arrowOf, element, setAttributes, shape} from "../controls.js";
import type {Line, Series} from "../messages.js";

const size = [268, 190], left = 44, right = 6, top = 6, bottom = 20;

/** In words: both values where elements meet and the field jumps. Numbers are those that were sampled, none in between. */
function valuesAt(series: Series, at: number): string {
  const values = new Set(series.points.flatMap(([place, value]) => (place === at && value !== null ? [Number(value.toPrecision(9))] : [])));
  return values.size ? [...values].join(" | ") : "none";
}

function rangeOf(all: Series[]): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const {points} of all) {
    for (const [, value] of points) {
      if (value !== null) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
  }
  const room = high > low ? 0.05 * (high - low) : Math.max(1e-3 * Math.abs(low), 1e-12);
  return low <= high ? [low - room, high + room] : [0, 1];
}

/** A path; a gap where there is no value. */
function pathOf(series: Series, x: (at: number) => number, y: (value: number) => number): string {
  let isDown = false;
  return series.points.map(([at, value]) => {
    const step = value === null ? "" : `${isDown ? "L" : "M"}${x(at).toFixed(2)} ${y(value).toFixed(2)}`;
    isDown = value !== null;
    return step;
  }).join("");
}

/** `onCursor`: the arc length that the cursor is at. */
export function plot(line: Pick<Line, "series" | "breaks" | "length">, onCursor: (at: number | null) => void): Element {
  const [low, high] = rangeOf(line.series);
  const across = scale([0, line.length], false), up = scale([low, high], false);
  const x = (at: number) => left + across.place(at) * (size[0] - left - right);
  const y = (value: number) => size[1] - bottom - up.place(value) * (size[1] - top - bottom);
  const cursor = shape("line", {class: "cursor", y1: top, y2: size[1] - bottom, visibility: "hidden"});
  const told = element("output", {className: "told", "aria-live": "polite"});
  const axis = [
    ...ticks(low, high, 5).flatMap((value) => [
      shape("line", {class: "grid", x1: left, x2: size[0] - right, y1: y(value), y2: y(value)}),
      shape("text", {x: left - 4, y: y(value) + 3, "text-anchor": "end"}, [short(value)])]),
    ...ticks(0, line.length, 5).map((at) => shape("text", {x: x(at), y: size[1] - 6, "text-anchor": "middle"}, [short(at)])),
  ];
  const drawing = shape("svg", {
    viewBox: `0 0 ${size[0]} ${size[1]}`, class: "plot", tabindex: 0, role: "img",
    "aria-label": `${line.series.map((one) => one.name).join(", ")} over the arc length. Arrow keys move along the line, with Shift ten times as far; Home and End go to its ends.`,
  }, [
    shape("rect", {class: "frame", x: left, y: top, width: size[0] - left - right, height: size[1] - top - bottom}),
    ...axis,
    ...line.breaks.map(({at}) => shape("line", {class: "break", x1: x(at), x2: x(at), y1: size[1] - bottom, y2: size[1] - bottom - 5})),
    ...line.series.map((one, i) => shape("path", {class: `curve curve${i % 6}`, d: pathOf(one, x, y)})),
    cursor,
  ]);
  const places = [...new Set(line.series.flatMap((one) => one.points.map((point) => point[0])))].sort((a, b) => a - b);
  /** Of the places. */
  let index: number | null = null;
  const show = (wanted: number | null) => {
    index = wanted === null ? null : Math.min(places.length - 1, Math.max(0, wanted));
    const at = index === null ? null : places[index];
    setAttributes(cursor, at === null ? {visibility: "hidden"} : {visibility: "visible", x1: x(at), x2: x(at)});
    told.textContent = at === null ? "" : [`s = ${Number(at.toPrecision(9))}`, ...line.series.map((one) => `${one.name} = ${valuesAt(one, at)}`)].join(", ");
    onCursor(at);
  };
  drawing.addEventListener("pointermove", (event) => {
    const box = drawing.getBoundingClientRect();
    const at = across.value(((event.clientX - box.left) * size[0] / box.width - left) / (size[0] - left - right));
    const behind = places.findIndex((place) => place >= at);
    const last = behind < 0 ? places.length - 1 : behind;
    show(last > 0 && at - places[last - 1] < places[last] - at ? last - 1 : last);
  });
  drawing.addEventListener("pointerleave", () => show(null));
  drawing.addEventListener("keydown", (event) => {
    const way = arrowOf(event);
    if (way || event.key === "Home" || event.key === "End") {
      show(way ? (index ?? places.length >> 1) + way[0] - way[1] : event.key === "Home" ? 0 : places.length - 1);
      event.preventDefault();
    }
  });
  const legend = element("p", {className: "legend"}, line.series.length < 2 ? [] :
    line.series.map((one, i) => element("span", {className: `curve${i % 6}`}, [one.name])));
  return element("div", {}, [drawing, legend, told]);
}
