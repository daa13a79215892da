// Numbers on axes.

/** Round numbers in a range. */
export function ticks(low: number, high: number, most: number): number[] {
  const rough = (high - low) / Math.max(1, most);
  if (!(rough > 0) || !Number.isFinite(rough)) {
    return [];
  }
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough / power > 5 ? 10 : rough / power > 2 ? 5 : rough / power > 1 ? 2 : 1);
  const all: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step && all.length < 100; ++i) {
    all.push(i * step);
  }
  return all;
}

export const short = (value: number) => String(Number(value.toPrecision(4)));

/** Values between ends, as shares of a width. Logarithmic where the lower end allows it. */
export function scale(ends: [number, number], isLogarithmic: boolean) {
  const isLog = isLogarithmic && ends[0] > 0;
  const [low, high] = isLog ? ends.map(Math.log) : ends;
  const width = high > low ? high - low : 1;
  return {
    place: (value: number) => ((isLog ? Math.log(Math.max(value, Number.MIN_VALUE)) : value) - low) / width,
    value: (place: number) => (isLog ? Math.exp(low + place * width) : low + place * width),
  };
}
