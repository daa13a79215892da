#include <core/hierarchy/hierarchy.hpp>
#include <core/volume/level_set.hpp>

#include <algorithm>
#include <bit>
#include <cstring>

namespace elvis {

namespace {

/** Elements of one dispatch, or asked for at once: bounds time and memory. */
constexpr std::uint64_t block = 65536;
constexpr std::uint32_t group_size = 32;
/** Of a model, its range included; of a node. */
constexpr std::uint32_t record_size = 8;
constexpr std::size_t lower = 5, upper = 6, estimated = 7;

struct Parameters {
    std::uint32_t first, n_elements;
    std::uint32_t first_component, end_component;
};

bool holds_any(const FieldRange& range, std::span<const double> isovalues) {
    const auto first = std::lower_bound(isovalues.begin(), isovalues.end(), range.lower);
    // A range that is no number, as of an element with such values, says nothing.
    return !(range.lower <= range.upper) || (first != isovalues.end() && *first <= range.upper);
}

} // namespace

LevelSet::LevelSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_volume(volume), m_centre(data.centre()), m_classes(volume.classes().size()) {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const std::uint64_t n_elements = volume.classes()[index].n_elements;
        if (n_elements == 0) {
            continue;
        }
        ClassLevels& levels = m_classes[index];
        // Room for all elements, so that kernels composed with it stay valid.
        levels.nodes = std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), 2 * n_elements - 1, record_size);
        levels.models = std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), n_elements, record_size);
        KernelRequest request;
        request.name = "level_models of element class " + std::to_string(index);
        request.kernel = "kernels/level_models.comp";
        request.precision = data.precision();
        data.add_field(request, index, true);
        request.bindings = {{0, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(Parameters);
        levels.kernel = std::make_unique<ComposedKernel>(device, request);
    }
}

void LevelSet::make_models(const LevelComponent& component) {
    m_is_all_estimated = true;
    std::vector<std::vector<std::uint32_t>> models(m_classes.size());
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        ClassLevels& levels = m_classes[index];
        const std::uint64_t n_elements = m_volume.classes()[index].n_elements;
        levels.ranges.clear();
        levels.is_estimated.clear();
        const Buffer output(m_device, std::max<std::uint64_t>(std::min(block, n_elements), 1) * record_size * sizeof(float));
        const std::array<const Buffer*, 1> bindings = {&output};
        for (std::uint64_t first = 0; first < n_elements; first += block) {
            const auto count = static_cast<std::uint32_t>(std::min(block, n_elements - first));
            const Parameters parameters{static_cast<std::uint32_t>(first), count, component.first, component.end};
            levels.kernel->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (count + group_size - 1) / group_size);
            const auto words = output.read_items<std::uint32_t>(std::size_t{count} * record_size);
            models[index].insert(models[index].end(), words.begin(), words.end());
            for (std::size_t at = 0; at < words.size(); at += record_size) {
                levels.ranges.push_back({std::bit_cast<float>(words[at + lower]), std::bit_cast<float>(words[at + upper])});
                levels.is_estimated.push_back(words[at + estimated] != 0);
                m_is_all_estimated = m_is_all_estimated && levels.is_estimated.back();
            }
        }
    }
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        for (std::size_t at = estimated; m_is_all_estimated && at < models[index].size(); at += record_size) {
            models[index][at] = 0;
        }
        if (!models[index].empty()) {
            m_classes[index].models->write_uints(0, models[index]);
        }
    }
    m_component = component;
    m_choice = {};
}

void LevelSet::choose(std::span<const double> isovalues, const LevelComponent& component, bool skips_by_range) {
    if (component != m_component) {
        make_models(component);
    }
    Choice choice{std::vector<double>(isovalues.begin(), isovalues.end()), skips_by_range};
    if (choice == m_choice) {
        return;
    }
    std::vector<double> boxes, all;
    std::vector<std::uint32_t> chosen;
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = m_volume.classes()[index];
        ClassLevels& levels = m_classes[index];
        boxes.clear();
        chosen.clear();
        for (std::uint64_t first = 0; first < info.n_elements; first += block) {
            const std::uint64_t count = std::min(block, info.n_elements - first);
            all.resize(6 * count);
            m_volume.bounds(info.first_element + first, count, all);
            for (std::uint64_t i = 0; i < count; ++i) {
                const bool may_be_skipped = skips_by_range && (m_is_all_estimated || !levels.is_estimated[first + i]);
                if (!may_be_skipped || holds_any(levels.ranges[first + i], isovalues)) {
                    chosen.push_back(static_cast<std::uint32_t>(first + i));
                    const auto box = all.begin() + static_cast<std::ptrdiff_t>(6 * i);
                    boxes.insert(boxes.end(), box, box + 6);
                }
            }
        }
        levels.n_chosen = chosen.size();
        if (chosen.empty()) {
            continue;
        }
        const Hierarchy hierarchy(boxes, m_centre);
        std::vector<HierarchyNode> nodes(hierarchy.nodes().begin(), hierarchy.nodes().end());
        for (HierarchyNode& node : nodes) {
            node.child = node.is_leaf() ? chosen[node.child] : node.child;
        }
        std::vector<std::uint32_t> words(record_size * nodes.size());
        std::memcpy(words.data(), nodes.data(), nodes.size() * sizeof(HierarchyNode));
        levels.nodes->write_uints(0, words);
    }
    m_choice = std::move(choice);
}

std::vector<FetchBuffer> LevelSet::host_buffers(std::uint32_t element_class) const {
    return {{"core_nodes", m_classes[element_class].nodes.get()}, {"core_models", m_classes[element_class].models.get()}};
}

} // namespace elvis
