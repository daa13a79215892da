// The transfer function of volume rendering: density by value over the field's histogram, with points and peaks to be moved.
import {scale, short} from "../axis.js";
import {bars} from "./color_scale.js";
import type {Context} from "./context.js";
import {button, buttons, check, colorControls, element, hand, movable, number, placed, row, setAttributes, shape} from "../controls.js";
import {middlePoint, withPoint} from "./point_rows.js";
import type {Peak, VolumeRendering} from "../scene.js";

/** `at`: value and density. */
type Grip = {label: string; at: () => number[]; move: (value: number, density: number) => void; remove?: () => void};

const width = 264, height = 120, place = "/volume_rendering";

/** `own`: the scene's volume_rendering. */
export function transferEditor(own: VolumeRendering, field: string, context: Context): Element[] {
  const map = own.color_map ?? context.scene.color_map ?? {};
  const isOpacity = Boolean(own.opacity);
  const key = isOpacity ? "opacity" : "density";
  const points = (own[key] ?? []).map((point) => [...point]);
  const peaks = (own.peaks ?? []).map((peak) => ({...peak}));
  const usual = context.volume.usual_density;
  const drawing = shape("svg", {viewBox: `0 0 ${width} ${height}`, class: "transfer", role: "group",
    "aria-label": "Density by value. Double click adds a point; arrow keys move a point, Delete removes it"});
  // Grips stay where they are: what is taken out loses the focus.
  const back = shape("g");
  const known = () => context.histograms.of(field, context.scene, draw);
  const range = (): [number, number] | null => { const data = known(); return map.range ?? (data ? [data.lower, data.upper] : null); };
  /** What is drawn without points of its own. */
  const base = (): number[][] => {
    const ends = range();
    return points.length || !ends ? points : peaks.length ? [] : [[ends[0], 0], [ends[1], usual]];
  };
  const highest = () => (isOpacity ? 1 : 1.25 * Math.max(0, ...base().map((point) => point[1]), ...peaks.map((peak) => peak.density)) || usual);
  // It stays while a grip is held.
  let top = highest();
  const axis = () => scale(range() ?? [0, 1], map.scale === "logarithmic");
  const x = (value: number) => width * Math.min(2, Math.max(-1, axis().place(value)));
  const y = (density: number) => height * (1 - density / top);
  const placeOf = (event: MouseEvent) => {
    const box = drawing.getBoundingClientRect();
    const clamped = (part: number) => Math.min(1, Math.max(0, part));
    return [axis().value(clamped((event.clientX - box.left) / box.width)), top * clamped(1 - (event.clientY - box.top) / box.height)];
  };
  const send = (isDone: boolean) => context.set(place, {...own, ...(points.length ? {[key]: points} : {}), ...(peaks.length ? {peaks} : {})}, "density", isDone);
  const removePeak = (i: number) => context.set(place, {...own, peaks: peaks.length > 1 ? peaks.filter((_, j) => j !== i) : undefined}, "remove a peak");

  const pointGrips = points.map((point, i): Grip => ({
    label: `Point ${i + 1} of the density`,
    at: () => point,
    move: (value, density) => {
      const low = i > 0 ? points[i - 1][0] : -Infinity, high = i + 1 < points.length ? points[i + 1][0] : Infinity;
      point[0] = Math.min(high, Math.max(low, value));
      point[1] = Math.max(0, density);
    },
    remove: points.length > 1 ? () => { points.splice(i, 1); send(true); } : undefined,
  }));
  const peakGrips = peaks.flatMap((peak, i): Grip[] => [{
    label: `Peak ${i + 1}`,
    at: () => [peak.value, peak.density],
    move: (value, density) => { peak.value = value; peak.density = Math.max(1e-3 * top, density); },
    remove: () => removePeak(i),
  }, {
    label: `Width of peak ${i + 1}`,
    at: () => [peak.value + 0.25 * peak.width, 0.5 * peak.density],
    move: (value) => {
      const wide = 4 * (value - peak.value);
      // Its ends must be other numbers than its middle.
      peak.width = peak.value + 0.5 * wide > peak.value && peak.value - 0.5 * wide < peak.value ? wide : peak.width;
    },
  }]);
  const grips = [...pointGrips, ...peakGrips];
  const nodes = grips.map((grip) => {
    const node = shape("circle", {class: "point", r: 6, tabindex: 0, role: "slider", "aria-label": grip.label});
    movable(node, {
      drag: (event) => { const [value, density] = placeOf(event); grip.move(value, density); draw(); send(false); },
      arrow: ([dx, dy]) => {
        const [value, density] = grip.at();
        grip.move(axis().value(axis().place(value) + 0.01 * dx), density - 0.01 * dy * top);
        draw();
        send(false);
      },
      done: () => context.release(),
      other: (event) => {
        const isRemoval = (event.key === "Delete" || event.key === "Backspace") && grip.remove !== undefined;
        if (isRemoval) {
          grip.remove?.();
        }
        return isRemoval;
      },
    });
    node.addEventListener("contextmenu", (event) => { event.preventDefault(); grip.remove?.(); });
    return node;
  });
  const insert = (point: number[]) => {
    points.splice(0, points.length, ...withPoint(points, point));
    send(true);
  };
  drawing.addEventListener("dblclick", (event) => {
    if (points.length && !(event.target instanceof Element && event.target.classList.contains("point"))) {
      insert(placeOf(event));
    }
  });

  function draw() {
    const data = known();
    top = hand.isBusy ? top : highest();
    const line = base().map(([value, density]) => `${x(value)} ${y(density)}`);
    const curve = line.length ? `M0 ${line[0].split(" ")[1]}L${line.join("L")}L${width} ${line[line.length - 1].split(" ")[1]}` : "";
    back.replaceChildren(
      ...(data && data.upper > data.lower ? bars(data, x, height, height) : []),
      ...peaks.map((peak) => shape("path", {class: "peak",
        d: `M${x(peak.value - 0.5 * peak.width)} ${height}L${x(peak.value)} ${y(peak.density)}L${x(peak.value + 0.5 * peak.width)} ${height}Z`})),
      shape("path", {class: "density", d: curve}));
    grips.forEach((grip, i) => {
      const [value, density] = grip.at();
      setAttributes(nodes[i], {cx: x(value), cy: y(density), "aria-valuenow": value, "aria-valuetext": `${short(density)} at ${short(value)}`});
    });
  }
  drawing.append(back, ...nodes);
  draw();

  return [
    drawing,
    ...(isOpacity ? [] : [row("", check("own density", points.length > 0, (is) => {
      const {density: _density, ...rest} = own;
      const shown = range();
      if (shown) {
        context.set(place, is ? {...own, density: [[shown[0], 0], [(shown[0] + shown[1]) / 2, 0], [shown[1], usual]]} : rest, "density");
      }
    }))]),
    buttons(button("Add point", () => { if (range()) { insert(middlePoint(points)); } }, {disabled: points.length === 0}),
      button("Add peak", () => {
        const shown = range();
        if (shown && shown[1] > shown[0]) {
          peaks.push({value: roundMiddle(shown), width: 0.05 * (shown[1] - shown[0]), density: 10 * usual});
          send(true);
        }
      })),
    ...peaks.flatMap((peak, i) => peakRows(peak, i, () => send(true), () => removePeak(i))),
  ];
}

/** A number of few digits near the middle. */
function roundMiddle([low, high]: [number, number]): number {
  const step = 10 ** Math.floor(Math.log10((high - low) / 20));
  return Number((Math.round((low + high) / 2 / step) * step).toPrecision(12));
}

function peakRows(peak: Peak, i: number, send: () => void, remove: () => void): Element[] {
  const part = (key: "value" | "width" | "density") =>
    placed(`${place}/peaks/${i}/${key}`, number(`${key} of peak ${i + 1}`, peak[key], (value) => {
      if (value !== null) {
        peak[key] = value;
        send();
      }
    }));
  return [
    row(`Peak ${i + 1}`, part("value"), button("Remove", remove, {"aria-label": `Remove peak ${i + 1}`})),
    row("Width", part("width"), element("span", {}, ["density"]), part("density")),
    ...(peak.color ? [row("Peak's colour", ...colorControls(`Colour of peak ${i + 1}`, peak.color, (rgb) => { peak.color = rgb; send(); }))] : []),
    placed(`${place}/peaks/${i}/color`, row("", check("own colour", Boolean(peak.color), (is) => {
      if (is) {
        peak.color = [0.9, 0.9, 0.9];
      } else {
        delete peak.color;
      }
      send();
    }, `own colour of peak ${i + 1}`))),
  ];
}
