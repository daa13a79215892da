/**
 * @file bands.hpp
 * One picture in bands of rows: by several devices, or by one whose buffers are too small for all of it.
 */
#pragma once

#include <core/render/renderer.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace elvis {

/** Rows of a picture. */
struct Rows {
    std::uint32_t first = 0, end = 0;
};

/**
 * Draws the picture in bands of so many rows, a multiple of part_rows, and gives each with its rows to `take`, in any order,
 * one at a time. Renderers take bands at the same time; on devices of one kind each row is that of the whole picture, to the
 * bit. Returns counts and times, which `take` need not look at: work adds up, and near the borders between bands some of it is
 * done twice; times are those of the slowest renderer. The renderers are of the same volume, opened once for each. Throws what
 * one throws.
 */
Frame render_bands(std::span<Renderer* const> renderers, const FrameRequest& request, std::uint32_t n_rows,
                   const TaskControl* control, const std::function<void(const Frame& band, const Rows& rows)>& take);

/** Adds all of a frame but its pixels and times: counts, what is met and shown. */
void add_part(const Frame& part, Frame& whole);

/** Rows a band: as many as the devices can bind buffers for, and few enough that each renderer has a band. */
std::uint32_t rows_a_band(std::span<Renderer* const> renderers, const FrameRequest& request);

/** The whole picture in such bands; by the one renderer as it is if there is one, and it fits. */
Frame render_in_bands(std::span<Renderer* const> renderers, const FrameRequest& request, const TaskControl* control = nullptr);

/** What is asked for in such bands, a multiple of part_rows each, with the rows around them that lines look at. */
std::vector<FrameRequest> bands_of(const FrameRequest& request, std::uint32_t n_rows);

/** Draws bands one after the other, each by `draw`, and gives each with its rows to `take`. Returns what render_bands does. */
Frame render_band_by_band(const FrameRequest& request, std::uint32_t n_rows,
                          const std::function<Frame(const FrameRequest& band)>& draw,
                          const std::function<void(const Frame& band, const Rows& rows)>& take);

/** The picture in these bands: to the bit what one renderer draws at once. */
Frame render_band_by_band(const FrameRequest& request, std::uint32_t n_rows,
                          const std::function<Frame(const FrameRequest& band)>& draw);

} // namespace elvis
