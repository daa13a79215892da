// Numbers on axes.

/**
 * Round numbers in a range.
 * @param {number} low @param {number} high @param {number} most
 */
export function ticks(low, high, most) {
  const rough = (high - low) / Math.max(1, most);
  if (!(rough > 0) || !Number.isFinite(rough)) {
    return [];
  }
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough / power > 5 ? 10 : rough / power > 2 ? 5 : rough / power > 1 ? 2 : 1);
  const all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step && all.length < 100; ++i) {
    all.push(i * step);
  }
  return all;
}

/** @param {number} value */
export const short = (value) => String(Number(value.toPrecision(4)));

/**
 * Values between ends, as shares of a width. Logarithmic where the lower end allows it.
 * @param {[number, number]} ends @param {boolean} isLogarithmic
 */
export function scale(ends, isLogarithmic) {
  const [low, high] = isLogarithmic && ends[0] > 0 ? ends.map(Math.log) : ends;
  const width = high > low ? high - low : 1;
  const isLog = isLogarithmic && ends[0] > 0;
  return {
    /** @param {number} value */
    place: (value) => ((isLog ? Math.log(Math.max(value, Number.MIN_VALUE)) : value) - low) / width,
    /** @param {number} place */
    value: (place) => (isLog ? Math.exp(low + place * width) : low + place * width),
  };
}
