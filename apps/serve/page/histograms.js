// Histograms and palettes from the server, asked for once.

/** @typedef {Record<string, any>} Json */
/** @typedef {{lower: number, upper: number, bins: number[], quantiles: number[], is_complete: boolean}} Histogram */

/** @param {(message: Json) => Promise<Json>} ask raises what is wrong */
export function makeHistograms(ask) {
  /** @type {Map<string, {known: Histogram | null, listeners: Set<() => void>}>} */
  const all = new Map();
  /** @type {Map<string, Promise<number[][]>>} */
  const palettes = new Map();

  /** @param {string} field @param {{known: Histogram | null, listeners: Set<() => void>}} entry */
  async function grow(field, entry) {
    try {
      do {
        entry.known = /** @type {any} */ (await ask({type: "histogram", field}));
        entry.listeners.forEach((listener) => listener());
      } while (!entry.known?.is_complete);
    } catch {
      // Without samples there is none: the picture says what is wrong with the field.
    }
    entry.listeners.clear();
  }

  return {
    /**
     * What is known now; `onMore` is called when that grows.
     * @param {string} field @param {Json} scene @param {() => void} onMore
     */
    of(field, scene, onMore) {
      const key = JSON.stringify([field, scene.volume?.time_step, scene.warp, field.includes("distance") ? scene.surfaces : null]);
      let entry = all.get(key);
      if (!entry) {
        entry = {known: null, listeners: new Set()};
        if (all.size > 50) {
          all.clear();
        }
        all.set(key, entry);
        grow(field, entry);
      }
      if (!entry.known?.is_complete) {
        entry.listeners.add(onMore);
      }
      return entry.known;
    },
    /**
     * [position, r, g, b] from 0 to 1.
     * @param {Json} map
     */
    palette(map) {
      const {range, scale, ...colors} = map;
      const key = JSON.stringify(colors);
      let found = palettes.get(key);
      if (!found) {
        found = ask({type: "palette", color_map: colors}).then((answer) => answer.points, () => []);
        palettes.set(key, found);
      }
      return found;
    },
  };
}
