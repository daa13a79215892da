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

/** @param {string} caption @param {(Node | string)[]} controls */
export const row = (caption, ...controls) =>
  element("p", {className: "row"}, [element("span", {className: "caption"}, [caption]), ...controls]);

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
 */
export function number(label, value, onChange) {
  const input = /** @type {HTMLInputElement} */ (
    element("input", {type: "number", step: "any", "aria-label": label, value: value ?? ""})
  );
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

/** @param {string} label @param {boolean} value @param {(value: boolean) => void} onChange */
export function check(label, value, onChange) {
  const input = /** @type {HTMLInputElement} */ (element("input", {type: "checkbox", checked: value}));
  input.onchange = () => onChange(input.checked);
  return element("label", {}, [input, " " + label]);
}

/**
 * Numbers between commas or spaces.
 * @param {string} words
 */
export function numbers(words) {
  const all = words.split(/[\s,;]+/).filter((word) => word !== "").map(Number);
  return all.every((value) => Number.isFinite(value)) && all.length > 0 ? all : null;
}
