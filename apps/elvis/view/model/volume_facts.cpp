#include "volume_facts.hpp"

#include <core/plugin_host/plugin.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::view {

double VolumeFacts::diagonal() const { return std::hypot(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]); }

VolumeFacts facts_of(const RuntimeVolume& volume, VolumeRanges& ranges) {
    VolumeFacts facts;
    facts.path = volume.path();
    facts.plugin = volume.plugin().name();
    facts.dimension = volume.dimension();
    facts.n_elements = volume.n_elements();
    facts.bounds = ranges.bounds();
    facts.outline = ranges.outline();
    facts.fields = volume.fields();
    facts.times = volume.times();
    facts.boundary_groups = volume.boundary_groups();
    facts.has_faces = volume.n_faces() > 0;
    for (const ClassInfo& element_class : volume.classes()) {
        const auto shape = static_cast<std::uint32_t>(element_class.shape);
        if (std::find(facts.shapes.begin(), facts.shapes.end(), shape) == facts.shapes.end()) {
            facts.shapes.push_back(shape);
        }
    }
    return facts;
}

const char* shape_name(std::uint32_t shape) {
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return "hexahedron";
    case ELVIS_SHAPE_PRISM:
        return "prism";
    case ELVIS_SHAPE_PYRAMID:
        return "pyramid";
    case ELVIS_SHAPE_TETRAHEDRON:
        return "tetrahedron";
    case ELVIS_SHAPE_QUADRILATERAL:
        return "quadrilateral";
    case ELVIS_SHAPE_TRIANGLE:
        return "triangle";
    default:
        return "other";
    }
}

} // namespace elvis::view
