// Scenes and pictures as files of the person who looks.
import {byId, element} from "../controls.js";
import type {Ask, PictureFormat} from "../messages.js";
import type {Picture} from "../view/picture.js";
import type {Json} from "../scene.js";
import type {Work} from "./work.js";

export function download(name: string, content: BlobPart, type: string) {
  save(name, new Blob([content], {type}));
}

export function save(name: string, content: Blob) {
  const url = URL.createObjectURL(content);
  element("a", {href: url, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** `stem`: of names of files; `size`: of pictures that are saved. */
export type Files = {ask: Ask; say: (what: unknown) => void; work: Work; picture: Picture; size: () => [number, number]; stem: () => string};

/** The section's buttons. */
export function listenForFiles({ask, say, work, picture, size, stem}: Files) {
  const formats = byId("save-format", HTMLSelectElement);
  byId("save-picture", HTMLButtonElement).onclick = async () => {
    const [width, height] = size();
    const format = formats.value as PictureFormat;
    // What is shown is what would be drawn.
    const isShown = format === "png" && picture.exact && picture.size[0] === width && picture.size[1] === height;
    const drawn = isShown ? {bytes: picture.exact, mime: "image/png"}
      : await work.run("drawing a picture", () => ask({type: "save picture", width, height, format}));
    if (drawn?.bytes) {
      download(`${stem()}.${format}`, drawn.bytes, drawn.mime);
    }
  };
  byId("save-scene", HTMLButtonElement).onclick = async () => {
    try {
      const saved = await ask({type: "save scene"});
      download(`${stem()}.json`, saved.text + "\n", "application/json");
    } catch (error) {
      say(error);
    }
  };
  const load = byId("load-scene", HTMLInputElement);
  load.onchange = async () => {
    const file = load.files?.[0];
    load.value = "";
    try {
      if (file) {
        await ask({type: "load", scene: JSON.parse(await file.text()) as Json});
      }
    } catch (error) {
      say(`${file?.name}: ${error instanceof Error ? error.message : error}`);
    }
  };
}
