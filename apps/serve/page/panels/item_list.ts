// The list of what the scene shows, and what can be added to it.
import {button, byId, element} from "../controls.js";
import {keepFocus} from "../focus.js";
import type {AskOrSay, Item, State} from "../messages.js";

const keyOf = (item: Item) => `${item.kind} ${item.index}`;

export class ItemList {
  private readonly list = byId("items", HTMLUListElement);
  private readonly kinds = byId("new-item", HTMLSelectElement);
  private selectedKey = "surface 0";
  private items: Item[] = [];
  /** What it was made of. */
  private shown = "";

  /** `onSelect`: another one is selected. */
  constructor(private readonly ask: AskOrSay, private readonly onSelect: () => void) {
    byId("add", HTMLButtonElement).onclick = () => this.add();
    byId("copy", HTMLButtonElement).onclick = async () => {
      if (this.selected) {
        const {kind, index} = this.selected;
        this.select(await this.ask({type: "copy", kind, index}));
      }
    };
  }

  get selected(): Item | undefined {
    return this.items.find((one) => keyOf(one) === this.selectedKey);
  }

  private select(item: Item | null) {
    if (item) {
      this.selectedKey = keyOf(item);
      this.onSelect();
    }
  }

  private async add() {
    const name = this.kinds.value;
    if (name !== "Isosurface") {
      this.select(await this.ask({type: "add", name}));
      return;
    }
    const range = await this.ask({type: "range"});
    if (range) {
      this.select(await this.ask({type: "add", name, middle: (range.minimum + range.maximum) / 2}));
    }
  }

  show({items, addable}: State) {
    this.items = items;
    const now = JSON.stringify([items, addable, this.selectedKey]);
    if (now === this.shown) {
      return;
    }
    this.shown = now;
    keepFocus(() => this.list.replaceChildren(...items.map((item) => this.row(item))));
    const before = this.kinds.value;
    this.kinds.replaceChildren(...addable.map((item) => element("option", {value: item.name, title: item.help}, [item.name])));
    this.kinds.value = addable.some((item) => item.name === before) ? before : addable[0]?.name ?? "";
  }

  private row(item: Item): Element {
    const {kind, index} = item;
    const isSelected = keyOf(item) === this.selectedKey;
    const visible = element("input", {type: "checkbox", checked: item.shown, "aria-label": `Show ${item.label}`});
    visible.onchange = () => this.ask({type: "show", kind, index, shown: visible.checked});
    return element("li", {className: isSelected ? "selected" : ""}, [
      visible,
      button(item.label, () => this.select(item), {className: "label", "aria-pressed": String(isSelected)}),
      button("✕", () => this.ask({type: "remove", kind, index}), {"aria-label": `Remove ${item.label}`, title: "Remove"}),
    ]);
  }
}
