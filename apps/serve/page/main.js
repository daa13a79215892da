// What the page does: it shows the state that the server holds, and asks for changes.
import {Connection} from "./connection.js";
import {element, hand, placed, text} from "./controls.js";
import {showCamera, showItem, showScene} from "./editor.js";
import {download, listenForFiles} from "./files.js";
import {makeHistograms} from "./histograms.js";
import {LineProbe} from "./line_probe.js";
import {Overlay} from "./overlay.js";
import {pickedTable} from "./picked_table.js";
import {Picture} from "./picture.js";

/** @typedef {Record<string, any>} Json */

/** @param {string} id */
const $ = (id) => /** @type {any} */ (document.getElementById(id));

/** @type {Json} */
let state = {scene: {}, items: [], addable: []};
/** @type {Json} */
let volume = {fields: [], times: [], views: [], bounds: [0, 0, 0, 1, 1, 1]};
let selected = "surface 0";
/** @type {Json} */
let frame = {};
let playing = false;
/** @type {number[] | null} */
let pickedPoint = null;

/** @param {string | Error} what */
function say(what) {
  const text = what instanceof Error ? what.message : what;
  const line = element("p", {}, [text]);
  $("messages").append(line);
  while ($("messages").childElementCount > 3) {
    $("messages").firstElementChild.remove();
  }
  setTimeout(() => line.remove(), 8000);
}

const connection = new Connection({message: receive, bytes: receiveBytes, line: showLine});
const picture = new Picture(connection, pick);
picture.onFrame = showFrame;

/** @param {Json} message */
const ask = (message) => connection.ask(message).catch((error) => { say(error); return null; });

const overlay = new Overlay($("marks"), {tell: (message) => connection.tell(message), release}, (x, y) => picture.place(x, y));
const histograms = makeHistograms((message) => connection.ask(message));
/**
 * Raises what is wrong with a value at a place of the scene.
 * @param {string} pointer @param {any} value
 */
const check = (pointer, value) => connection.ask({type: "check", pointer, value});
const lineProbe = new LineProbe($("line"), {
  ask, say, download, check,
  mark: (points) => ask({type: "overlay", points}).then(showOverlay),
});
let overlaid = "";
/** What lists and editors were made of: what has not changed is left to the hand. */
const shown = {items: "", editors: "", camera: "", views: ""};

/** @param {Json | null} told places of handles and points in the picture */
function showOverlay(told) {
  if (told) {
    overlay.show(/** @type {any} */ (told), picture.size, picture.size[0] / Math.max(1, picture.view.clientWidth));
  }
}

/** Handles are those of the item that is selected. */
function selectOnServer() {
  const item = state.items.find((/** @type {Json} */ one) => key(one) === selected) ?? null;
  const now = item && JSON.stringify([item.kind, item.index, item.shown]);
  if (now !== overlaid) {
    overlaid = now;
    ask({type: "overlay", item: item && {kind: item.kind, index: item.index}}).then(showOverlay);
  }
}

/** A value at a place of the scene. */
function set(/** @type {string} */ pointer, /** @type {any} */ value, /** @type {string} */ name, isDone = true) {
  if (isDone) {
    connection.ask({type: "set", pointer, value, name}).then(() => connection.tell({type: "release"})).catch(refuse);
  } else {
    connection.tell({type: "set", pointer, value, name, time: performance.now()});
  }
}

/**
 * What was typed cannot be: controls show what the scene says.
 * @param {string | Error} what
 */
function refuse(what) {
  say(what);
  shown.editors = "";
  showState();
}

/** @param {Json} message */
function receive(message) {
  if (message.type === "hello") {
    volume = message.volume;
    document.title = `${volume.path} - ElVis`;
    showViews();
    shown.editors = "";
    overlaid = "";
    overlay.version = 0;
    lineProbe.mark(null);
    picture.resize();
  } else if (message.type === "state") {
    state = message;
    showState();
  } else if (message.type === "activity") {
    $("activity").textContent = message.text;
  } else if (message.type === "error") {
    say(message.text);
    playing = false;
  }
}

/** @param {Json} facts @param {Uint8Array} bytes */
function receiveBytes(facts, bytes) {
  if (facts.type === "frame") {
    picture.show(facts, bytes).catch(say);
  }
}

/** @param {string} text */
function showLine(text) {
  $("mark").textContent = text || "connected";
}

/** @type {[string, string][]} */
const doubts = [
  ["undecided_pixels", "undecided"],
  ["undecided_isosurface_pixels", "undecided of isosurfaces"],
  ["undecided_contour_pixels", "undecided of contours"],
  ["undecided_mesh_line_pixels", "undecided of mesh lines"],
  ["inexact_volume_pixels", "beyond the volume's tolerance"],
  ["work_limit_pixels", "cut short"],
  ["overlap_pixels", "of overlapping elements"],
];

/**
 * What the counts say of pixels that may be wrong.
 * @param {Json} counts
 * @returns {string[]}
 */
function doubtsOf(counts) {
  const words = doubts.filter(([name]) => counts[name] > 0).map(([name, text]) => `${counts[name]} ${text}`);
  return words.length > 0 ? words : ["0 undecided"];
}

/** @param {Json} facts */
function showFrame(facts) {
  frame = facts;
  showOverlay(facts.overlay);
  state.scene.camera = facts.camera;
  if (facts.stage !== "moving") {
    showCameraNumbers();
  }
  $("mark").textContent = Picture.mark(facts.stage);
  document.body.dataset.stage = facts.stage;
  document.body.dataset.revision = facts.revision;
  const counts = facts.counts ?? {};
  const words = facts.stage === "exact" ? doubtsOf(counts) : [];
  $("counts").textContent = [`${facts.size[0]} x ${facts.size[1]}`, ...words].join(", ");
  $("counts").title = (facts.remarks ?? []).map((/** @type {Json} */ remark) => remark.text).join("\n");
  if (facts.stage === "exact" && $("undecided").checked) {
    showUndecided();
  }
  if (playing && facts.stage !== "moving") {
    nextStep();
  }
}

async function showUndecided() {
  const answer = await ask({type: "undecided"});
  if (answer && $("undecided").checked && picture.stage === "exact") {
    picture.showMask(answer.size[0], answer.size[1], answer.bytes ?? new Uint8Array());
    $("counts").textContent = `${answer.size[0]} x ${answer.size[1]}, ${answer.n_undecided} undecided`;
  }
}

/** @param {number} column @param {number} row */
async function pick(column, row) {
  const answer = await ask({type: "pick", column, row});
  if (answer && !lineProbe.take(answer.picked)) {
    pickedPoint = answer.picked.hit ? answer.picked.position : null;
    $("picked").replaceChildren(pickedTable(answer.picked));
    $("picked-section").scrollIntoView({block: "nearest"});
  }
}

/** @param {Json} item */
const key = (item) => `${item.kind} ${item.index}`;

function showState() {
  $("undo").disabled = state.undo === null;
  $("redo").disabled = state.redo === null;
  $("undo").title = state.undo ? `Undo: ${state.undo}` : "";
  $("redo").title = state.redo ? `Redo: ${state.redo}` : "";
  $("parallel").setAttribute("aria-pressed", String(state.scene.camera?.type === "orthographic"));
  showItems();
  // What somebody holds in the hand must not be taken away.
  const inHand = hand.isBusy || document.activeElement instanceof HTMLInputElement && document.activeElement.type === "range" &&
    document.activeElement.matches(":active");
  if (!inHand) {
    showEditors();
  }
  selectOnServer();
  showTime();
  showSavedViews();
  const [width, height] = state.scene.image?.size ?? [1024, 768];
  if (document.activeElement !== $("save-width") && document.activeElement !== $("save-height")) {
    $("save-width").value = width;
    $("save-height").value = height;
  }
}

function showEditors() {
  const item = state.items.find((/** @type {Json} */ one) => key(one) === selected);
  const {camera, views, ...looks} = state.scene;
  const now = JSON.stringify([item, looks]);
  if (now === shown.editors) {
    return;
  }
  shown.editors = now;
  const context = editorContext(), field = context.sceneField;
  keepFocus(() => showScene(context));
  lineProbe.follow(state.scene, field);
  $("item-section").hidden = !item;
  if (item) {
    $("item-title").textContent = item.label;
    keepFocus(() => showItem($("item-editor"), item, context));
  }
}

/** @returns {import("./editor.js").Context} */
function editorContext() {
  const {scene} = state;
  return {
    scene, volume, sceneField: scene.field ?? volume.fields[0]?.name ?? "", set, check, release, refuse, histograms,
    picked: () => pickedPoint,
    begin: {transfer: async () => (await ask({type: "transfer"}))?.transfer ?? null},
    more: {
      // Two at least; each where one looks from now.
      "key frames": (all) => {
        const {eye, look_at, up} = scene.camera;
        const next = (/** @type {Json[]} */ frames) => ({frame: frames.length ? frames[frames.length - 1].frame + 25 : 0, eye, look_at, up});
        const one = [...all, next(all)];
        return one.length > 1 ? one : [...one, next(one)];
      },
    },
  };
}

/** The camera's numbers come when the hand rests. */
function showCameraNumbers() {
  const now = JSON.stringify(state.scene.camera);
  if (now !== shown.camera && !$("camera-editor").contains(document.activeElement)) {
    shown.camera = now;
    showCamera(editorContext());
  }
}

/** The hand has let go: what was held comes to show what the scene says. */
function release() {
  connection.tell({type: "release"});
  showState();
}

/**
 * Controls are made anew; the one with the focus keeps it.
 * @param {() => void} work
 */
function keepFocus(work) {
  const nameOf = (/** @type {Element} */ node) => node.getAttribute("aria-label") ?? node.textContent;
  const name = document.activeElement && nameOf(document.activeElement);
  const parent = document.activeElement?.closest(".editor, #items");
  work();
  if (name && parent && !parent.contains(document.activeElement)) {
    const all = [...parent.querySelectorAll("button, input, select, textarea, [tabindex]")];
    /** @type {HTMLElement | undefined} */ (all.find((node) => nameOf(node) === name))?.focus();
  }
}

function showItems() {
  const now = JSON.stringify([state.items, state.addable, selected]);
  if (now === shown.items) {
    return;
  }
  shown.items = now;
  const list = state.items.map((/** @type {Json} */ item) => {
    const visible = element("input", {type: "checkbox", checked: item.shown, "aria-label": `Show ${item.label}`});
    visible.onchange = () => ask({type: "show", kind: item.kind, index: item.index, shown: /** @type {HTMLInputElement} */ (visible).checked});
    const label = element("button", {className: "label", "aria-pressed": String(key(item) === selected)}, [item.label]);
    label.onclick = () => { selected = key(item); showState(); };
    const remove = element("button", {"aria-label": `Remove ${item.label}`, title: "Remove"}, ["✕"]);
    remove.onclick = () => ask({type: "remove", kind: item.kind, index: item.index});
    return element("li", {className: key(item) === selected ? "selected" : ""}, [visible, label, remove]);
  });
  keepFocus(() => $("items").replaceChildren(...list));
  const before = $("new-item").value;
  $("new-item").replaceChildren(...state.addable.map((/** @type {Json} */ item) => element("option", {value: item.name, title: item.help}, [item.name])));
  $("new-item").value = state.addable.some((/** @type {Json} */ item) => item.name === before) ? before : state.addable[0]?.name ?? "";
}

/** @param {Json | null} answer */
function selectAnswer(answer) {
  if (answer) {
    selected = key(answer);
    showState();
  }
}

async function add() {
  const name = $("new-item").value;
  /** @type {Json} */
  const message = {type: "add", name};
  if (name === "Isosurface") {
    const range = await ask({type: "range"});
    if (!range) {
      return;
    }
    message.middle = (range.minimum + range.maximum) / 2;
  }
  selectAnswer(await ask(message));
}

function showViews() {
  const names = ["all", ...volume.views];
  $("views").replaceChildren(...names.map((name) => {
    const button = element("button", {"aria-label": name === "all" ? "Show all" : `View from ${name}`}, [name]);
    button.onclick = () => connection.tell({type: "view", name, time: performance.now()});
    return button;
  }));
}

function showSavedViews() {
  const views = state.scene.views ?? [];
  const now = JSON.stringify(views);
  if (now === shown.views) {
    return;
  }
  shown.views = now;
  $("saved-views").replaceChildren(...views.map((/** @type {Json} */ view, /** @type {number} */ index) => {
    const name = text(`Name of view ${index + 1}`, view.name, (words) => set(`/views/${index}/name`, words, "name of a view"));
    placed(`/views/${index}/name`, name);
    const go = element("button", {"aria-label": `Go to ${view.name}`}, ["Go"]);
    go.onclick = () => ask({type: "set", pointer: "/camera", value: view.camera, name: "view"});
    const remove = element("button", {"aria-label": `Remove ${view.name}`}, ["✕"]);
    remove.onclick = () => set(`/views/${index}`, null, "views");
    return element("li", {}, [name, go, remove]);
  }));
}

async function saveView() {
  const saved = await ask({type: "save scene"});
  if (saved) {
    const views = saved.scene.views ?? [];
    set("/views", [...views, {name: `View ${views.length + 1}`, camera: saved.scene.camera}], "views");
  }
}

function showTime() {
  $("time-section").hidden = volume.times.length < 2;
  const step = state.scene.volume?.time_step ?? 0;
  $("time").max = volume.times.length - 1;
  $("time").value = step;
  $("time-text").textContent = String(volume.times[step] ?? "");
}

function nextStep() {
  const step = ((state.scene.volume?.time_step ?? 0) + 1) % volume.times.length;
  connection.tell({type: "set", pointer: "/volume/time_step", value: step, name: "time step"});
}

$("undo").onclick = () => ask({type: "undo"});
$("redo").onclick = () => ask({type: "redo"});
$("add").onclick = add;
$("copy").onclick = () => {
  const item = state.items.find((/** @type {Json} */ one) => key(one) === selected);
  if (item) {
    ask({type: "copy", kind: item.kind, index: item.index}).then(selectAnswer);
  }
};
$("save-view").onclick = saveView;
$("pick-middle").onclick = () => pick(picture.size[0] / 2, picture.size[1] / 2);
$("parallel").onclick = () => ask({type: "projection", orthographic: $("parallel").getAttribute("aria-pressed") !== "true"});
$("panel-toggle").onclick = () => {
  const isFull = document.body.classList.toggle("full");
  $("panel-toggle").setAttribute("aria-pressed", String(!isFull));
};
$("undecided").onchange = () => ($("undecided").checked ? showUndecided() : picture.hideMask());
$("time").oninput = () => connection.tell({type: "set", pointer: "/volume/time_step", value: Number($("time").value), name: "time step"});
$("time").onchange = () => connection.tell({type: "release"});
$("play").onclick = () => {
  playing = !playing;
  $("play").setAttribute("aria-pressed", String(playing));
  $("play").textContent = playing ? "Stop" : "Play";
  if (playing) {
    nextStep();
  } else {
    connection.tell({type: "release"});
  }
};
$("panel").addEventListener("focusin", (/** @type {FocusEvent} */ event) => {
  const control = /** @type {HTMLElement} */ (event.target);
  $("help").textContent = /** @type {HTMLElement | null} */ (control.closest("[title]"))?.title ?? "";
});
listenForFiles({ask, say, picture, stem: () => String(volume.path ?? "scene").replace(/\.[^.]*$/, "")});
document.addEventListener("keydown", (event) => {
  const isTyping = event.target instanceof HTMLInputElement && (event.target.type === "text" || event.target.type === "number");
  if ((event.ctrlKey || event.metaKey) && !isTyping && (event.key === "z" || event.key === "y")) {
    ask({type: event.key === "y" || event.shiftKey ? "redo" : "undo"});
    event.preventDefault();
  }
});

// For those who measure.
Object.assign(window, {elvis: {connection, picture, state: () => state, frame: () => frame}});
connection.open();
