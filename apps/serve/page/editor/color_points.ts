// The points of a colour map on its scale: dragged, added and removed.
import {hexOf, movable, setAttributes, shape} from "../controls.js";
import type {ColorMap} from "../scene.js";
import type {Context} from "./context.js";
import {colorAt, withMovedPoints} from "./palette.js";
import {withPoint} from "./point_rows.js";

/** Of the scale's width: between points. */
const leastGap = 1e-3;

/** `at`: the place on the scale, from 0 to 1, of the pointer; `x`: where a place is in the drawing; `palette`: of the map. */
export type Scale = {drawing: SVGSVGElement; middle: number; at: (event: MouseEvent) => number; x: (at: number) => number; palette: () => number[][]; draw: () => void};

/** The ends are those of the range, and stay: the points between them have grips. */
export class ColorPoints {
  /** Positions in the scene are any numbers, whose first is the lower end of the range. */
  private readonly first: number;
  private readonly width: number;
  private readonly before: number[];
  private readonly places: number[];
  private readonly inner: number[];
  readonly grips: SVGElement[];

  constructor(private readonly place: string, private readonly map: ColorMap, private readonly points: number[][], private readonly context: Context, private readonly scale: Scale) {
    this.first = points[0][0];
    this.width = points[points.length - 1][0] - this.first;
    this.before = points.map((point) => (point[0] - this.first) / this.width);
    this.places = [...this.before];
    this.inner = points.map((_, i) => i).slice(1, -1);
    this.grips = this.inner.map((i) => this.grip(i));
    scale.drawing.addEventListener("dblclick", (event) => {
      if (!(event.target instanceof Element && event.target.classList.contains("color-point"))) {
        this.add(scale.at(event));
      }
    });
  }

  /** Of a map that has some, each at another place. */
  static of(place: string, map: ColorMap, context: Context, scale: Scale): ColorPoints | null {
    const points = map.points ?? [];
    return points.length > 1 && points[points.length - 1][0] > points[0][0] ? new ColorPoints(place, map, points, context, scale) : null;
  }

  /** The palette as the hand has it now. */
  palette(): number[][] {
    return withMovedPoints(this.scale.palette(), this.before, this.places);
  }

  draw() {
    this.inner.forEach((i, at) => setAttributes(this.grips[at], {cx: this.scale.x(this.places[i]), "aria-valuenow": this.position(this.places[i])}));
  }

  private position(at: number): number {
    return Number((this.first + at * this.width).toPrecision(9));
  }

  private grip(i: number): SVGElement {
    const grip = shape("circle", {class: "color-point", r: 6, cy: this.scale.middle, tabindex: 0, role: "slider", fill: hexOf(this.points[i].slice(1, 4)),
      "aria-label": `Point ${i + 1} of the colours`, "aria-valuemin": this.position(0), "aria-valuemax": this.position(1)});
    grip.append(shape("title", {}, ["Drag, or arrow keys; Delete or the right button removes it"]));
    movable(grip, {
      drag: (event) => this.move(i, this.scale.at(event)),
      arrow: ([dx, dy]) => this.move(i, this.places[i] + 0.01 * (dx - dy)),
      done: () => this.context.release(),
      other: (event) => (event.key === "Delete" || event.key === "Backspace") && this.remove(i),
    });
    grip.addEventListener("contextmenu", (event) => { event.preventDefault(); this.remove(i); });
    return grip;
  }

  /** Between its neighbours. */
  private move(i: number, wanted: number) {
    const low = this.places[i - 1] + leastGap, high = this.places[i + 1] - leastGap;
    if (low <= high) {
      this.places[i] = Math.min(high, Math.max(low, wanted));
      this.context.set(`${this.place}/points/${i}/0`, this.position(this.places[i]), "move a colour", false);
      this.scale.draw();
    }
  }

  private remove(i: number): boolean {
    this.context.set(`${this.place}/points`, this.points.filter((_, j) => j !== i), "remove a colour");
    return true;
  }

  private async add(at: number) {
    if (at > leastGap && at < 1 - leastGap) {
      const color = colorAt(await this.context.histograms.palette(this.map), at).map((part) => Number(part.toPrecision(4)));
      this.context.set(`${this.place}/points`, withPoint(this.points, [this.position(at), ...color]), "add a colour");
    }
  }
}
