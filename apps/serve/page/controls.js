// Controls of panels: what people change goes out as a value, what the scene says comes in.

/** @param {string} tag @param {Record<string, any>} [properties] @param {(Node | string)[]} [children] */
export function element(tag, properties = {}, children = []) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.includes("-") || key === "role" || key === "for" || key === "list") {
      node.setAttribute(key, value);
    } else {
      /** @type {any} */ (node)[key] = value;
    }
  }
  node.append(...children);
  return node;
}

/** @param {(Node | string)[]} all */
export const buttons = (...all) => element("p", {className: "row buttons"}, all);

const drawing = "http://www.w3.org/2000/svg";

/**
 * Of a drawing in SVG.
 * @param {string} tag @param {Record<string, any>} [attributes] @param {(Node | string)[]} [children]
 */
export function shape(tag, attributes = {}, children = []) {
  const node = /** @type {SVGElement} */ (document.createElementNS(drawing, tag));
  setAttributes(node, attributes);
  node.append(...children);
  return node;
}

/** @param {Element} node @param {Record<string, any>} attributes */
export function setAttributes(node, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    node.setAttribute(key, String(value));
  }
}

/** What somebody holds in the hand must not be made anew. */
export const hand = {isBusy: false};

const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

/** @param {KeyboardEvent} event @returns {number[] | null} the way of an arrow key, ten times as long with Shift */
export function arrowOf(event) {
  const way = arrows[/** @type {keyof typeof arrows} */ (event.key)];
  return way && !event.ctrlKey && !event.metaKey && !event.altKey ? way.map((x) => x * (event.shiftKey ? 10 : 1)) : null;
}

/**
 * Something that is moved with the hand or with arrow keys.
 * @param {Element} target
 * @param {{drag: (event: PointerEvent) => void, arrow: (way: number[]) => void, done: () => void, start?: (event: PointerEvent) => void,
 *          other?: (event: KeyboardEvent) => boolean}} does
 *   `other`: another key; whether it was one of its own.
 */
export function movable(target, does) {
  const node = /** @type {SVGElement} */ (target);
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

/** @param {string} caption @param {(Node | string)[]} controls */
export const row = (caption, ...controls) =>
  element("p", {className: "row"}, [element("span", {className: "caption"}, [caption]), ...controls]);

/**
 * Marks a control by the place of the scene that it sets.
 * @template {Element} T @param {string} place @param {T} node
 */
export function placed(place, node) {
  node.setAttribute("data-place", place);
  return node;
}

/** @param {string} label @param {string[]} words @param {string} value @param {(value: string) => void} onChange */
export function choice(label, words, value, onChange) {
  const all = words.includes(value) ? words : [value, ...words];
  const select = /** @type {HTMLSelectElement} */ (
    element("select", {"aria-label": label}, all.map((word) => element("option", {value: word}, [word || "default"])))
  );
  select.value = value;
  select.onchange = () => onChange(select.value);
  return select;
}

/** @param {string} label @param {string} value @param {(value: string) => void} onChange @param {string} [list] */
export function text(label, value, onChange, list) {
  const input = /** @type {HTMLInputElement} */ (element("input", {type: "text", "aria-label": label, value}));
  if (list) {
    input.setAttribute("list", list);
  }
  input.onchange = () => onChange(input.value.trim());
  return input;
}

/**
 * Empty is nothing.
 * @param {string} label @param {number | null} value @param {(value: number | null) => void} onChange
 * @param {Record<string, any>} [schema] says whether it is an integer, and what it is if nothing is said
 */
export function number(label, value, onChange, schema = {}) {
  const input = /** @type {HTMLInputElement} */ (element("input", {type: "number", step: schema.type === "integer" ? 1 : "any",
    "aria-label": label, value: value ?? "", placeholder: schema.default ?? "auto"}));
  input.onchange = () => onChange(input.value === "" ? null : Number(input.value));
  return input;
}

/**
 * `isDone`: the hand has let go.
 * @param {string} label @param {[number, number]} ends @param {number} value @param {(value: number, isDone: boolean) => void} onChange
 */
export function slider(label, ends, value, onChange) {
  const input = /** @type {HTMLInputElement} */ (
    element("input", {type: "range", min: ends[0], max: ends[1], step: "any", "aria-label": label})
  );
  input.value = String(value);
  input.oninput = () => onChange(Number(input.value), false);
  input.onchange = () => onChange(Number(input.value), true);
  return input;
}

/** @param {string} label @param {() => void} onClick @param {Record<string, any>} [properties] */
export function button(label, onClick, properties = {}) {
  const node = /** @type {HTMLButtonElement} */ (element("button", properties, [label]));
  node.onclick = onClick;
  return node;
}

/** @param {number[]} rgb */
export const hexOf = (rgb) =>
  "#" + rgb.map((x) => Math.round(255 * Math.min(1, Math.max(0, x))).toString(16).padStart(2, "0")).join("");

/**
 * A colour to be chosen, and its numbers, which may be finer and, of light, above 1. A fourth is how opaque it is.
 * @param {string} label @param {number[]} color @param {(color: number[]) => void} onChange @param {number} [most] numbers
 */
export function colorControls(label, color, onChange, most = 3) {
  const input = /** @type {HTMLInputElement} */ (element("input", {type: "color", value: hexOf(color.slice(0, 3)), "aria-label": label}));
  input.onchange = () => onChange([...[1, 3, 5].map((at) => parseInt(input.value.slice(at, at + 2), 16) / 255), ...color.slice(3)]);
  const names = ["red", "green", "blue", "opacity"].slice(0, most).join(", ");
  const words = text(`${label}: ${names}`, color.map((x) => Number(x.toPrecision(4))).join(", "), (value) => {
    const all = numbers(value);
    if (all && all.length >= 3 && all.length <= most) {
      onChange(all);
    }
  });
  return [input, words];
}

/** @param {string} caption @param {boolean} value @param {(value: boolean) => void} onChange @param {string} [label] for screen readers */
export function check(caption, value, onChange, label = caption) {
  const input = /** @type {HTMLInputElement} */ (element("input", {type: "checkbox", checked: value, "aria-label": label}));
  input.onchange = () => onChange(input.checked);
  return element("label", {}, [input, " " + caption]);
}

/**
 * Numbers between commas or spaces.
 * @param {string} words
 */
export function numbers(words) {
  const all = words.split(/[\s,;]+/).filter((word) => word !== "").map(Number);
  return all.every((value) => Number.isFinite(value)) && all.length > 0 ? all : null;
}
