// Texts of the scene. What is wrong with one is told below it while it is typed; it stays there until it is right.
import {element, row, text} from "../controls.js";
import type {Entry} from "./entry.js";
import type {Json} from "../scene.js";

/** What was typed and the scene has not taken, and what it said when that began. */
const drafts = new Map<string, {words: string; was: string}>();
/** So long nothing is typed before it is looked at. */
const pauseMilliseconds = 250;

/**
 * `was`: what the scene says; `valueOf`: what words are in the scene, it raises what is wrong with them; `list`: of what may be
 * chosen.
 */
export function sceneText({place, caption, label, put, check}: Pick<Entry, "place" | "caption" | "label" | "put" | "check">, was: string,
                          valueOf: (words: string) => Json, list?: string): {input: HTMLInputElement; rows: Element[]} {
  const key = `${place} ${label}`;
  const known = drafts.get(key);
  if (known && known.was !== was) {
    drafts.delete(key);
  }
  const input = text(label, drafts.get(key)?.words ?? was, commit, list);
  const told = element("p", {className: "wrong", role: "status", hidden: true, id: `wrong${key.replace(/\W+/g, "-")}`});
  input.setAttribute("aria-describedby", told.id);
  let timer = 0, n = 0;

  function tell(wrong: string) {
    told.textContent = wrong;
    told.hidden = wrong === "";
    input.setAttribute("aria-invalid", String(wrong !== ""));
  }

  /** Whether the scene would take it. */
  async function judge(): Promise<boolean> {
    clearTimeout(timer);
    const mine = ++n;
    let wrong = "";
    try {
      await check(valueOf(input.value.trim()));
    } catch (error) {
      wrong = error instanceof Error ? error.message : String(error);
    }
    if (mine === n) {
      tell(wrong);
    }
    return mine === n && wrong === "";
  }

  async function commit() {
    drafts.set(key, {words: input.value, was});
    if (await judge()) {
      drafts.delete(key);
      put(valueOf(input.value.trim()));
    }
  }

  input.oninput = () => {
    drafts.set(key, {words: input.value, was});
    clearTimeout(timer);
    timer = window.setTimeout(judge, pauseMilliseconds);
  };
  input.onkeydown = (event) => {
    if (event.key === "Escape") {
      clearTimeout(timer);
      ++n;
      drafts.delete(key);
      input.value = was;
      tell("");
    }
  };
  if (input.value !== was) {
    judge();
  }
  return {input, rows: [row(caption, input), told]};
}
