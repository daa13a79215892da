// A plane: moved along its normal, across an axis, or by its numbers.
import {button, numbers, row, slider, text} from "../controls.js";
import type {Entry} from "./entry.js";

/** Of a, b, c, d with a x + b y + c z + d = 0. */
export function planeRows({caption, label, value, put, context}: Entry): Element[] {
  const plane = value as number[];
  const bounds = context.volume.bounds;
  const normal = plane.slice(0, 3);
  const length = Math.hypot(...normal);
  const [ax, ay, az, bx, by, bz] = bounds;
  const corners = [ax, bx].flatMap((x) => [ay, by].flatMap((y) => [az, bz].map((z) => x * normal[0] + y * normal[1] + z * normal[2])));
  const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const across = ["x", "y", "z"].map((name, i) =>
    button(name, () => put([...axes[i], -(bounds[i] + bounds[i + 3]) / 2]), {"aria-label": `${label} across ${name}`}));
  return [
    row(caption, text(`${label}: a, b, c, d of a x + b y + c z + d = 0`, plane.map((x) => Number(x.toPrecision(6))).join(", "), (words) => {
      const all = numbers(words);
      if (all?.length === 4) {
        put(all);
      } else {
        context.refuse(`${label}: '${words}' are not four numbers`);
      }
    })),
    row("position", slider(`Position of ${label}`, [Math.min(...corners) / length, Math.max(...corners) / length], -plane[3] / length,
      (at, isDone) => put([...normal, -at * length], isDone))),
    row("across", ...across),
  ];
}
