// What the counts of a picture say of pixels that may be wrong.
import type {Frame} from "../messages.js";

const doubts: [string, string][] = [
  ["undecided_pixels", "undecided"],
  ["undecided_isosurface_pixels", "undecided of isosurfaces"],
  ["undecided_contour_pixels", "undecided of contours"],
  ["undecided_mesh_line_pixels", "undecided of mesh lines"],
  ["inexact_volume_pixels", "beyond the volume's tolerance"],
  ["work_limit_pixels", "cut short"],
  ["overlap_pixels", "of overlapping elements"],
];

/** The size, and what is known of doubts. */
export function countsText(frame: Frame): string {
  const counts = frame.counts ?? {};
  const words = doubts.filter(([name]) => counts[name] > 0).map(([name, text]) => `${counts[name]} ${text}`);
  const told = frame.stage !== "exact" ? [] : words.length > 0 ? words : ["0 undecided"];
  return [`${frame.size[0]} x ${frame.size[1]}`, ...told].join(", ");
}
