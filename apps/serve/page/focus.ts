// The focus, where controls are made anew.

const nameOf = (node: Element) => node.getAttribute("aria-label") ?? node.textContent;

/** The control that has the focus keeps it: the one of its name gets it. */
export function keepFocus(work: () => void) {
  const before = document.activeElement;
  const name = before && nameOf(before);
  const parent = before?.closest(".editor, #items");
  work();
  if (name && parent && !parent.contains(document.activeElement)) {
    const all = [...parent.querySelectorAll<HTMLElement | SVGElement>("button, input, select, textarea, [tabindex]")];
    all.find((node) => nameOf(node) === name)?.focus();
  }
}
