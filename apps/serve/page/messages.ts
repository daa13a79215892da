// What page and server say to each other, as session/session_messages.cpp has it.
import type {Camera, ColorMap, Json, JsonObject, Scene, Triple} from "./scene.js";

/** In pixels of the picture, from the left and from the top. */
export type Place = [number, number];
export type Size = [number, number];
type Nothing = Record<never, never>;

export type ItemName = {kind: "surface" | "volume" | "light"; index: number};
/** `pointer`: its place in the scene. */
export type Item = ItemName & {pointer: string; label: string; name: string; shown: boolean};
/** `way`: the direction in which it goes, of those that move along a line. */
export type Handle = {name: string; help: string; at: Place | null; tied_to: Place | null; way: Place | null};
/** Handles of the selected item and marked points. */
export type OverlayPlaces = {version: number; handles: Handle[]; points: (Place | null)[]};

export type PickedField = {name: string; unit?: string; values: Json; gradients: Json};
export type Picked = {hit: false} | {
  hit: true; element: number; xi: number[]; position: Triple; fields: PickedField[];
  also?: number[]; jacobian: Json; order: Json; remark?: string;
};
export type Histogram = {lower: number; upper: number; bins: number[]; quantiles: [number, number, number, number]; is_complete: boolean};
export type Series = {name: string; points: [number, number | null][]};
export type Line = {series: Series[]; breaks: {at: number}[]; no_breaks_because: string; length: number; n_outside: number; csv: string};

export type PictureFormat = "png" | "svg" | "pdf";
/** What is integrated over. */
export type Domain = {domain: "volume"} | {domain: "boundary"; groups: string[]} | {domain: "plane"; plane: number[]}
  | {domain: "isosurface"; level_field: string; isovalue: number};
/** `field`: "" is the number 1. */
export type IntegralWishes = Domain & {field: string; flux: boolean};
/** As `elvis integrate` prints them; null is what is not finite. */
export type Integral = {
  value: number | null; error: number | null; measure: number | null; measure_error: number | null;
  converged: boolean; exact: boolean; parts: number; evaluations: number;
};
/** As `elvis extrema` prints them. */
export type Extremum = {value: number; interval?: [number, number]; element: number; xi: Triple; position?: Triple};
export type Extrema = {field: string; certainty: "certified" | "sampled"; minimum: Extremum; maximum: Extremum};

/** Of each kind of message: what it holds, and what the answer to it does. */
export type Messages = {
  "resize": [{width: number; height: number}, Nothing];
  "orbit": [{dx: number; dy: number}, Nothing];
  "pan": [{dx: number; dy: number}, Nothing];
  "zoom": [{x: number; y: number; factor: number}, Nothing];
  "view": [{name: string}, Nothing];
  "projection": [{orthographic: boolean}, Nothing];
  "release": [Nothing, Nothing];
  "set": [{pointer: string; value: Json | undefined; name: string}, Nothing];
  "check": [{pointer: string; value: Json | undefined}, Nothing];
  "load": [{scene: Json}, Nothing];
  "undo": [Nothing, Nothing];
  "redo": [Nothing, Nothing];
  "add": [{name: string; middle?: number}, Item];
  "remove": [ItemName, Nothing];
  "show": [ItemName & {shown: boolean}, Nothing];
  "copy": [ItemName, Item];
  "overlay": [{item?: ItemName | null; points?: number[][]}, OverlayPlaces];
  "drag": [{handle: number; from: number[]; to: number[]}, Nothing];
  "pick": [{column: number; row: number}, {picked: Picked}];
  "line": [{from: number[]; to: number[]; fields?: string[]}, Line];
  "histogram": [{field: string}, Histogram];
  "palette": [{color_map: ColorMap}, {points: number[][]}];
  "range": [Nothing, {minimum: number; maximum: number}];
  "transfer": [Nothing, {transfer: JsonObject}];
  "undecided": [Nothing, {size: Size; n_undecided: number}];
  "save scene": [Nothing, {scene: Scene & {camera: Camera}; text: string}];
  "save picture": [{width: number; height: number; format: PictureFormat}, {mime: string}];
  "integrate": [IntegralWishes, {integral: Integral; doubts: string[]}];
  "extrema": [{field: string}, {extrema: Extrema}];
  "film": [{width: number; height: number}, {n_pictures: number; frames_a_second: number}];
  "film picture": [{index: number}, {name: string; mime: string}];
  "stop": [Nothing, Nothing];
  "shown": [{frame: number}, Nothing];
};
export type Kind = keyof Messages;
/** `time`: the page's clock, which comes back with the next frame. */
export type Message<K extends Kind = Kind> = {[One in K]: {type: One; time?: number} & Messages[One][0]}[K];
/** With the bytes behind it, if there are some. */
export type Answer<K extends Kind> = Messages[K][1] & {bytes: Uint8Array | null};
export type Ask = <K extends Kind>(message: {type: K} & Messages[K][0]) => Promise<Answer<K>>;
/** Says what is wrong, and gives nothing then. */
export type AskOrSay = <K extends Kind>(message: {type: K} & Messages[K][0]) => Promise<Answer<K> | null>;

export type Field = {name: string; unit: string; components: number};
export type Volume = {
  path: string; dimension: number; elements: number; bounds: number[]; fields: Field[]; flows: string[]; displacements: string[];
  groups: string[]; times: number[]; views: string[]; usual_density: number;
};
export type State = {
  type: "state"; revision: number; scene: Scene; items: Item[]; addable: {name: string; help: string}[]; undo: string | null; redo: string | null;
};
export type Stage = "moving" | "full" | "exact";
/** Before the bytes of a picture. `echo`: the `time` of the last message that it shows. */
export type Frame = {
  type: "frame"; frame: number; stage: Stage; divisor: number; shrink: number; milliseconds: number; revision: number; echo: number | null;
  overlay: OverlayPlaces; camera: Camera; size: Size; image: Size; mime: string;
  counts?: Record<string, number>; remarks?: {text: string; warning: boolean}[];
};
/** What the server says by itself. */
export type Told = {type: "hello"; session: string; volume: Volume} | State | Frame | {type: "activity"; text: string} | {type: "taken"}
  | {type: "progress"; of: number | null; fraction: number}
  | {type: "error"; text: string; id?: number | null; revision?: number};
/** What it says to a message that has that number. */
export type Answered = {type: "answer"; id: number} | {type: "error"; text: string; id: number};
