/**
 * @file missed_surfaces.hpp
 * Which surfaces of one or more pictures are met by no pixel's ray.
 */
#pragma once

#include <core/render/field/picture_ranges.hpp>
#include <core/render/frame.hpp>
#include <core/scene/scene.hpp>

#include <string>
#include <vector>

namespace elvis {

/**
 * Pictures of one scene, whose camera and time step may differ. A surface that others hide is met, and one of which a pixel
 * stays open may be: only what is met nowhere for certain is missed.
 */
class MissedSurfaces {
public:
    void add(const FrameRequest& request, const Frame& frame);

    /** A sentence about each that all pictures so far miss. `scene` is theirs; `request` one of theirs. */
    std::vector<std::string> remarks(const Scene& scene, const FrameRequest& request, PictureRanges& ranges) const;

private:
    struct Range {
        FieldRange range;
        bool is_certified;
    };
    /** The field's values over all time steps, and what encloses them. */
    Range values_of(const FieldChoice& field, PictureRanges& ranges) const;
    Range enclosure_of(const FieldChoice& field, PictureRanges& ranges) const;
    std::string isosurface_remark(const SceneSurface& surface, const std::string& field, const Surface& drawn, bool is_met,
                                  PictureRanges& ranges) const;

    /** By surface as the requests have them. */
    std::vector<bool> m_is_met;
    std::vector<std::uint32_t> m_time_steps;
    bool m_volume_is_missed = false;
};

} // namespace elvis
