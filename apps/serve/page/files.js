// Scenes and pictures as files of the person who looks.
import {element} from "./controls.js";

/** @typedef {Record<string, any>} Json */

/** @param {string} id */
const $ = (id) => /** @type {any} */ (document.getElementById(id));

/** @param {string} name @param {BlobPart} content @param {string} type */
export function download(name, content, type) {
  const url = URL.createObjectURL(new Blob([content], {type}));
  const link = /** @type {HTMLAnchorElement} */ (element("a", {href: url, download: name}));
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/**
 * The section's buttons.
 * @param {{ask: (message: Json) => Promise<Json | null>, say: (text: string) => void, picture: import("./picture.js").Picture,
 *          stem: () => string}} does `stem`: of names of files
 */
export function listenForFiles({ask, say, picture, stem}) {
  $("save-picture").onclick = async () => {
    const [width, height] = [Number($("save-width").value), Number($("save-height").value)];
    // What is shown is what would be drawn.
    const isShown = picture.exact && picture.size[0] === width && picture.size[1] === height;
    const bytes = isShown ? picture.exact : (await ask({type: "save picture", width, height}))?.bytes;
    if (bytes) {
      download(`${stem()}.png`, bytes, "image/png");
    }
  };
  $("save-scene").onclick = async () => {
    const saved = await ask({type: "save scene"});
    if (saved) {
      download(`${stem()}.json`, saved.text + "\n", "application/json");
    }
  };
  $("load-scene").onchange = async () => {
    const file = $("load-scene").files[0];
    $("load-scene").value = "";
    try {
      if (file) {
        await ask({type: "load", scene: JSON.parse(await file.text())});
      }
    } catch (error) {
      say(`${file.name} is no scene: ${error}`);
    }
  };
}
