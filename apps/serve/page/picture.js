// The picture: frames as they come, the hand that moves the camera, and what lies over the picture.
import {Connection} from "./connection.js";

const marks = {moving: "◔ moving, fewer pixels", full: "◑ full", exact: "● pixel-exact"};
/** Between messages of one movement. */
const pointerMilliseconds = 1000 / 60;

/** @param {string} id */
const canvas = (id) => /** @type {HTMLCanvasElement} */ (document.getElementById(id));

export class Picture {
  /** @param {Connection} connection @param {(column: number, row: number) => void} onPick */
  constructor(connection, onPick) {
    this.connection = connection;
    this.onPick = onPick;
    this.view = /** @type {HTMLElement} */ (document.getElementById("view"));
    this.canvas = canvas("picture");
    this.overlay = canvas("overlay");
    /**
     * The bytes of the pixel-exact picture that is shown.
     * @type {Uint8Array | null}
     */
    this.exact = null;
    this.stage = "";
    this.size = [1, 1];
    /** @type {(facts: Record<string, any>) => void} */
    this.onFrame = () => {};
    /**
     * For measurements: when each frame came, and how long after what it shows.
     * @type {{at: number, late: number}[]}
     */
    this.times = [];
    this.pointers = new Map();
    this.sent = 0;
    /** @type {Record<string, any> | null} */
    this.motion = null;
    new ResizeObserver(() => this.resize()).observe(this.view);
    this.listen();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.connection.tell({
      type: "resize",
      width: Math.max(1, Math.round(this.view.clientWidth * ratio)),
      height: Math.max(1, Math.round(this.view.clientHeight * ratio)),
    });
  }

  /** @param {Record<string, any>} facts @param {Uint8Array} bytes */
  async show(facts, bytes) {
    try {
      const image = await createImageBitmap(new Blob([bytes], {type: facts.mime}));
      const [width, height] = facts.size;
      if (this.canvas.width !== width || this.canvas.height !== height) {
        this.canvas.width = width;
        this.canvas.height = height;
      }
      const context = this.canvas.getContext("2d");
      context?.clearRect(0, 0, width, height);
      context?.drawImage(image, 0, 0, width, height);
      image.close();
    } finally {
      this.connection.tell({type: "shown", frame: facts.frame});
    }
    this.stage = facts.stage;
    this.size = facts.size;
    this.exact = facts.stage === "exact" ? bytes : null;
    this.times.push({at: performance.now(), late: facts.echo ? performance.now() - facts.echo : NaN});
    this.times.splice(0, this.times.length - 1000);
    this.hideMask();
    this.onFrame(facts);
  }

  /** @param {string} stage */
  static mark(stage) {
    return marks[/** @type {keyof marks} */ (stage)] ?? stage;
  }

  /**
   * Marks pixels, a bit each.
   * @param {number} width @param {number} height @param {Uint8Array} bits
   */
  showMask(width, height, bits) {
    this.overlay.width = width;
    this.overlay.height = height;
    const context = this.overlay.getContext("2d");
    if (!context) {
      return;
    }
    const image = context.createImageData(width, height);
    for (let i = 0; i < width * height; ++i) {
      if (bits[i >> 3] & (0x80 >> (i & 7))) {
        image.data.set([255, 0, 255, 255], 4 * i);
      }
    }
    context.putImageData(image, 0, 0);
  }

  hideMask() {
    this.overlay.getContext("2d")?.clearRect(0, 0, this.overlay.width, this.overlay.height);
  }

  /**
   * A place on the page in pixels of the picture.
   * @param {number} x @param {number} y
   */
  place(x, y) {
    const box = this.view.getBoundingClientRect();
    return [((x - box.left) * this.size[0]) / box.width, ((y - box.top) * this.size[1]) / box.height];
  }

  /**
   * Movements add up until it is time for a message.
   * @param {Record<string, any>} message
   */
  move(message) {
    if (this.motion && this.motion.type === message.type && message.type !== "zoom") {
      this.motion.dx += message.dx;
      this.motion.dy += message.dy;
    } else if (this.motion && this.motion.type === "zoom" && message.type === "zoom") {
      this.motion = {...message, factor: Math.min(100, Math.max(0.01, this.motion.factor * message.factor))};
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

  flush() {
    if (this.motion) {
      this.sent = performance.now();
      this.connection.tell({...this.motion, time: this.sent});
      this.motion = null;
    }
  }

  release() {
    this.flush();
    this.connection.tell({type: "release"});
  }

  listen() {
    const view = this.view;
    let travelled = 0;
    view.addEventListener("pointerdown", (event) => {
      view.setPointerCapture(event.pointerId);
      view.focus();
      travelled = this.pointers.size ? 1e9 : 0;
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
      event.preventDefault();
    });
    view.addEventListener("pointermove", (event) => {
      const before = this.pointers.get(event.pointerId);
      if (!before) {
        return;
      }
      travelled += Math.hypot(event.clientX - before[0], event.clientY - before[1]);
      if (this.pointers.size === 2) {
        this.pinch(event);
      } else if (travelled > 3) {
        const [x0, y0] = this.place(before[0], before[1]);
        const [x1, y1] = this.place(event.clientX, event.clientY);
        const type = event.shiftKey || event.buttons & 6 ? "pan" : "orbit";
        this.move({type, dx: x1 - x0, dy: y1 - y0});
      } else {
        return;
      }
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    const end = (/** @type {PointerEvent} */ event) => {
      if (!this.pointers.delete(event.pointerId)) {
        return;
      }
      if (event.type === "pointerup" && travelled <= 3 && event.button === 0) {
        const [column, row] = this.place(event.clientX, event.clientY);
        this.onPick(column, row);
      }
      this.release();
    };
    view.addEventListener("pointerup", end);
    view.addEventListener("pointercancel", end);
    view.addEventListener("contextmenu", (event) => event.preventDefault());
    let wheelEnd = 0;
    view.addEventListener("wheel", (event) => {
      event.preventDefault();
      const [x, y] = this.place(event.clientX, event.clientY);
      const lines = event.deltaMode === 1 ? 16 : 1;
      this.move({type: "zoom", x, y, factor: Math.min(4, Math.max(0.25, Math.exp(0.0015 * lines * event.deltaY)))});
      clearTimeout(wheelEnd);
      wheelEnd = window.setTimeout(() => this.release(), 200);
    }, {passive: false});
    view.addEventListener("keydown", (event) => this.key(event));
    view.addEventListener("keyup", () => this.release());
  }

  /**
   * Two fingers: their distance zooms, their middle moves.
   * @param {PointerEvent} event
   */
  pinch(event) {
    const fingers = [...this.pointers.entries()];
    const other = fingers.find(([id]) => id !== event.pointerId);
    const before = this.pointers.get(event.pointerId);
    if (!other || !before) {
      return;
    }
    const [ox, oy] = other[1];
    const was = Math.max(1, Math.hypot(before[0] - ox, before[1] - oy));
    const is = Math.max(1, Math.hypot(event.clientX - ox, event.clientY - oy));
    const [x, y] = this.place((event.clientX + ox) / 2, (event.clientY + oy) / 2);
    const [x0, y0] = this.place((before[0] + ox) / 2, (before[1] + oy) / 2);
    this.connection.tell({type: "pan", dx: x - x0, dy: y - y0});
    this.connection.tell({type: "zoom", x, y, factor: was / is, time: performance.now()});
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const step = this.size[1] / 36;
    const directions = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
    const direction = directions[/** @type {keyof directions} */ (event.key)];
    const middle = {x: this.size[0] / 2, y: this.size[1] / 2};
    if (direction) {
      this.move({type: event.shiftKey ? "pan" : "orbit", dx: direction[0], dy: direction[1]});
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
