// A value of the scene, for which a panel has rows.
import type {Context, Put} from "./context.js";
import type {Json, JsonObject} from "../scene.js";
import type {SchemaNode} from "./schema.js";

export type Entry = {
  /** Its JSON Pointer. */
  place: string;
  caption: string;
  /** For screen readers. */
  label: string;
  node: SchemaNode;
  value: Json | undefined;
  /** The object that holds it. */
  part: JsonObject;
  context: Context;
  /** Sets another value; null for none. */
  put: Put;
  /** Raises what would be wrong with a value. */
  check: (value: Json) => Promise<unknown>;
};
