#include <core/demand/demand_ranges.hpp>

#include <core/base/error.hpp>
#include <core/expression/expression.hpp>
#include <core/plugin_host/selected_volume.hpp>
#include <core/render/field/field_range.hpp>
#include <core/volume/field/field_extrema.hpp>
#include <core/volume/field/weighted_derivatives.hpp>
#include <core/volume/outline.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace elvis {

namespace {

/** Of an element, while extrema are searched for: what is known of it twice, and its place in a queue. */
std::uint64_t search_bytes(std::uint32_t n_components) { return 128 + 32 * std::uint64_t{n_components}; }

std::string choice_text(const FieldChoice& field, const RuntimeVolume& volume) {
    return field.expression ? field.expression->text() : volume.fields()[field.field].name;
}

/** See rounding_of_expression: every so many elements of a class. */
std::vector<std::uint64_t> sampled_elements(const RuntimeVolume& volume) {
    constexpr std::uint64_t most_elements = expression_error_samples;
    std::vector<std::uint64_t> elements;
    for (const ClassInfo& info : volume.classes()) {
        const std::uint64_t stride = (info.n_elements + most_elements - 1) / most_elements;
        for (std::uint64_t local = 0; local < info.n_elements; local += stride) {
            elements.push_back(info.first_element + local);
        }
    }
    return elements;
}

/** Of surfaces, and of what isosurfaces are of. */
std::vector<FieldChoice> shown_fields(const FrameRequest& request) {
    std::vector<FieldChoice> fields;
    for (const Surface& surface : request.surfaces) {
        fields.push_back(surface.field);
        if (const Isosurfaces* const isosurfaces = traits_of(surface.geometry).isosurfaces) {
            fields.push_back(isosurfaces->field);
        }
    }
    return fields;
}

std::set<std::uint32_t> fields_in(const FieldChoice& choice) {
    if (!choice.expression) {
        return {choice.field};
    }
    const auto used = choice.expression->fields();
    return {used.begin(), used.end()};
}

} // namespace

struct DemandRanges::Sample {
    RuntimeVolume volume;
    DeviceVolume data;
    VolumeRanges ranges;

    Sample(const Device& device, const RuntimeVolume& whole, Precision precision, const TaskControl* control)
        : volume(selected_volume(whole, sampled_elements(whole), SelectedFaces::none)),
          data(device, volume, precision, control), ranges(device, volume, data) {}
};

DemandRanges::DemandRanges(const Device& device, const RuntimeVolume& whole, Precision precision, const BoxBlocks& blocks,
                           const MemoryBudget& budget, const TaskControl* control)
    : m_device(device), m_whole(whole), m_precision(precision), m_blocks(blocks), m_budget(budget), m_control(control) {}

DemandRanges::~DemandRanges() = default;

const std::vector<Vector3>& DemandRanges::outline() {
    if (m_outline.empty()) {
        m_outline = outline_points(m_whole, m_blocks);
    }
    return m_outline;
}

/** What the plugin tells, or a search finds; else why there is none. */
std::optional<FieldExtrema> DemandRanges::search(const FieldChoice& field, std::uint32_t time_step,
                                                 std::string& why_not) const {
    if (!field.expression) {
        if (auto told = m_whole.extrema(field.field, field.component, time_step)) {
            return told;
        }
    }
    if (field.expression || !m_whole.has_evaluation() || m_whole.is_cut()) {
        why_not = "would take all of them onto the device";
        return {};
    }
    const std::uint64_t bytes = search_bytes(m_whole.fields()[field.field].n_components) * m_whole.n_elements();
    if (bytes > m_budget.host.value_or(UINT64_MAX)) {
        why_not = "take " + bytes_text(bytes) + " on the host, and the budget is " + bytes_text(*m_budget.host);
        return {};
    }
    return search_extrema(m_whole, field.field, field.component, time_step, m_control);
}

const FieldExtrema* DemandRanges::found_extrema(const FieldChoice& field, std::uint32_t time_step, std::string& why_not) {
    const std::pair key(field.expression ? "= " + field.expression->text()
                                         : std::to_string(field.field) + "." + std::to_string(field.component),
                        time_step);
    auto known = m_extrema.find(key);
    if (known == m_extrema.end()) {
        const std::optional<FieldExtrema> found = search(field, time_step, why_not);
        if (!found) {
            return nullptr;
        }
        known = m_extrema.try_emplace(key, *found).first;
    }
    return &known->second;
}

const FieldExtrema& DemandRanges::extrema(const FieldChoice& field, std::uint32_t time_step) {
    std::string why_not;
    if (const FieldExtrema* const found = found_extrema(field, time_step, why_not)) {
        return *found;
    }
    throw Error("color_map", "has no range: the extrema of " + choice_text(field, m_whole) + " over all elements " + why_not +
                                 "; give a range");
}

const RangeBlocks& DemandRanges::blocks_of(std::uint32_t field, std::uint32_t time_step) {
    const std::pair key(field, time_step);
    return m_blocks_of.try_emplace(key, m_whole, field, time_step, m_device.background(), m_control).first->second;
}

bool DemandRanges::are_proven(std::uint32_t field, std::uint32_t time_step) {
    if (blocks_of(field, time_step).total().second != ELVIS_CERTIFIED) {
        return false;
    }
    if (!m_whole.has_derivative_bounds()) {
        return true;
    }
    const std::uint64_t element = m_blocks.farthest().front();
    std::uint32_t element_class = 0;
    while (element >= m_whole.classes()[element_class].first_element + m_whole.classes()[element_class].n_elements) {
        ++element_class;
    }
    std::vector<DerivativeBounds> bounds(m_whole.fields()[field].n_components);
    const elvis_certainty certainty = read_weighted_derivatives(m_whole, element_class, field, time_step, element, 1, bounds);
    return certainty == ELVIS_CERTIFIED && std::ranges::all_of(bounds, [](const DerivativeBounds& of_component) {
               return std::isfinite(of_component.first) && std::isfinite(of_component.second);
           });
}

VolumeRanges& DemandRanges::sample(const FieldChoice& field, std::uint32_t time_step) {
    if (!m_sample) {
        m_sample = std::make_unique<Sample>(m_device, m_whole, m_precision, m_control);
    }
    for (const std::uint32_t one : fields_in(field)) {
        m_sample->ranges.set_components(one, time_step, blocks_of(one, time_step).total());
    }
    return m_sample->ranges;
}

FieldRange DemandRanges::range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    if (field.expression) {
        throw Error(field.expression->text(), "has a range only where all elements are on the device");
    }
    return sample(field, time_step).range(field, time_step, certainty);
}

FieldRange DemandRanges::sampled_range(const FieldChoice& field, std::uint32_t time_step) {
    return sample(field, time_step).range(field, time_step);
}

double DemandRanges::value_rounding(const FieldChoice& field, std::uint32_t time_step) {
    return sample(field, time_step).value_rounding(field, time_step);
}

void DemandRanges::tell(const FrameRequest& request, VolumeRanges& ranges) {
    for (const FieldChoice& choice : shown_fields(request)) {
        for (const std::uint32_t field : fields_in(choice)) {
            ranges.set_components(field, request.time_step, blocks_of(field, request.time_step).total());
        }
        if (choice.expression) {
            const std::pair key(choice.expression->text(), request.time_step);
            auto known = m_errors.find(key);
            if (known == m_errors.end()) {
                const double error = sample(choice, request.time_step).float32_error(choice, request.time_step, 0);
                known = m_errors.try_emplace(key, error).first;
                m_sample.reset();
            }
            ranges.set_error(choice, request.time_step, known->second);
        }
    }
}

const FieldExtrema& RoughDemandRanges::extrema(const FieldChoice& field, std::uint32_t time_step) {
    std::string why_not;
    if (const FieldExtrema* const found = m_ranges.found_extrema(field, time_step, why_not)) {
        return *found;
    }
    const FieldRange around = range(field, time_step);
    m_enclosure = {{around.lower, around.lower, 0, {}}, {around.upper, around.upper, 0, {}}, ELVIS_ESTIMATED};
    return m_enclosure;
}

FieldRange RoughDemandRanges::range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    if (!field.expression) {
        return m_ranges.range(field, time_step, certainty);
    }
    if (certainty != nullptr) {
        *certainty = ELVIS_ESTIMATED;
    }
    return m_ranges.sampled_range(field, time_step);
}

} // namespace elvis
