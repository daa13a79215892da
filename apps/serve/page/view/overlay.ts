// What lies over the picture: handles of the selected item, and marked points.
import {movable, setAttributes, shape} from "../controls.js";
import type {Handle, Message, OverlayPlaces, Place, Size} from "../messages.js";

export class Overlay {
  private handles: Handle[] = [];
  private readonly grips = shape("g");
  private readonly ties = shape("g");
  private readonly marks = shape("g");
  private names = "";
  version = 0;
  /** What is moved, from where to where in the picture. */
  private held: {index: number; from: number[]; to: number[]} | null = null;
  private isWaiting = false;

  /** `place`: of a place of the page, in pixels of the picture. */
  constructor(private readonly svg: SVGSVGElement, private readonly does: {tell: (message: Message) => void; release: () => void},
              private readonly place: (x: number, y: number) => Place) {
    svg.append(this.marks, this.ties, this.grips);
  }

  /** Of a picture of that size, of which so many pixels are one of the page. Places of an older selection are dropped. */
  show(overlay: OverlayPlaces, size: Size, pixels: number) {
    if (overlay.version < this.version) {
      return;
    }
    this.version = overlay.version;
    setAttributes(this.svg, {viewBox: `0 0 ${size[0]} ${size[1]}`});
    this.handles = overlay.handles;
    const names = overlay.handles.map((handle) => handle.help).join("\n");
    if (names !== this.names) {
      this.names = names;
      this.held = null;
      this.grips.replaceChildren(...overlay.handles.map((_, index) => this.grip(index)));
    }
    this.handles.forEach((handle, index) => {
      const [x, y] = handle.at ?? [0, 0];
      setAttributes(this.grips.children[index], {cx: x, cy: y, r: 9 * pixels, visibility: handle.at ? "visible" : "hidden"});
    });
    this.ties.replaceChildren(...this.handles.flatMap(({at, tied_to}) => (at && tied_to ? lines("tie", tied_to, at) : [])));
    this.showPoints(overlay.points, pixels);
  }

  private showPoints(points: (Place | null)[], pixels: number) {
    const [from, to] = points;
    const dots = points.flatMap((at) => (at ? [shape("circle", {class: "mark", cx: at[0], cy: at[1], r: 5 * pixels})] : []));
    this.marks.replaceChildren(...(from && to ? lines("probe", from, to) : []), ...dots);
  }

  private grip(index: number): SVGCircleElement {
    const handle = () => this.handles[index];
    const grip = shape("circle", {class: "grip", tabindex: 0, role: "button", "aria-roledescription": "handle",
      "aria-label": handle().help.replace("Drag: ", "Arrow keys "), "data-name": handle().name});
    grip.append(shape("title", {}, [handle().help]));
    const hold = (from: number[]) => { this.held ??= {index, from, to: [...from]}; };
    movable(grip, {
      start: (event) => { this.held = null; hold(this.place(event.clientX, event.clientY)); },
      drag: (event) => this.move(this.place(event.clientX, event.clientY)),
      arrow: ([dx, dy]) => {
        const {at, way, name} = handle();
        if (at) {
          hold(at);
          const step = this.svg.viewBox.baseVal.height / 200;
          const along = name === "move" || name === "radius" ? way : null;
          const [x, y] = along ? along.map((part) => part * (dx - dy)) : [dx, dy];
          const to = this.held?.to ?? at;
          this.move([to[0] + x * step, to[1] + y * step]);
        }
      },
      done: () => {
        this.flush();
        this.held = null;
        this.does.release();
      },
    });
    return grip;
  }

  /** Not more often than the page is drawn. */
  private move(to: number[]) {
    if (this.held) {
      this.held.to = to;
      if (!this.isWaiting) {
        this.isWaiting = true;
        requestAnimationFrame(() => this.flush());
      }
    }
  }

  private flush() {
    if (this.isWaiting && this.held) {
      const {index, from, to} = this.held;
      this.does.tell({type: "drag", handle: index, from, to, time: performance.now()});
    }
    this.isWaiting = false;
  }
}

/** With a dark one below, to be seen on any ground. */
const lines = (kind: string, from: Place, to: Place) =>
  ["under", "over"].map((name) => shape("line", {class: `${kind} ${name}`, x1: from[0], y1: from[1], x2: to[0], y2: to[1]}));
