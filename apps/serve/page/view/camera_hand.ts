// The hand that moves the camera: mouse, fingers, wheel and keys over the picture.
import type {Connection} from "../connection.js";
import type {Message} from "../messages.js";
import type {Picture} from "./picture.js";

/** Between messages of one movement. */
const pointerMilliseconds = 1000 / 60;
/** So far a click may slip, in pixels of the page. */
const mostOfClick = 3;

type Motion = Message<"orbit" | "pan" | "zoom">;
const keyWays = new Map([["ArrowLeft", [-1, 0]], ["ArrowRight", [1, 0]], ["ArrowUp", [0, -1]], ["ArrowDown", [0, 1]]]);

export class CameraHand {
  private readonly view: HTMLElement;
  /** Where they are, by their numbers. */
  private readonly pointers = new Map<number, [number, number]>();
  private travelled = 0;
  private wheelEnd = 0;
  private sent = 0;
  private motion: Motion | null = null;

  /** `onPick`: of a place in pixels of the picture. */
  constructor(private readonly connection: Connection, private readonly picture: Picture, private readonly onPick: (column: number, row: number) => void) {
    this.view = picture.view;
    this.view.addEventListener("pointerdown", (event) => this.take(event));
    this.view.addEventListener("pointermove", (event) => this.follow(event));
    this.view.addEventListener("pointerup", (event) => this.letGo(event));
    this.view.addEventListener("pointercancel", (event) => this.letGo(event));
    this.view.addEventListener("contextmenu", (event) => event.preventDefault());
    this.view.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    this.view.addEventListener("keydown", (event) => this.key(event));
    this.view.addEventListener("keyup", () => this.release());
  }

  /** Movements add up until it is time for a message. */
  private move(message: Motion) {
    const before = this.motion;
    if (before?.type === "zoom" && message.type === "zoom") {
      this.motion = {...message, factor: Math.min(100, Math.max(0.01, before.factor * message.factor))};
    } else if (before && before.type !== "zoom" && message.type === before.type) {
      this.motion = {...message, dx: before.dx + message.dx, dy: before.dy + message.dy};
    } else {
      this.flush();
      this.motion = message;
    }
    const wait = pointerMilliseconds - (performance.now() - this.sent);
    if (wait <= 0) {
      this.flush();
    } else {
      setTimeout(() => this.flush(), wait);
    }
  }

  private flush() {
    if (this.motion) {
      this.sent = performance.now();
      this.connection.tell({...this.motion, time: this.sent});
      this.motion = null;
    }
  }

  private release() {
    this.flush();
    this.connection.tell({type: "release"});
  }

  private take(event: PointerEvent) {
    this.view.setPointerCapture(event.pointerId);
    this.view.focus();
    this.travelled = this.pointers.size ? Infinity : 0;
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    event.preventDefault();
  }

  private follow(event: PointerEvent) {
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    this.travelled += Math.hypot(event.clientX - before[0], event.clientY - before[1]);
    if (this.pointers.size === 2) {
      this.pinch(event, before);
    } else if (this.travelled > mostOfClick) {
      const [x0, y0] = this.picture.place(before[0], before[1]);
      const [x1, y1] = this.picture.place(event.clientX, event.clientY);
      this.move({type: event.shiftKey || event.buttons & 6 ? "pan" : "orbit", dx: x1 - x0, dy: y1 - y0});
    } else {
      return;
    }
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  private letGo(event: PointerEvent) {
    if (!this.pointers.delete(event.pointerId)) {
      return;
    }
    if (event.type === "pointerup" && this.travelled <= mostOfClick && event.button === 0) {
      this.onPick(...this.picture.place(event.clientX, event.clientY));
    }
    this.release();
  }

  /** Two fingers: their distance zooms, their middle moves. */
  private pinch(event: PointerEvent, before: [number, number]) {
    const other = [...this.pointers.entries()].find(([id]) => id !== event.pointerId);
    if (!other) {
      return;
    }
    const [ox, oy] = other[1];
    const was = Math.max(1, Math.hypot(before[0] - ox, before[1] - oy));
    const is = Math.max(1, Math.hypot(event.clientX - ox, event.clientY - oy));
    const [x, y] = this.picture.place((event.clientX + ox) / 2, (event.clientY + oy) / 2);
    const [x0, y0] = this.picture.place((before[0] + ox) / 2, (before[1] + oy) / 2);
    this.connection.tell({type: "pan", dx: x - x0, dy: y - y0});
    this.connection.tell({type: "zoom", x, y, factor: was / is, time: performance.now()});
  }

  private wheel(event: WheelEvent) {
    event.preventDefault();
    const [x, y] = this.picture.place(event.clientX, event.clientY);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    this.move({type: "zoom", x, y, factor: Math.min(4, Math.max(0.25, Math.exp(0.0015 * lines * event.deltaY)))});
    clearTimeout(this.wheelEnd);
    this.wheelEnd = window.setTimeout(() => this.release(), 200);
  }

  private key(event: KeyboardEvent) {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const step = this.picture.size[1] / 36;
    const way = keyWays.get(event.key);
    const middle = {x: this.picture.size[0] / 2, y: this.picture.size[1] / 2};
    if (way) {
      this.move({type: event.shiftKey ? "pan" : "orbit", dx: step * way[0], dy: step * way[1]});
    } else if (event.key === "+" || event.key === "=") {
      this.move({type: "zoom", ...middle, factor: 0.9});
    } else if (event.key === "-") {
      this.move({type: "zoom", ...middle, factor: 1 / 0.9});
    } else if (event.key === "f" || event.key === "F") {
      this.connection.tell({type: "view", name: "all"});
    } else if (event.key === "Enter") {
      this.onPick(middle.x, middle.y);
    } else {
      return;
    }
    event.preventDefault();
  }
}
