// What lies over the picture: handles of the selected item, and marked points.
import {movable, setAttributes, shape} from "./controls.js";

/** @typedef {{name: string, help: string, at: number[] | null, tied_to: number[] | null, way: number[] | null}} Handle */

export class Overlay {
  /**
   * @param {SVGSVGElement} svg @param {{tell: (message: Record<string, any>) => void, release: () => void}} does
   * @param {(x: number, y: number) => number[]} place a place of the page in pixels of the picture
   */
  constructor(svg, does, place) {
    this.svg = svg;
    this.does = does;
    this.place = place;
    /** @type {Handle[]} */
    this.handles = [];
    this.grips = shape("g");
    this.ties = shape("g");
    this.marks = shape("g");
    svg.append(this.marks, this.ties, this.grips);
    this.names = "";
    this.version = 0;
    /** @type {{index: number, from: number[], to: number[]} | null} what is moved, from where to where in the picture */
    this.held = null;
    this.isWaiting = false;
  }

  /**
   * Places of an older selection are dropped.
   * @param {{version: number, handles: Handle[], points: (number[] | null)[]}} overlay places in the picture
   * @param {number[]} size of the picture @param {number} pixels of the picture in one of the page
   */
  show(overlay, size, pixels) {
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
    const ties = this.handles.filter((handle) => handle.at && handle.tied_to);
    this.ties.replaceChildren(...ties.flatMap((handle) => ["under", "over"].map((name) => {
      const [from, to] = [handle.tied_to ?? [0, 0], handle.at ?? [0, 0]];
      return shape("line", {class: `tie ${name}`, x1: from[0], y1: from[1], x2: to[0], y2: to[1]});
    })));
    this.showPoints(overlay.points, pixels);
  }

  /** @param {(number[] | null)[]} points @param {number} pixels */
  showPoints(points, pixels) {
    const [from, to] = points;
    const line = from && to ? ["under", "over"].map((name) => shape("line", {class: `probe ${name}`, x1: from[0], y1: from[1], x2: to[0], y2: to[1]})) : [];
    const dots = points.flatMap((at) => (at ? [shape("circle", {class: "mark", cx: at[0], cy: at[1], r: 5 * pixels})] : []));
    this.marks.replaceChildren(...line, ...dots);
  }

  /** @param {number} index */
  grip(index) {
    const handle = () => this.handles[index];
    const grip = shape("circle", {class: "grip", tabindex: 0, role: "button", "aria-roledescription": "handle",
      "aria-label": handle().help.replace("Drag: ", "Arrow keys "), "data-name": handle().name});
    grip.append(shape("title", {}, [handle().help]));
    const hold = (/** @type {number[]} */ from) => { this.held ??= {index, from, to: [...from]}; };
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

  /**
   * Not more often than the page is drawn.
   * @param {number[]} to
   */
  move(to) {
    if (this.held) {
      this.held.to = to;
      if (!this.isWaiting) {
        this.isWaiting = true;
        requestAnimationFrame(() => this.flush());
      }
    }
  }

  flush() {
    if (this.isWaiting && this.held) {
      const {index, from, to} = this.held;
      this.does.tell({type: "drag", handle: index, from, to, time: performance.now()});
    }
    this.isWaiting = false;
  }
}
