// Views: from the axes, and those that the scene keeps by their names.
import type {Connection} from "../connection.js";
import type {Context} from "../editor/context.js";
import {button, byId, element, placed, text} from "../controls.js";
import type {AskOrSay} from "../messages.js";
import type {View} from "../scene.js";

/** `names`: of views from the axes. */
export function showStandardViews(names: string[], connection: Connection) {
  byId("views", HTMLElement).replaceChildren(...["all", ...names].map((name) =>
    button(name, () => connection.tell({type: "view", name, time: performance.now()}), {"aria-label": name === "all" ? "Show all" : `View from ${name}`})));
}

export class SavedViews {
  private readonly list = byId("saved-views", HTMLUListElement);
  /** What it was made of. */
  private shown = "";

  constructor(private readonly ask: AskOrSay, private readonly set: Context["set"]) {
    byId("save-view", HTMLButtonElement).onclick = () => this.save();
  }

  private async save() {
    const saved = await this.ask({type: "save scene"});
    if (saved) {
      const views = saved.scene.views ?? [];
      this.set("/views", [...views, {name: `View ${views.length + 1}`, camera: saved.scene.camera}], "views");
    }
  }

  show(views: View[]) {
    const now = JSON.stringify(views);
    if (now === this.shown) {
      return;
    }
    this.shown = now;
    this.list.replaceChildren(...views.map(({name, camera}, index) => element("li", {}, [
      placed(`/views/${index}/name`, text(`Name of view ${index + 1}`, name, (words) => this.set(`/views/${index}/name`, words, "name of a view"))),
      button("Go", () => this.ask({type: "set", pointer: "/camera", value: camera, name: "view"}), {"aria-label": `Go to ${name}`}),
      button("✕", () => this.set(`/views/${index}`, null, "views"), {"aria-label": `Remove ${name}`}),
    ])));
  }
}
