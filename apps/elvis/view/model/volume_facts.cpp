#include "volume_facts.hpp"

#include <core/base/bounds.hpp>
#include <core/plugin_host/plugin.hpp>

#include <algorithm>

namespace elvis::view {

double VolumeFacts::diagonal() const { return diagonal_of(bounds); }

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

} // namespace elvis::view
