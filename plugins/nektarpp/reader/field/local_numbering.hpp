/**
 * @file local_numbering.hpp
 * Corners and edges of an element in local order. Nektar++ stores no orientation: all follows from which edges its faces share,
 * and which vertices its edges share.
 */
#pragma once

#include "../geometry/geometry_data.hpp"

namespace nektarpp {

struct LocalElement {
    /** Vertex ids in the order of elvis/element.h, which is that of Nektar++. */
    std::array<std::int64_t, 8> corners{};
    /** Edge ids in the order of local_edges. */
    std::array<std::int64_t, 12> edges{};
    /** Whether a local edge runs against the file's. */
    std::array<bool, 12> is_reversed{};
};

/** Throws elvis::api::Error that names the element if its sides do not form its shape. */
LocalElement number_locally(const GeometryData& data, const ElementRecord& element);

/** Vertex ids of a face's own corners: corner j is the end of edge j that is not on edge j+1. `which` names it in errors. */
std::vector<std::int64_t> face_frame(const GeometryData& data, std::span<const std::int64_t> edges, const std::string& which);

/** "pyramid 17" */
std::string name_of(const ElementRecord& element);

} // namespace nektarpp
