// The picture: frames as they come, and marks on their pixels.
import type {Connection} from "../connection.js";
import {byId} from "../controls.js";
import type {Frame, Place, Size, Stage} from "../messages.js";

export const marks: Record<Stage, string> = {moving: "◔ moving, fewer pixels", full: "◑ full", exact: "● pixel-exact"};

export class Picture {
  readonly view = byId("view", HTMLElement);
  private readonly canvas = byId("picture", HTMLCanvasElement);
  private readonly overlay = byId("overlay", HTMLCanvasElement);
  /** The bytes of the pixel-exact picture that is shown. */
  exact: Uint8Array | null = null;
  stage: Stage | "" = "";
  size: Size = [1, 1];
  /** For measurements: when each frame came, and how long after what it shows. */
  readonly times: {at: number; late: number}[] = [];

  constructor(private readonly connection: Connection, private readonly onFrame: (frame: Frame) => void) {
    new ResizeObserver(() => this.resize()).observe(this.view);
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.connection.tell({
      type: "resize",
      width: Math.max(1, Math.round(this.view.clientWidth * ratio)),
      height: Math.max(1, Math.round(this.view.clientHeight * ratio)),
    });
  }

  async show(frame: Frame, bytes: Uint8Array) {
    try {
      const image = await createImageBitmap(new Blob([bytes], {type: frame.mime}));
      const [width, height] = frame.size;
      if (this.canvas.width !== width || this.canvas.height !== height) {
        this.canvas.width = width;
        this.canvas.height = height;
      }
      const context = this.canvas.getContext("2d");
      context?.clearRect(0, 0, width, height);
      context?.drawImage(image, 0, 0, width, height);
      image.close();
    } finally {
      this.connection.tell({type: "shown", frame: frame.frame});
    }
    this.stage = frame.stage;
    this.size = frame.size;
    this.exact = frame.stage === "exact" ? bytes : null;
    this.times.push({at: performance.now(), late: frame.echo ? performance.now() - frame.echo : NaN});
    this.times.splice(0, this.times.length - 1000);
    this.hideMask();
    this.onFrame(frame);
  }

  /** Marks pixels, a bit each. */
  showMask([width, height]: Size, bits: Uint8Array) {
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

  /** A place on the page in pixels of the picture. */
  place(x: number, y: number): Place {
    const box = this.view.getBoundingClientRect();
    return [((x - box.left) * this.size[0]) / box.width, ((y - box.top) * this.size[1]) / box.height];
  }
}
