// What panels know and do.
import type {HistogramStore} from "./histograms.js";
import type {Volume} from "../messages.js";
import type {Json, JsonObject, Scene} from "../scene.js";

/** `isDone`: the hand has let go. */
export type Put = (value: Json | undefined, isDone?: boolean) => void;

export type Context = {
  scene: Scene;
  volume: Volume;
  /** What it shows where nothing else is said. */
  sceneField: string;
  set: (pointer: string, value: Json | undefined, name: string, isDone?: boolean) => void;
  /** Raises what is wrong with a value at a place. */
  check: (pointer: string, value: Json | undefined) => Promise<unknown>;
  /** Ends a movement of the hand. */
  release: () => void;
  /** Says what is wrong with what was typed. */
  refuse: (text: string) => void;
  /** The point that was clicked at last. */
  picked: () => number[] | null;
  /** Makes objects of a kind where the schema does not say enough. */
  begin: Record<string, () => Promise<JsonObject | null>>;
  /** Makes lists of a name with an entry more where the schema does not say enough. */
  more: Record<string, (all: Json[]) => Json[]>;
  histograms: HistogramStore;
};
