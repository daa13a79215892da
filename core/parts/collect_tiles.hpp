/**
 * @file collect_tiles.hpp
 * Finished pixels on their way to the process that writes the picture.
 */
#pragma once

#include <core/base/team.hpp>
#include <core/parts/shared_fold.hpp>
#include <core/parts/tile_shares.hpp>

#include <span>
#include <vector>

namespace elvis {

/** A number of each pixel, from those of own tiles; on the team's first process, elsewhere none. Called by all. */
std::vector<double> collected_numbers(const TileShares& shares, std::span<const std::vector<double>> of_tiles, Team& team);

/** SharedFold::collected. Tiles that show nothing are not sent. */
Frame collected_frame(const TileShares& shares, const FrameRequest& request, Precision precision, SharedFrame picture,
                      bool with_buffers, Team& team);

} // namespace elvis
