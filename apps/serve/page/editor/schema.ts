// What the schema of scenes says of keys: the one by which scene files are read.
import type {Context} from "./context.js";
import type {Json, JsonObject} from "../scene.js";

/** Of a key; `kind` is the name of what it refers to. */
export type SchemaNode = {
  type?: string; kind?: string; format?: string; description?: string; default?: Json; enum?: string[]; examples?: Json[];
  properties?: Record<string, SchemaNode>; required?: string[]; items?: SchemaNode; anyOf?: SchemaNode[];
  minimum?: number; maximum?: number; minItems?: number; maxItems?: number;
  /** Keys beside which it means something, with their values; keys that it cannot stand beside. */
  with?: Record<string, Json[]>; excludes?: string[];
  mayBeText?: boolean; $ref?: string; $defs?: Record<string, SchemaNode>;
};
export type ObjectNode = SchemaNode & {properties: Record<string, SchemaNode>};

export const schema = await (await fetch("scene.schema.json")).json() as ObjectNode;

/** A key's node with what it refers to; of alternatives the one with keys. */
export function resolved(node: SchemaNode): SchemaNode {
  const kind = node.$ref?.split("/").pop();
  const whole: SchemaNode = kind ? {...schema.$defs?.[kind], ...node, kind} : node;
  const object = whole.anyOf?.map(resolved).find((one) => one.properties);
  const mayBeText = whole.anyOf?.some((one) => one.type === "string");
  return object ? {...object, description: whole.description, mayBeText} : whole;
}

/** The node of an object's key, which has keys itself. */
export function objectNode(node: SchemaNode | undefined): ObjectNode {
  const whole = resolved(node ?? {});
  return {...whole, properties: whole.properties ?? {}};
}

/** Whether a key means something beside the values of others. */
export const isMeaningful = (node: ObjectNode, key: string, part: JsonObject) => Object.entries(node.properties[key].with ?? {}).every(
  ([other, values]) => values.includes(part[other] ?? node.properties[other].default ?? null));

/** An object with another value under a key, without what means nothing beside it; null removes. */
export function withValue(node: ObjectNode, part: JsonObject, key: string, value: Json | undefined): JsonObject {
  const next = {...part, [key]: value};
  const excludes = (one: string, other: string) => node.properties[one].excludes?.includes(other) ?? false;
  const stays = (other: string) => (value === null ? other !== key : !excludes(key, other) && !excludes(other, key));
  return Object.fromEntries(Object.entries(next).filter(([other]) => stays(other) && isMeaningful(node, other, next)));
}

/** Something to begin with. */
export function start(node: SchemaNode, context: Context): Json {
  const whole = resolved(node);
  const b = context.volume.bounds;
  const middle = [0, 1, 2].map((i) => (b[i] + b[i + 3]) / 2);
  const kinds: Record<string, number[] | undefined> = {plane: [1, 0, 0, -middle[0]], vector: context.picked() ?? middle, color: [0.5, 0.5, 0.5]};
  if (whole.properties) {
    const {properties} = whole;
    return Object.fromEntries((whole.required ?? []).map((key) => [key, start(properties[key], context)]));
  }
  if (whole.type === "array") {
    const hasLists = whole.items && resolved(whole.items).type === "array";
    return kinds[whole.kind ?? ""] ?? Array<Json>(whole.minItems ?? 0).fill(hasLists && whole.items ? start(whole.items, context) : 0.5);
  }
  return whole.default ?? whole.enum?.[0] ?? (whole.type === "string" ? offers(whole.format, context)[0] ?? "text" : whole.minimum ?? 1);
}

/** What texts may be that name something. */
export const formats = ["field", "flow", "displacement", "group", "surface"];

export function offers(format: string | undefined, {scene, volume}: Context): string[] {
  switch (format) {
  case "surface": return (scene.surfaces ?? []).flatMap((one) => one.name ?? []);
  case "field": return volume.fields.map((one) => one.name);
  case "flow": return volume.flows;
  case "displacement": return volume.displacements;
  case "group": return volume.groups;
  default: return [];
  }
}
