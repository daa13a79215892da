// Values along a line: its ends by two clicks or as numbers, the plot, and the values as text.
import type {Context} from "../editor/context.js";
import {button, buttons, element, numbers, row, text} from "../controls.js";
import type {AskOrSay, Line, Picked} from "../messages.js";
import {plot} from "./plot.js";
import type {Scene} from "../scene.js";
import {sceneText} from "../editor/scene_text.js";

export type Does = {
  ask: AskOrSay; say: (text: string) => void; mark: (points: number[][]) => void;
  download: (name: string, content: string, type: string) => void; check: Context["check"];
};

export class LineProbe {
  private ends: (number[] | null)[] = [null, null];
  private field = "";
  private csv = "";
  /** The end that the next pick sets. */
  private next: number | null = null;
  private isAsking = false;
  private isOutdated = false;
  /** What the values depend on, beside the line. */
  private scene = "";
  private readonly choose = button("Click two points", () => this.setNext(this.next === null ? 0 : null), {"aria-pressed": "false"});
  private readonly inputs = ["First point of the line: x, y, z", "Last point of the line: x, y, z"].map((label, i) =>
    text(label, "", (words) => this.typed(i, words)));
  private readonly fieldInput: HTMLInputElement;
  private readonly shown = element("div", {id: "line-plot"});
  private readonly files: HTMLElement;

  constructor(parent: HTMLElement, private readonly does: Does) {
    const field = sceneText({place: "/field", caption: "Field", label: "Field along the line", check: (words) => does.check("/field", words),
      put: (words) => { this.field = String(words ?? ""); this.sample(); }}, "", (words) => words || null, "fields");
    this.fieldInput = field.input;
    this.files = buttons(button("Copy values", () => this.copy()),
      button("Save values", () => does.download("line.csv", this.csv, "text/csv")));
    this.files.hidden = true;
    parent.replaceChildren(buttons(this.choose, button("Clear", () => this.clear())), row("From", this.inputs[0]), row("To", this.inputs[1]),
      ...field.rows, this.shown, this.files);
  }

  private setNext(next: number | null) {
    this.next = next;
    this.choose.setAttribute("aria-pressed", String(next !== null));
    this.choose.textContent = next === null ? "Click two points" : next === 0 ? "Click the first point" : "Click the last point";
  }

  /** Whether what was picked was for the line. */
  take(picked: Picked): boolean {
    if (this.next === null) {
      return false;
    }
    if (!picked.hit) {
      this.does.say("nothing is there; the line needs a point of the volume");
      return true;
    }
    const isFirst = this.next === 0;
    this.ends = isFirst ? [picked.position, null] : [this.ends[0], picked.position];
    this.setNext(isFirst ? 1 : null);
    this.showEnds();
    this.sample();
    return true;
  }

  private typed(end: number, words: string) {
    const all = numbers(words);
    this.ends[end] = all?.length === 3 ? all : null;
    if (words !== "" && !this.ends[end]) {
      this.does.say(`'${words}' are not three numbers x, y, z`);
    }
    this.mark(null);
    this.sample();
  }

  private showEnds() {
    this.ends.forEach((end, i) => { this.inputs[i].value = end ? end.map((x) => Number(x.toPrecision(9))).join(", ") : ""; });
    this.mark(null);
  }

  /** The ends in the picture, and the place of the cursor, a share of the line. */
  mark(share: number | null) {
    const [from, to] = this.ends;
    const points = this.ends.flatMap((end) => (end ? [end] : []));
    if (from && to && share !== null) {
      points.push(from.map((x, i) => x + share * (to[i] - x)));
    }
    this.does.mark(points);
  }

  private clear() {
    this.ends = [null, null];
    this.csv = "";
    this.files.hidden = true;
    this.shown.replaceChildren();
    this.setNext(null);
    this.showEnds();
  }

  /** Where the values change with the scene, they are asked for again. `field`: the scene's. */
  follow(scene: Scene, field: string) {
    this.fieldInput.placeholder = field;
    const now = JSON.stringify([field, scene.volume?.time_step, scene.warp]);
    if (now !== this.scene) {
      this.scene = now;
      this.sample();
    }
  }

  private async sample() {
    const [from, to] = this.ends;
    if (!from || !to) {
      return;
    }
    this.isOutdated = this.isAsking;
    if (this.isAsking) {
      return;
    }
    this.isAsking = true;
    const line = await this.does.ask({type: "line", from, to, ...(this.field ? {fields: [this.field]} : {})});
    this.isAsking = false;
    if (line && this.ends[0] === from && this.ends[1] === to) {
      this.show(line);
    }
    if (this.isOutdated) {
      this.sample();
    }
  }

  private show(line: Line) {
    this.csv = line.csv;
    this.files.hidden = false;
    const words = line.no_breaks_because ? `where elements begin and end is not known: ${line.no_breaks_because}`
      : `elements begin or end at ${line.breaks.length} places` + (line.n_outside ? `; ${line.n_outside} points lie in no element` : "");
    this.shown.replaceChildren(plot(line, (at) => this.mark(at === null ? null : at / line.length)), element("p", {className: "quiet"}, [words]));
  }

  private async copy() {
    try {
      await navigator.clipboard.writeText(this.csv);
    } catch {
      // Frames and plain HTTP may not have the clipboard: by a selection.
      const area = element("textarea", {value: this.csv, readOnly: true, "aria-label": "Values"});
      document.body.append(area);
      area.select();
      const isCopied = document.execCommand("copy");
      area.remove();
      if (!isCopied) {
        this.does.say("the browser does not allow to copy; save the values instead");
      }
    }
  }
}
