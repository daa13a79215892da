// Integrals and extrema: what is asked for, and the answer as a table.
import type {Context} from "../editor/context.js";
import {sceneText} from "../editor/scene_text.js";
import {button, buttons, check, choice, element, number, numbers, row, text} from "../controls.js";
import type {Ask, Domain, Extrema, Extremum, Integral} from "../messages.js";
import type {Json, Scene} from "../scene.js";
import {valueTable} from "./value_table.js";
import type {Work} from "./work.js";

/** `ask` raises what is wrong; `plane`: of the selected item, if it is one. */
export type IntegralTools = {ask: Ask; check: Context["check"]; work: Work; field: () => string; plane: () => number[] | undefined};

type Name = Domain["domain"];

export class IntegralPanel {
  private domain: Name = "volume";
  private field = "";
  private levelField = "";
  private groups: string[] = [];
  private isovalue: number | null = null;
  private isFlux = false;
  private readonly plane = text("Plane of the integral: a, b, c, d", "", () => {});
  private readonly level = number("Value of the integral's isosurface", null, (value) => { this.isovalue = value; });
  private readonly own: Record<Name, HTMLElement>;
  private readonly flux: HTMLElement;
  private readonly fieldInput: HTMLInputElement;
  private readonly answer = element("div", {id: "integral", "aria-live": "polite"});

  constructor(parent: HTMLElement, private readonly tools: IntegralTools) {
    const field = this.fieldText("Field", "Field of the integral", (words) => { this.field = words; });
    const levelField = this.fieldText("Of", "Field of the integral's isosurface", (words) => { this.levelField = words; });
    const groups = text("Groups of the boundary, with commas", "", (words) => { this.groups = words.split(",").map((one) => one.trim()).filter(Boolean); }, "groups");
    groups.placeholder = "all";
    this.fieldInput = field.input;
    this.level.placeholder = "";
    this.flux = row("", check("flux of a vector", false, (is) => { this.isFlux = is; }));
    const part = (...rows: Element[]) => element("div", {}, rows);
    this.own = {
      volume: part(),
      boundary: part(row("Groups", groups)),
      plane: part(row("Plane", this.plane)),
      isosurface: part(row("Value", this.level), ...levelField.rows),
    };
    const domains = choice("What is integrated over", ["volume", "boundary", "plane", "isosurface"], this.domain, (word) => {
      this.domain = word as Name;
      this.showDomain();
    });
    parent.replaceChildren(row("Over", domains), ...Object.values(this.own), ...field.rows, this.flux,
      buttons(button("Integrate", () => this.integrate()), button("Extrema", () => this.extrema())), this.answer);
    this.showDomain();
  }

  private fieldText(caption: string, label: string, put: (words: string) => void) {
    const {check} = this.tools;
    return sceneText({place: "/field", caption, label, check: (words) => check("/field", words), put: (words) => put(String(words ?? ""))},
      "", (words) => words || null, "fields");
  }

  private showDomain() {
    for (const [name, part] of Object.entries(this.own)) {
      part.hidden = name !== this.domain;
    }
    this.flux.hidden = this.domain === "volume";
  }

  /** What is taken where nothing is said. */
  follow(scene: Scene) {
    this.fieldInput.placeholder = "1";
    this.plane.placeholder = (this.tools.plane() ?? []).join(", ");
    // What the answer depends on has changed.
    const now = JSON.stringify([scene.volume?.time_step, scene.warp]);
    if (this.answer.dataset.scene !== now) {
      this.answer.dataset.scene = now;
      this.answer.replaceChildren();
    }
  }

  private wanted(): Domain {
    switch (this.domain) {
    case "volume":
      return {domain: "volume"};
    case "boundary":
      return {domain: "boundary", groups: this.groups};
    case "plane": {
      const plane = numbers(this.plane.value || this.plane.placeholder);
      if (plane?.length !== 4) {
        throw new Error("a plane has four numbers: a, b, c, d of a x + b y + c z + d = 0");
      }
      return {domain: "plane", plane};
    }
    case "isosurface":
      if (this.isovalue === null) {
        throw new Error("an isosurface has a value");
      }
      return {domain: "isosurface", isovalue: this.isovalue, level_field: this.levelField || this.tools.field()};
    }
  }

  private async integrate() {
    const found = await this.tools.work.run("integrating", async () =>
      this.tools.ask({type: "integrate", ...this.wanted(), field: this.field, flux: this.isFlux && this.domain !== "volume"}));
    if (found) {
      this.answer.replaceChildren(valueTable(integralRows(found.integral)), ...found.doubts.map((doubt) => element("p", {className: "quiet"}, [doubt])));
    }
  }

  private async extrema() {
    const found = await this.tools.work.run("finding extrema", () => this.tools.ask({type: "extrema", field: this.field || this.tools.field()}));
    if (found) {
      this.answer.replaceChildren(valueTable(extremaRows(found.extrema)));
    }
  }
}

type Rows = [string, Json | undefined][];

const integralRows = (integral: Integral): Rows => [
  ["integral", integral.value], ["error", integral.exact ? `${integral.error}, of rounding` : integral.error],
  ["measure", integral.measure], ["its error", integral.measure_error],
  ["within tolerance", integral.converged ? "yes" : "no"], ["parts", integral.parts], ["evaluations", integral.evaluations]];

const extremumRows = (name: string, {value, interval, element, xi, position}: Extremum): Rows => [
  [name, value], ...(interval ? [["lies in", interval] as [string, Json]] : []), ["at", position], ["element", element], ["xi", xi]];

const extremaRows = ({field, certainty, minimum, maximum}: Extrema): Rows =>
  [["field", field], ["they are", certainty], ...extremumRows("minimum", minimum), ...extremumRows("maximum", maximum)];
