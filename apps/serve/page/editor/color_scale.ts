// The colours of a map with the field's histogram above them, and the range as two grips.
import {scale, short} from "../axis.js";
import {ColorPoints} from "./color_points.js";
import type {Context} from "./context.js";
import {button, buttons, element, hexOf, movable, setAttributes, shape} from "../controls.js";
import type {Histogram} from "../messages.js";
import type {ColorMap} from "../scene.js";
import {colorAt} from "./palette.js";

type Ends = [number, number];

const width = 264, above = 46, bar = 16, height = above + bar + 2;

/** Bars of a histogram, at most so tall. The square root lets rare values be seen, too. */
export function bars(known: Histogram, x: (value: number) => number, base: number, most: number): Element[] {
  const step = (known.upper - known.lower) / known.bins.length;
  return known.bins.map((part, i) => {
    const [from, to] = [x(known.lower + i * step), x(known.lower + (i + 1) * step)];
    const tall = most * Math.sqrt(part);
    return shape("rect", {class: "bin", x: from, y: base - tall, width: Math.max(0.5, to - from), height: tall});
  });
}

/** `place`: of the map. */
export function colorScale(place: string, map: ColorMap, field: string, context: Context): Element[] {
  const isLogarithmic = map.scale === "logarithmic";
  const drawing = shape("svg", {viewBox: `0 0 ${width} ${height}`, class: "scale"});
  // Grips stay where they are: what is taken out loses the focus.
  const back = shape("g");
  const ends = element("p", {className: "ends"});
  const choices = buttons();
  let range: Ends | null = map.range ?? null;
  let colors: number[][] = [];
  context.histograms.palette(map).then((points) => { colors = points; draw(); });

  const set = (wanted: Ends, isDone: boolean) => {
    if (wanted[0] < wanted[1] && (wanted[0] > 0 || !isLogarithmic)) {
      range = wanted;
      context.set(`${place}/range`, wanted, "range", isDone);
      draw();
    }
  };
  const grips = ["Lower", "Upper"].map((name, end) => {
    const grip = shape("path", {class: "end", tabindex: 0, role: "slider", "aria-label": `${name} end of the colours`});
    const move = (to: (now: number) => number, isDone: boolean) => {
      const now = shownRange();
      if (now) {
        const wanted: Ends = [...now];
        wanted[end] = to(now[end]);
        set(wanted, isDone);
      }
    };
    movable(grip, {
      drag: (event) => move(() => axis().value(placeOf(event)), false),
      arrow: ([dx, dy]) => move((now) => axis().value(axis().place(now) + 0.01 * (dx - dy)), false),
      done: () => context.release(),
    });
    return grip;
  });
  const known = () => context.histograms.of(field, context.scene, draw);
  const shownRange = (): Ends | null => {
    const data = known();
    return range ?? (data ? [data.lower, data.upper] : null);
  };
  /** What is drawn stays while a grip is held. */
  let domain: Ends | null = null;
  const axis = () => scale(domain ?? [0, 1], isLogarithmic);
  const x = (value: number) => width * Math.min(1, Math.max(0, axis().place(value)));
  const placeOf = (event: MouseEvent) => {
    const box = drawing.getBoundingClientRect();
    return Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
  };

  function draw() {
    const data = known(), shown = shownRange();
    if (!shown) {
      return;
    }
    const low = Math.min(shown[0], data?.lower ?? shown[0]), high = Math.max(shown[1], data?.upper ?? shown[1]);
    domain ??= isLogarithmic && !(low > 0) ? shown : [low, high];
    const scaled = scale(shown, isLogarithmic);
    back.replaceChildren(
      ...(data && data.upper > data.lower ? bars(data, x, above, above) : []),
      shape("rect", {class: "outside", x: 0, y: above, width, height: bar}),
      ...gradient(points?.palette() ?? colors, (at) => x(scaled.value(at))));
    points?.draw();
    shown.map(x).forEach((at, i) => {
      setAttributes(grips[i], {d: `M${at} 0V${height}M${at - 4} ${height}H${at + 4}V${above}H${at - 4}Z`, "aria-valuenow": shown[i],
        "aria-valuemin": low, "aria-valuemax": high, "aria-valuetext": short(shown[i])});
    });
    ends.textContent = data ? `${field}: ${short(data.lower)} to ${short(data.upper)}` : "";
    choices.replaceChildren(...rangeButtons(data));
  }

  function rangeButtons(data: Histogram | null): Element[] {
    const quantiles = data?.quantiles;
    const most = data ? Math.max(Math.abs(data.lower), Math.abs(data.upper)) : 0;
    return [
      button("Auto", () => context.set(`${place}/range`, null, "range"), {disabled: range === null, title: "The field's range at each time step"}),
      button("±", () => set([-most, most], true), {disabled: isLogarithmic || !(most > 0), title: "Symmetric", "aria-label": "Symmetric range"}),
      button("2-98 %", () => { if (quantiles) { set([quantiles[0], quantiles[3]], true); } },
        {disabled: !quantiles, title: "Without the lowest and the highest hundredths of the volume"}),
      button("10-90 %", () => { if (quantiles) { set([quantiles[1], quantiles[2]], true); } }, {disabled: !quantiles}),
    ];
  }
  const points = ColorPoints.of(place, map, context, {
    drawing, middle: above + bar / 2, draw, palette: () => colors,
    at: (event) => scale(shownRange() ?? [0, 1], isLogarithmic).place(axis().value(placeOf(event))),
    x: (at) => x(scale(shownRange() ?? [0, 1], isLogarithmic).value(at)),
  });
  drawing.append(back, ...grips, ...(points?.grips ?? []));
  draw();
  return [drawing, ends, choices];
}

/** Even colours between points; SVG's own gradients would need names. */
function gradient(palette: number[][], x: (position: number) => number): Element[] {
  const n = 64;
  return palette.length === 0 ? [] : Array.from({length: n}, (_, i) => {
    const left = x(i / n);
    return shape("rect", {x: left, y: above, width: Math.max(0, x((i + 1) / n) - left + 0.4), height: bar, fill: hexOf(colorAt(palette, (i + 0.5) / n))});
  });
}
