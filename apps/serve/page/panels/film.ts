// The pictures of the scene's animation, drawn one by one and saved together.
import {byId} from "../controls.js";
import type {Ask} from "../messages.js";
import type {Work} from "./work.js";
import {mostBytes, zipOf} from "./zip.js";
import type {NamedFile} from "./zip.js";

/** `ask` raises what is wrong. */
export type FilmTools = {ask: Ask; work: Work; size: () => [number, number]; save: (name: string, content: Blob) => void; stem: () => string};

export class FilmPanel {
  private readonly button = byId("save-film", HTMLButtonElement);

  constructor(private readonly tools: FilmTools) {
    this.button.onclick = async () => {
      const pictures = await tools.work.run("drawing a film", (isStopped) => this.pictures(isStopped));
      if (pictures) {
        tools.save(`${tools.stem()}-film.zip`, zipOf(pictures));
      }
    };
  }

  show(hasAnimation: boolean) {
    this.button.disabled = !hasAnimation;
  }

  private async pictures(isStopped: () => boolean): Promise<NamedFile[]> {
    const {ask, work, size} = this.tools;
    const [width, height] = size();
    const all: NamedFile[] = [];
    let nBytes = 0;
    try {
      const {n_pictures} = await ask({type: "film", width, height});
      for (let index = 0; index < n_pictures && !isStopped(); ++index) {
        work.step(index, n_pictures);
        const {name, bytes} = await ask({type: "film picture", index});
        nBytes += bytes?.length ?? 0;
        if (nBytes > mostBytes / 2) {
          throw new Error("the film is larger than a page can hold: save the scene for elvis render");
        }
        all.push({name, bytes: bytes ?? new Uint8Array()});
      }
    } finally {
      await ask({type: "stop"}).catch(() => null); // Without a connection there is no film.
    }
    return all;
  }
}
