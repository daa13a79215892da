// What the page does: it shows the state that the server holds, and asks for changes.
import {CameraHand} from "./view/camera_hand.js";
import {Connection} from "./connection.js";
import type {Context} from "./editor/context.js";
import {byId, element, hand} from "./controls.js";
import {countsText} from "./view/counts.js";
import {itemRows, showCamera, showScene} from "./editor/editor.js";
import {download, listenForFiles, save} from "./panels/files.js";
import {FilmPanel} from "./panels/film.js";
import {keepFocus} from "./focus.js";
import {HistogramStore} from "./editor/histograms.js";
import {IntegralPanel} from "./panels/integrals.js";
import {ItemList} from "./panels/item_list.js";
import {LineProbe} from "./panels/line_probe.js";
import type {Ask, AskOrSay, Frame, OverlayPlaces, State, Told, Volume} from "./messages.js";
import {Overlay} from "./view/overlay.js";
import {pickedTable} from "./panels/picked_table.js";
import {marks, Picture} from "./view/picture.js";
import {SavedViews, showStandardViews} from "./panels/saved_views.js";
import type {Json} from "./scene.js";
import {TimeSteps} from "./panels/time_steps.js";
import {Work} from "./panels/work.js";

let state: State = {type: "state", revision: 0, scene: {}, items: [], addable: [], undo: null, redo: null};
let volume: Volume = {path: "", dimension: 3, elements: 0, bounds: [0, 0, 0, 1, 1, 1], fields: [], flows: [], displacements: [], groups: [],
  times: [], views: [], usual_density: 1};
let frame: Frame | null = null;
let pickedPoint: number[] | null = null;
/** What lists and editors were made of: what has not changed is left to the hand. */
const shown = {editors: "", camera: "", selected: "", size: ""};

const messages = byId("messages", HTMLElement);
const mark = byId("mark", HTMLElement), counts = byId("counts", HTMLElement);
const undecided = byId("undecided", HTMLInputElement);
const parallel = byId("parallel", HTMLButtonElement), panelToggle = byId("panel-toggle", HTMLButtonElement);

function say(what: unknown) {
  const line = element("p", {}, [what instanceof Error ? what.message : String(what)]);
  messages.append(line);
  while (messages.childElementCount > 3) {
    messages.firstElementChild?.remove();
  }
  setTimeout(() => line.remove(), 8000);
}

const connection = new Connection({
  message: receive,
  frame: (facts, bytes) => { picture.show(facts, bytes).catch(say); },
  line: (text) => { mark.textContent = text || "connected"; },
});
const ask: AskOrSay = (message) => connection.ask(message).catch((error) => { say(error); return null; });
const raise: Ask = (message) => connection.ask(message);
/** Raises what is wrong with a value at a place of the scene. */
const check: Context["check"] = (pointer, value) => connection.ask({type: "check", pointer, value});

const picture = new Picture(connection, showFrame);
new CameraHand(connection, picture, pick);
const overlay = new Overlay(byId("marks", SVGSVGElement), {tell: (message) => connection.tell(message), release}, (x, y) => picture.place(x, y));
const histograms = new HistogramStore(raise);
const items = new ItemList(ask, showState);
const savedViews = new SavedViews(ask, set);
const time = new TimeSteps(connection);
const lineProbe = new LineProbe(byId("line", HTMLElement), {
  ask, say, download, check,
  mark: (points) => { ask({type: "overlay", points}).then(showOverlay); },
});

const work = new Work(ask, say);
const integrals = new IntegralPanel(byId("integrals", HTMLElement), {
  ask: raise, check, work, field: sceneField,
  plane: () => (items.selected?.kind === "surface" ? state.scene.surfaces?.[items.selected.index]?.plane : undefined),
});
const stem = () => (volume.path || "scene").replace(/\.[^.]*$/, "");
const [saveWidth, saveHeight] = [byId("save-width", HTMLInputElement), byId("save-height", HTMLInputElement)];
const savedSize = (): [number, number] => [Number(saveWidth.value), Number(saveHeight.value)];
const film = new FilmPanel({ask: raise, work, size: savedSize, save, stem});

/** Places of handles and points in the picture. */
function showOverlay(told: OverlayPlaces | null) {
  if (told) {
    overlay.show(told, picture.size, picture.size[0] / Math.max(1, picture.view.clientWidth));
  }
}

/** Handles are those of the item that is selected. */
function selectOnServer() {
  const item = items.selected;
  const now = item ? JSON.stringify([item.kind, item.index, item.shown]) : "none";
  if (now !== shown.selected) {
    shown.selected = now;
    ask({type: "overlay", item: item ? {kind: item.kind, index: item.index} : null}).then(showOverlay);
  }
}

/** A value at a place of the scene. */
function set(pointer: string, value: Json | undefined, name: string, isDone = true) {
  if (isDone) {
    connection.ask({type: "set", pointer, value, name}).then(() => connection.tell({type: "release"})).catch(refuse);
  } else {
    connection.tell({type: "set", pointer, value, name, time: performance.now()});
  }
}

/** What was typed cannot be: controls show what the scene says. */
function refuse(what: unknown) {
  say(what);
  shown.editors = "";
  showState();
}

function receive(told: Exclude<Told, Frame>) {
  switch (told.type) {
  case "hello":
    volume = told.volume;
    document.title = `${volume.path} - ElVis`;
    showStandardViews(volume.views, connection);
    shown.editors = "";
    shown.selected = "";
    overlay.version = 0;
    lineProbe.mark(null);
    picture.resize();
    break;
  case "state":
    state = told;
    showState();
    break;
  case "activity":
    byId("activity", HTMLElement).textContent = told.text;
    break;
  case "progress":
    work.progress(told.fraction);
    break;
  case "error":
    say(told.text);
    time.stop();
    break;
  }
}

function showFrame(facts: Frame) {
  frame = facts;
  showOverlay(facts.overlay);
  state.scene.camera = facts.camera;
  if (facts.stage !== "moving") {
    showCameraNumbers();
  }
  mark.textContent = marks[facts.stage];
  document.body.dataset.stage = facts.stage;
  document.body.dataset.revision = String(facts.revision);
  counts.textContent = countsText(facts);
  counts.title = (facts.remarks ?? []).map((remark) => remark.text).join("\n");
  if (facts.stage === "exact" && undecided.checked) {
    showUndecided();
  }
  if (facts.stage !== "moving") {
    time.goOn();
  }
}

async function showUndecided() {
  const answer = await ask({type: "undecided"});
  if (answer && undecided.checked && picture.stage === "exact") {
    picture.showMask(answer.size, answer.bytes ?? new Uint8Array());
    counts.textContent = `${answer.size[0]} x ${answer.size[1]}, ${answer.n_undecided} undecided`;
  }
}

async function pick(column: number, row: number) {
  const answer = await ask({type: "pick", column, row});
  if (answer && !lineProbe.take(answer.picked)) {
    pickedPoint = answer.picked.hit ? answer.picked.position : null;
    byId("picked", HTMLElement).replaceChildren(pickedTable(answer.picked));
    byId("picked-section", HTMLElement).scrollIntoView({block: "nearest"});
  }
}

function showState() {
  for (const [id, step, word] of [["undo", state.undo, "Undo"], ["redo", state.redo, "Redo"]] as const) {
    const button = byId(id, HTMLButtonElement);
    button.disabled = step === null;
    button.title = step ? `${word}: ${step}` : "";
  }
  parallel.setAttribute("aria-pressed", String(state.scene.camera?.type === "orthographic"));
  items.show(state);
  // What somebody holds in the hand must not be taken away.
  const active = document.activeElement;
  if (!hand.isBusy && !(active instanceof HTMLInputElement && active.type === "range" && active.matches(":active"))) {
    showEditors();
  }
  selectOnServer();
  time.show(volume.times, state.scene.volume?.time_step ?? 0);
  savedViews.show(state.scene.views ?? []);
  film.show(state.scene.animation !== undefined);
  const size = state.scene.image?.size;
  if (size && active !== saveWidth && active !== saveHeight && JSON.stringify(size) !== shown.size) {
    shown.size = JSON.stringify(size);
    [saveWidth.value, saveHeight.value] = size.map(String);
  }
}

function showEditors() {
  const item = items.selected;
  const {camera: _camera, views: _views, ...looks} = state.scene;
  const now = JSON.stringify([item, looks]);
  if (now === shown.editors) {
    return;
  }
  shown.editors = now;
  const context = editorContext(), field = context.sceneField;
  keepFocus(() => showScene(context));
  lineProbe.follow(state.scene, field);
  integrals.follow(state.scene);
  byId("item-section", HTMLElement).hidden = !item;
  if (item) {
    byId("item-title", HTMLElement).textContent = item.label;
    keepFocus(() => byId("item-editor", HTMLElement).replaceChildren(...itemRows(item, context)));
  }
}

function sceneField(): string {
  return state.scene.field ?? volume.fields[0]?.name ?? "";
}

function editorContext(): Context {
  const {scene} = state;
  return {
    scene, volume, sceneField: sceneField(), set, check, release, refuse, histograms,
    picked: () => pickedPoint,
    begin: {transfer: async () => (await ask({type: "transfer"}))?.transfer ?? null},
    more: {"key frames": withKeyFrame},
  };
}

/** Two at least; each where one looks from now. */
function withKeyFrame(all: Json[]): Json[] {
  const next = (frames: Json[]): Json => {
    const {eye, look_at, up} = state.scene.camera ?? {};
    const last = frames[frames.length - 1] as {frame: number} | undefined;
    return {frame: last ? last.frame + 25 : 0, eye, look_at, up};
  };
  const one = [...all, next(all)];
  return one.length > 1 ? one : [...one, next(one)];
}

/** The camera's numbers come when the hand rests. */
function showCameraNumbers() {
  const now = JSON.stringify(state.scene.camera);
  if (now !== shown.camera && !byId("camera-editor", HTMLElement).contains(document.activeElement)) {
    shown.camera = now;
    showCamera(editorContext());
  }
}

/** The hand has let go: what was held comes to show what the scene says. */
function release() {
  connection.tell({type: "release"});
  showState();
}

byId("undo", HTMLButtonElement).onclick = () => ask({type: "undo"});
byId("redo", HTMLButtonElement).onclick = () => ask({type: "redo"});
byId("pick-middle", HTMLButtonElement).onclick = () => pick(picture.size[0] / 2, picture.size[1] / 2);
parallel.onclick = () => ask({type: "projection", orthographic: parallel.getAttribute("aria-pressed") !== "true"});
panelToggle.onclick = () => {
  const isFull = document.body.classList.toggle("full");
  panelToggle.setAttribute("aria-pressed", String(!isFull));
};
undecided.onchange = () => (undecided.checked ? showUndecided() : picture.hideMask());
byId("panel", HTMLElement).addEventListener("focusin", ({target}) => {
  const titled = target instanceof Element ? target.closest<HTMLElement>("[title]") : null;
  byId("help", HTMLElement).textContent = titled?.title ?? "";
});
listenForFiles({ask: raise, say, work, picture, size: savedSize, stem});
document.addEventListener("keydown", (event) => {
  const isTyping = event.target instanceof HTMLInputElement && (event.target.type === "text" || event.target.type === "number");
  if ((event.ctrlKey || event.metaKey) && !isTyping && (event.key === "z" || event.key === "y")) {
    ask({type: event.key === "y" || event.shiftKey ? "redo" : "undo"});
    event.preventDefault();
  }
});

// For those who measure.
Object.assign(window, {elvis: {connection, picture, state: () => state, frame: () => frame ?? {}}});
connection.open();
