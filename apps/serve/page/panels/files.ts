// Scenes and pictures as files of the person who looks.
import {byId, element} from "../controls.js";
import type {AskOrSay} from "../messages.js";
import type {Picture} from "../view/picture.js";
import type {Json} from "../scene.js";

export function download(name: string, content: BlobPart, type: string) {
  const url = URL.createObjectURL(new Blob([content], {type}));
  element("a", {href: url, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** `stem`: of names of files. */
export type Files = {ask: AskOrSay; say: (text: string) => void; picture: Picture; stem: () => string};

/** The section's buttons. */
export function listenForFiles({ask, say, picture, stem}: Files) {
  const across = byId("save-width", HTMLInputElement), down = byId("save-height", HTMLInputElement);
  byId("save-picture", HTMLButtonElement).onclick = async () => {
    const [width, height] = [Number(across.value), Number(down.value)];
    // What is shown is what would be drawn.
    const isShown = picture.exact && picture.size[0] === width && picture.size[1] === height;
    const bytes = isShown ? picture.exact : (await ask({type: "save picture", width, height}))?.bytes;
    if (bytes) {
      download(`${stem()}.png`, bytes, "image/png");
    }
  };
  byId("save-scene", HTMLButtonElement).onclick = async () => {
    const saved = await ask({type: "save scene"});
    if (saved) {
      download(`${stem()}.json`, saved.text + "\n", "application/json");
    }
  };
  const load = byId("load-scene", HTMLInputElement);
  load.onchange = async () => {
    const file = load.files?.[0];
    load.value = "";
    if (!file) {
      return;
    }
    try {
      await ask({type: "load", scene: JSON.parse(await file.text()) as Json});
    } catch (error) {
      say(`${file.name} is no scene: ${error}`);
    }
  };
}
