// Colours by their places on a colour scale: [place, r, g, b] with places from 0 to 1.

/** Straight between the entries. */
export function colorAt(palette: number[][], at: number): number[] {
  const behind = Math.max(1, palette.findIndex((point) => point[0] >= at));
  const [from, to] = [palette[behind - 1], palette[Math.min(behind, palette.length - 1)]];
  const share = to[0] > from[0] ? Math.min(1, Math.max(0, (at - from[0]) / (to[0] - from[0]))) : 0;
  return [1, 2, 3].map((c) => from[c] + share * (to[c] - from[c]));
}

/**
 * The palette when points of the map are at other places: colours between two points depend on how far it is from one to the
 * other, whatever the colour space.
 */
export function withMovedPoints(palette: number[][], before: number[], after: number[]): number[][] {
  return palette.map(([at, ...color]) => {
    const next = Math.max(1, before.findIndex((place) => place >= at));
    const width = before[next] - before[next - 1];
    const share = width > 0 ? (at - before[next - 1]) / width : 0;
    return [after[next - 1] + share * (after[next] - after[next - 1]), ...color];
  });
}
