#include <core/demand/demand_ranges.hpp>

#include <core/base/error.hpp>
#include <core/demand/selected_volume.hpp>
#include <core/expression/expression.hpp>
#include <core/render/field/field_range.hpp>
#include <core/volume/field/field_extrema.hpp>
#include <core/volume/outline.hpp>

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

const FieldExtrema& DemandRanges::extrema(const FieldChoice& field, std::uint32_t time_step) {
    const std::pair key(field.expression ? "= " + field.expression->text()
                                         : std::to_string(field.field) + "." + std::to_string(field.component),
                        time_step);
    if (const auto known = m_extrema.find(key); known != m_extrema.end()) {
        return known->second;
    }
    const auto refuse = [&](const std::string& why) -> std::optional<FieldExtrema> {
        throw Error("color_map", "has no range: the extrema of " + choice_text(field, m_whole) + " over all elements " + why +
                                     "; give a range");
    };
    const auto find = [&]() -> std::optional<FieldExtrema> {
        if (field.expression) {
            return refuse("would take all of them onto the device");
        }
        if (auto told = m_whole.extrema(field.field, field.component, time_step)) {
            return told;
        }
        if (!m_whole.has_evaluation() || m_whole.is_cut()) {
            return refuse("would take all of them onto the device");
        }
        const std::uint64_t bytes = search_bytes(m_whole.fields()[field.field].n_components) * m_whole.n_elements();
        if (bytes > m_budget.host.value_or(UINT64_MAX)) {
            return refuse("take " + bytes_text(bytes) + " on the host, and the budget is " + bytes_text(*m_budget.host));
        }
        return search_extrema(m_whole, field.field, field.component, time_step, m_control);
    };
    return m_extrema.try_emplace(key, *find()).first->second;
}

const VolumeRanges::Ranges& DemandRanges::of_components(std::uint32_t field, std::uint32_t time_step) {
    auto found = m_of_components.find({field, time_step});
    if (found == m_of_components.end()) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        std::vector<FieldRange> ranges =
            ranges_from_plugin(m_device.background(), m_whole, field, time_step, certainty, [this] {
                if (m_control != nullptr) {
                    m_control->check();
                }
            });
        found = m_of_components.try_emplace({field, time_step}, std::move(ranges), certainty).first;
    }
    return found->second;
}

VolumeRanges& DemandRanges::sample(const FieldChoice& field, std::uint32_t time_step) {
    if (!m_sample) {
        m_sample = std::make_unique<Sample>(m_device, m_whole, m_precision, m_control);
    }
    for (const std::uint32_t one : fields_in(field)) {
        m_sample->ranges.set_components(one, time_step, of_components(one, time_step));
    }
    return m_sample->ranges;
}

FieldRange DemandRanges::range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    if (field.expression) {
        throw Error(field.expression->text(), "has a range only where all elements are on the device");
    }
    return sample(field, time_step).range(field, time_step, certainty);
}

double DemandRanges::value_rounding(const FieldChoice& field, std::uint32_t time_step) {
    return sample(field, time_step).value_rounding(field, time_step);
}

void DemandRanges::tell(const FrameRequest& request, VolumeRanges& ranges) {
    for (const Surface& surface : request.surfaces) {
        for (const std::uint32_t field : fields_in(surface.field)) {
            ranges.set_components(field, request.time_step, of_components(field, request.time_step));
        }
        if (surface.field.expression) {
            const std::pair key(surface.field.expression->text(), request.time_step);
            auto known = m_errors.find(key);
            if (known == m_errors.end()) {
                const double error =
                    sample(surface.field, request.time_step).float32_error(surface.field, request.time_step, 0);
                known = m_errors.try_emplace(key, error).first;
                m_sample.reset();
            }
            ranges.set_error(surface.field, request.time_step, known->second);
        }
    }
}

} // namespace elvis
