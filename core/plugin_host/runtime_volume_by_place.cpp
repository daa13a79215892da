#include <core/base/error.hpp>
#include <core/plugin_host/runtime_volume_impl.hpp>

#include <algorithm>
#include <vector>

namespace elvis {

void RuntimeVolume::add_by_place(std::shared_ptr<const FieldsByPlace> others) {
    for (std::uint32_t field = 0; field < others->fields().size(); ++field) {
        FieldInfo info = others->fields()[field];
        info.is_by_place = true;
        m_impl->fields.push_back(std::move(info));
        m_impl->by_place.push_back({others, field});
    }
}

void RuntimeVolume::need_own(std::uint32_t field) const { m_impl->need_own(field); }

void RuntimeVolume::Impl::need_own(std::uint32_t field) const {
    // Volumes without fields are asked about their geometry with field 0.
    if (field < fields.size() && fields[field].is_by_place) {
        throw Error(path, "the field " + fields[field].name +
                              " is found by place in another volume, and nothing is known of it between points: it can be "
                              "shown on planes, boundaries, elements and other surfaces, be the colour of isosurfaces, be "
                              "probed, sampled and integrated, but has no certain contours, isosurfaces, thresholds, volume "
                              "rendering, streaks and extracted meshes");
    }
}

/** Gradients come in the world, and are asked for by reference coordinates. */
void RuntimeVolume::evaluate_by_place(std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                                      std::span<const double> xi, std::span<double> values, std::span<double> gradients) const {
    const auto& [others, index] = m_impl->by_place[field - m_impl->info.n_fields];
    std::vector<double> positions(xi.size()), jacobians(gradients.empty() ? 0 : 3 * xi.size()), slopes(gradients.size());
    evaluate_mapping(element, xi, positions, jacobians);
    others->evaluate(index, time_step, positions, values, slopes);
    const std::size_t n_components = m_impl->fields[field].n_components;
    for (std::size_t at = 0; at < slopes.size(); at += 3) {
        const double* const jacobian = &jacobians[9 * (at / (3 * n_components))];
        for (std::size_t j = 0; j < dimension(); ++j) {
            gradients[at + j] = jacobian[j] * slopes[at] + jacobian[3 + j] * slopes[at + 1] + jacobian[6 + j] * slopes[at + 2];
        }
    }
}

double RuntimeVolume::jump_by_place(std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                                    const std::array<double, 3>& xi, double reach) const {
    const auto& [others, index] = m_impl->by_place[field - m_impl->info.n_fields];
    std::array<double, 3> position{};
    evaluate_mapping(element, xi, position, {});
    return others->jump(index, time_step, position, reach);
}

} // namespace elvis
