/**
 * @file line_probe.hpp
 * A straight line through the volume along which a field is shown as a plot.
 */
#pragma once

#include "volume_facts.hpp"
#include <apps/elvis/view/scene/handles.hpp>

#include <apps/elvis/answers/line_rows.hpp>
#include <apps/elvis/answers/sample_curve.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

struct LineProbe {
    Vector3 from{}, to{};
    /** A field or expression, all of whose components are shown; the scene's if absent. */
    std::optional<std::string> field;

    friend bool operator==(const LineProbe&, const LineProbe&) = default;
};

/** Points of a plot, besides the places where elements begin and end. */
inline constexpr std::size_t n_line_points = 400;

/** Through the middle of the volume, from the left to the right of the picture. */
LineProbe line_across(const VolumeFacts& volume, const Camera& camera);
/** Along an axis, through the middle of the volume. */
void lay_along(LineProbe& line, const VolumeFacts& volume, std::size_t axis);

/** Of its two ends. */
std::vector<Handle> handles_of(const LineProbe& line);
/** With the end of that number somewhere else, but in the plane of a volume that lies in one; ends stay apart. */
LineProbe with_moved_end(const LineProbe& line, const VolumeFacts& volume, std::size_t end, const Vector3& position);

/** What was found along a line. */
struct LineAnswer {
    LineProbe line;
    std::vector<commands::LineRow> rows;
    /** One a component. */
    std::vector<commands::SampledCurve> curves;
    /** Where elements begin or end. */
    std::vector<Vector3> breaks;
    /** Why there is no plot, or why it has no breaks. */
    std::string error, remark;
};

LineAnswer answer_of(const LineProbe& line, const commands::SampleTable& table);

/** Tab-separated, a line of names first: arc length, position, element, values. */
std::string table_text(const LineAnswer& answer);

} // namespace elvis::view
