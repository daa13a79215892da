// What the page knows of a scene's form; the schema knows the rest.

export type Json = null | boolean | number | string | Json[] | JsonObject;
export type JsonObject = {[key: string]: Json | undefined};

export type Triple = [number, number, number];
export type Camera = {type?: string; eye: Triple; look_at: Triple; up: Triple};
export type ColorMap = {name?: string; file?: string; points?: number[][]; space?: string; range?: [number, number]; scale?: string};
export type Peak = {value: number; width: number; density: number; color?: number[]};
export type VolumeRendering = {
  field?: string; color_map?: ColorMap; density?: number[][]; opacity?: number[][]; peaks?: Peak[]; transfer?: Json;
};
export type Surface = {type: string; name?: string; plane?: number[]};
export type View = {name: string; camera: Camera};
export type Scene = {
  camera?: Camera; views?: View[]; field?: string; color_map?: ColorMap; warp?: Json; animation?: Json; volume?: {time_step?: number}; image?: {size?: [number, number]};
  surfaces?: Surface[]; lighting?: {lights?: JsonObject[]}; volume_rendering?: VolumeRendering;
};
