// Controls of panels: what people change goes out as a value, what the scene says comes in.

export type Child = Node | string;
export type Attributes = Record<string, string | number | boolean>;

/** The one of that id, which the page has. */
export function byId<T extends Element>(id: string, kind: new () => T): T {
  const node = document.getElementById(id);
  if (!(node instanceof kind)) {
    throw new Error(`the page has no ${kind.name} '${id}'`);
  }
  return node;
}

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, properties: Attributes = {}, children: Child[] = []): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.includes("-") || key === "role" || key === "for" || key === "list") {
      node.setAttribute(key, String(value));
    } else {
      Object.assign(node, {[key]: value});
    }
  }
  node.append(...children);
  return node;
}

export const buttons = (...all: Child[]) => element("p", {className: "row buttons"}, all);

const drawing = "http://www.w3.org/2000/svg";

/** Of a drawing in SVG. */
export function shape<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, children: Child[] = []): SVGElementTagNameMap[K] {
  const node = document.createElementNS(drawing, tag);
  setAttributes(node, attributes);
  node.append(...children);
  return node;
}

export function setAttributes(node: Element, attributes: Attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    node.setAttribute(key, String(value));
  }
}

/** What somebody holds in the hand must not be made anew. */
export const hand = {isBusy: false};

const arrows = new Map([["ArrowLeft", [-1, 0]], ["ArrowRight", [1, 0]], ["ArrowUp", [0, -1]], ["ArrowDown", [0, 1]]]);

/** The way of an arrow key, ten times as long with Shift. */
export function arrowOf(event: KeyboardEvent): number[] | null {
  const way = arrows.get(event.key);
  return way && !event.ctrlKey && !event.metaKey && !event.altKey ? way.map((x) => x * (event.shiftKey ? 10 : 1)) : null;
}

/** `other`: another key; whether it was one of its own. */
export type Moves = {
  drag: (event: PointerEvent) => void; arrow: (way: number[]) => void; done: () => void; start?: (event: PointerEvent) => void;
  other?: (event: KeyboardEvent) => boolean;
};

/** Something that is moved with the hand or with arrow keys. */
export function movable(node: SVGElement, does: Moves) {
  let isHeld = false, isMoved = false;
  node.addEventListener("pointerdown", (event) => {
    if (event.button === 0) {
      isHeld = hand.isBusy = true;
      node.setPointerCapture(event.pointerId);
      node.focus();
      does.start?.(event);
    }
    event.stopPropagation();
    event.preventDefault();
  });
  node.addEventListener("pointermove", (event) => {
    if (isHeld) {
      does.drag(event);
    }
  });
  const end = () => {
    if (isHeld) {
      isHeld = hand.isBusy = false;
      does.done();
    }
  };
  node.addEventListener("pointerup", end);
  node.addEventListener("pointercancel", end);
  node.addEventListener("keydown", (event) => {
    const way = arrowOf(event);
    if (way) {
      isMoved = true;
      does.arrow(way);
    }
    if (way || does.other?.(event)) {
      event.preventDefault();
      event.stopPropagation();
    }
  });
  node.addEventListener("keyup", (event) => {
    if (isMoved) {
      isMoved = false;
      does.done();
      event.stopPropagation();
    }
  });
}

export const row = (caption: string, ...controls: Child[]) =>
  element("p", {className: "row"}, [element("span", {className: "caption"}, [caption]), ...controls]);

/** Marks a control by the place of the scene that it sets. */
export function placed<T extends Element>(place: string, node: T): T {
  node.setAttribute("data-place", place);
  return node;
}

export function choice(label: string, words: string[], value: string, onChange: (value: string) => void): HTMLSelectElement {
  const all = words.includes(value) ? words : [value, ...words];
  const select = element("select", {"aria-label": label}, all.map((word) => element("option", {value: word}, [word || "default"])));
  select.value = value;
  select.onchange = () => onChange(select.value);
  return select;
}

export function text(label: string, value: string, onChange: (value: string) => void, list?: string): HTMLInputElement {
  const input = element("input", {type: "text", "aria-label": label, value});
  if (list) {
    input.setAttribute("list", list);
  }
  input.onchange = () => onChange(input.value.trim());
  return input;
}

/** Empty is nothing. `node`: of the schema; whether it is an integer, and what it is if nothing is said. */
export function number(label: string, value: number | null, onChange: (value: number | null) => void,
                       node: {type?: string; default?: unknown} = {}): HTMLInputElement {
  const input = element("input", {type: "number", step: node.type === "integer" ? 1 : "any",
    "aria-label": label, value: value ?? "", placeholder: String(node.default ?? "auto")});
  input.onchange = () => onChange(input.value === "" ? null : Number(input.value));
  return input;
}

/** `isDone`: the hand has let go. */
export function slider(label: string, ends: [number, number], value: number, onChange: (value: number, isDone: boolean) => void): HTMLInputElement {
  const input = element("input", {type: "range", min: ends[0], max: ends[1], step: "any", "aria-label": label});
  input.value = String(value);
  input.oninput = () => onChange(Number(input.value), false);
  input.onchange = () => onChange(Number(input.value), true);
  return input;
}

export function button(label: string, onClick: () => void, properties: Attributes = {}): HTMLButtonElement {
  const node = element("button", properties, [label]);
  node.onclick = onClick;
  return node;
}

export const hexOf = (rgb: number[]) =>
  "#" + rgb.map((x) => Math.round(255 * Math.min(1, Math.max(0, x))).toString(16).padStart(2, "0")).join("");

/** Of "#rrggbb". */
export const rgbOf = (hex: string) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

/**
 * A colour to be chosen, and its numbers, which may be finer and, of light, above 1. A fourth, of `most`, is how opaque it is.
 */
export function colorControls(label: string, color: number[], onChange: (color: number[]) => void, most = 3): [HTMLInputElement, HTMLInputElement] {
  const input = element("input", {type: "color", value: hexOf(color.slice(0, 3)), "aria-label": label});
  input.onchange = () => onChange([...rgbOf(input.value), ...color.slice(3)]);
  const names = ["red", "green", "blue", "opacity"].slice(0, most).join(", ");
  const words = text(`${label}: ${names}`, color.map((x) => Number(x.toPrecision(4))).join(", "), (value) => {
    const all = numbers(value);
    if (all && all.length >= 3 && all.length <= most) {
      onChange(all);
    }
  });
  return [input, words];
}

/** `label`: for screen readers. */
export function check(caption: string, value: boolean, onChange: (value: boolean) => void, label = caption): HTMLLabelElement {
  const input = element("input", {type: "checkbox", checked: value, "aria-label": label});
  input.onchange = () => onChange(input.checked);
  return element("label", {}, [input, " " + caption]);
}

/** Numbers between commas or spaces. */
export function numbers(words: string): number[] | null {
  const all = words.split(/[\s,;]+/).filter((word) => word !== "").map(Number);
  return all.every((value) => Number.isFinite(value)) && all.length > 0 ? all : null;
}
