/**
 * @file shared_fold.hpp
 * A picture that several processes put together: each those pixels that lie in its tiles, from what all parts show there.
 */
#pragma once

#include <core/base/team.hpp>
#include <core/parts/fold_layers.hpp>
#include <core/parts/part_picture.hpp>
#include <core/parts/tile_parcels.hpp>
#include <core/parts/tile_shares.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace elvis {

/** A picture, or one surface of it. */
struct SharedFrame {
    /** Pixels of the process' tiles, in their order. */
    std::vector<Frame> tiles;
    /** Of the same tiles, if a surface can be seen through. */
    std::vector<LayerStack> layers{};
    /** All else; on the team's first process. */
    Frame facts;
};

/** What one process had of putting a picture together. */
struct FoldWork {
    /** Of what parts show, sent to those who put it together, and received for own tiles. */
    std::uint64_t sent_bytes = 0, received_bytes = 0;
    /** Of light: runs in own tiles, how long they took, and pixels that have light. */
    std::uint64_t n_runs = 0;
    double milliseconds = 0;
    std::uint64_t n_lit_pixels = 0;
};

/** Calls `take` for each of the process' own parts, in their order. */
using DrawParts = std::function<void(const std::function<void(const PartPicture&)>& take)>;

/** Of one picture. Its functions are called by all of the team. */
class SharedFold {
public:
    /** `diagonal`: of the whole volume's bounds. Request and team must outlive it. */
    SharedFold(const FrameRequest& request, Precision precision, double diagonal, Team& team);

    SharedFrame empty() const;
    /** `alone`: the request with this surface alone. */
    SharedFrame surface(const FrameRequest& alone, const DrawParts& draw);
    /**
     * Adds the surface of this index, that can be seen through, of which `draw` gives all layers. All that cannot are added
     * before.
     */
    void add_layers(const FrameRequest& alone, const DrawParts& draw, std::size_t index, SharedFrame& picture);
    /** Adds the surface of this index. */
    void add(const SharedFrame& surface, std::size_t index, SharedFrame& picture) const;
    /** When all are added. Those that can be seen through are mixed with the light if there is any. */
    void finish_surfaces(SharedFrame& picture) const;
    /** Depths of opaque surfaces, infinite where there is none, on all. */
    std::vector<double> depths(const SharedFrame& picture) const;
    /** FrameRequest::stops at surfaces that can be seen through, on all. */
    std::vector<std::vector<double>> stops(const SharedFrame& picture) const;
    void add_light(const DrawParts& draw, SharedFrame& picture);
    /**
     * All pixels, on the first alone, with what is counted of them; elsewhere an empty frame. Without buffers colours and flags
     * only.
     */
    Frame collected(SharedFrame picture, bool with_buffers) const;

    const FoldWork& work() const { return m_work; }

private:
    ReceivedParcels<PartPixel> exchanged(const DrawParts& draw, std::uint32_t reach, std::vector<std::byte>& facts);

    const FrameRequest& m_request;
    Precision m_precision;
    double m_diagonal;
    Team& m_team;
    TileShares m_shares;
    FoldWork m_work{};
};

} // namespace elvis
