// Histograms and palettes from the server, asked for once.
import type {Ask, Histogram} from "../messages.js";
import type {ColorMap, Scene} from "../scene.js";

type Entry = {known: Histogram | null; listeners: Set<() => void>};

export class HistogramStore {
  private readonly all = new Map<string, Entry>();
  private readonly palettes = new Map<string, Promise<number[][]>>();

  /** `ask` raises what is wrong. */
  constructor(private readonly ask: Ask) {}

  private async grow(field: string, entry: Entry) {
    try {
      do {
        entry.known = await this.ask({type: "histogram", field});
        entry.listeners.forEach((listener) => listener());
      } while (!entry.known.is_complete);
    } catch {
      // Without samples there is none: the picture says what is wrong with the field.
    }
    entry.listeners.clear();
  }

  /** What is known now; `onMore` is called when that grows. */
  of(field: string, scene: Scene, onMore: () => void): Histogram | null {
    const key = JSON.stringify([field, scene.volume?.time_step, scene.warp, field.includes("distance") ? scene.surfaces : null]);
    let entry = this.all.get(key);
    if (!entry) {
      entry = {known: null, listeners: new Set()};
      if (this.all.size > 50) {
        this.all.clear();
      }
      this.all.set(key, entry);
      this.grow(field, entry);
    }
    if (!entry.known?.is_complete) {
      entry.listeners.add(onMore);
    }
    return entry.known;
  }

  /** [position, r, g, b] from 0 to 1. */
  palette(map: ColorMap): Promise<number[][]> {
    const {range: _range, scale: _scale, ...colors} = map;
    const key = JSON.stringify(colors);
    let found = this.palettes.get(key);
    if (!found) {
      found = this.ask({type: "palette", color_map: colors}).then((answer) => answer.points, () => []);
      this.palettes.set(key, found);
    }
    return found;
  }
}
