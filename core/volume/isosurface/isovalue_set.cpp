#include <core/base/vector3.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/volume/isosurface/isovalue_set.hpp>
#include <core/volume/isosurface/octant_records.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace elvis {

namespace {

/** Elements of one dispatch, or asked for at once: bounds time and memory. */
constexpr std::uint64_t isovalue_block = 65536;
constexpr std::uint32_t isovalue_group_size = 32;
constexpr std::size_t child_word = 3;
constexpr std::uint32_t octant_is_estimated = 0x80000000u;
constexpr std::uint32_t most_isovalue_levels = 3;
/** Of octants whose mapping is bent so much that it has no linear model. */
constexpr std::uint32_t most_bent_levels = 6;
/** Octants for which there is room from the beginning; that are enough for any picture; and of each element that is bent. */
constexpr std::uint64_t least_room = 1u << 17, most_room = 1u << 20, room_of_bent_element = 4096;
/** Of elements that are not bent. */
constexpr float small_curvature = 0.25f;
/**
 * Elements are divided where their error is more than this share of how much the field varies in them, octants where it is more
 * than that: many small octants cost more to look through than they spare evaluations.
 */
constexpr double wanted_error = 0.05, wanted_octant_error = 0.5;

struct OctantParameters {
    std::uint32_t n_octants;
    std::uint32_t first_component, end_component;
};

} // namespace

std::uint64_t most_isosurface_octants(std::uint64_t n_elements, std::uint64_t n_bent) {
    const std::uint64_t wanted = std::max(8 * n_elements, room_of_bent_element * n_bent);
    return std::max(n_elements, std::clamp(wanted, least_room, most_room));
}

/** As the kernel gives them. */
struct IsovalueSet::Octants {
    std::vector<std::uint32_t> words;

    std::size_t size() const { return words.size() / octant_words; }
    std::uint32_t word(std::size_t octant, std::size_t index) const { return words[octant * octant_words + index]; }
    float number(std::size_t octant, std::size_t index) const { return std::bit_cast<float>(word(octant, index)); }
    bool holds_any(std::size_t octant, std::span<const double> isovalues) const {
        return elvis::holds_any({number(octant, octant_range), number(octant, octant_range + 1)}, isovalues);
    }
    bool is_linear(std::size_t octant) const { return number(octant, octant_scale) > 0; }
    /** Whether an octant of this level is bent so much that nothing is found in it. */
    bool is_bent(std::size_t octant, std::uint32_t level) const { return !is_linear(octant) && level < most_bent_levels; }
    /** Whether an octant of this level is to be divided, if it is to hold an isovalue. */
    bool is_rough(std::size_t octant, std::uint32_t level) const {
        if (!is_linear(octant)) {
            return is_bent(octant, level);
        }
        double slope = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            slope += std::abs(double{number(octant, octant_slope + k)});
        }
        const double wanted = level > 0 ? wanted_octant_error : wanted_error;
        return level < most_isovalue_levels && number(octant, octant_error) > wanted * slope;
    }
    void add(const Octants& other, std::size_t octant) {
        const auto begin = other.words.begin() + static_cast<std::ptrdiff_t>(octant * octant_words);
        words.insert(words.end(), begin, begin + octant_words);
    }
    void append(const Octants& other) { words.insert(words.end(), other.words.begin(), other.words.end()); }
};

IsovalueSet::IsovalueSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_volume(volume), m_data(data), m_precision(data.precision()), m_centre(data.centre()),
      m_models(device, volume, data), m_classes(volume.classes().size()) {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const std::uint64_t n_elements = volume.classes()[index].n_elements;
        if (n_elements == 0) {
            continue;
        }
        ClassOctants& of_class = m_classes[index];
        // Room for all elements, so that kernels composed with it stay valid.
        of_class.nodes =
            std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), 2 * n_elements - 1, node_size);
        make_room(of_class, least_room);
        KernelRequest request;
        request.name = "octants of element class " + std::to_string(index);
        request.kernel = "isosurface/octants.comp";
        request.watches_loops = true;
        request.precision = data.precision();
        data.add_field(request, index, true);
        request.bindings = buffer_bindings({.storage = 3});
        request.push_constant_bytes = sizeof(OctantParameters);
        of_class.octant_kernel = std::make_unique<ComposedKernel>(device, request);
    }
}

/** For so many octants, at least. */
void IsovalueSet::make_room(ClassOctants& of_class, std::uint64_t n_octants) const {
    if (n_octants > of_class.room) {
        of_class.room = std::bit_ceil(n_octants);
        of_class.octant_nodes =
            std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, 2 * of_class.room - 1, node_size);
        of_class.octants = std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, of_class.room, octant_size);
    }
}

void IsovalueSet::provide_ranges(const ScalarComponent& component, const std::optional<ToldField>& told) {
    if (component == m_component) {
        return;
    }
    m_component = {0, 0};
    m_is_chosen = false;
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        m_classes[index].told.clear();
        if (told) {
            m_classes[index].told =
                told_ranges(m_device.background(), m_volume, index, *told, [this] { m_device.check_task(); });
        }
    }
    // Last: models that are there tell no ranges, and what comes before may be cancelled.
    std::vector<std::vector<ModelRange>> ranges;
    m_models.provide(component, &ranges);
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        m_classes[index].ranges = std::move(ranges[index]);
    }
    m_component = component;
}

void IsovalueSet::choose(std::span<const double> isovalues, const ScalarComponent& component, bool skips_by_range,
                         const std::optional<ToldField>& told) {
    provide_ranges(component, told);
    Choice choice{std::vector<double>(isovalues.begin(), isovalues.end()), skips_by_range};
    if (m_is_chosen && choice == m_choice) {
        return;
    }
    m_is_chosen = false;
    m_choice = std::move(choice);
    std::vector<double> all;
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = m_volume.classes()[index];
        ClassOctants& of_class = m_classes[index];
        of_class.chosen.clear();
        of_class.boxes.clear();
        of_class.has_element_nodes = false;
        of_class.n_octants = 0;
        for (std::uint64_t first = 0; first < info.n_elements; first += isovalue_block) {
            const std::uint64_t count = std::min(isovalue_block, info.n_elements - first);
            all.resize(6 * count);
            m_volume.bounds(info.first_element + first, count, all);
            for (std::uint64_t i = 0; i < count; ++i) {
                if (is_wanted(of_class, first + i)) {
                    of_class.chosen.push_back(static_cast<std::uint32_t>(first + i));
                    const auto box = all.begin() + static_cast<std::ptrdiff_t>(6 * i);
                    of_class.boxes.insert(of_class.boxes.end(), box, box + 6);
                }
            }
        }
        const auto n_bent = std::ranges::count_if(
            of_class.chosen, [&](std::uint32_t element) { return !(m_data.curvatures(index)[element] <= small_curvature); });
        of_class.most = most_isosurface_octants(of_class.chosen.size(), static_cast<std::uint64_t>(n_bent));
    }
    make_octants();
    m_is_chosen = true;
}

bool IsovalueSet::is_wanted(const ClassOctants& of_class, std::uint64_t element) const {
    const ModelRange& range = of_class.ranges[element];
    const bool is_excluded =
        m_choice.skips_by_range && !of_class.told.empty() && !holds_any(of_class.told[element], m_choice.isovalues);
    return !is_excluded && (!may_skip(range) || holds_any({range.lower, range.upper}, m_choice.isovalues));
}

bool IsovalueSet::may_skip(const ModelRange& range) const {
    return m_choice.skips_by_range && (rests_on_estimates() || !range.is_estimated);
}

void IsovalueSet::dispatch(const ClassOctants& of_class, std::span<const std::uint32_t> elements_and_codes,
                           std::vector<std::unique_ptr<const Buffer>>& buffers, KernelResults& results) const {
    const std::size_t count = elements_and_codes.size() / 2;
    const auto make = [&](std::size_t bytes) {
        return buffers.emplace_back(std::make_unique<const Buffer>(m_device, bytes)).get();
    };
    const Buffer* const output = make(count * octant_words * sizeof(std::uint32_t));
    const std::array<const Buffer*, 3> bindings = {make(elements_and_codes.size_bytes()), output, make(sizeof(m_centre))};
    bindings[0]->write_items(elements_and_codes);
    write_reals(*bindings[2], m_precision, m_centre);
    const OctantParameters parameters{static_cast<std::uint32_t>(count), m_component.first, m_component.end};
    results.dispatch(*of_class.octant_kernel, bindings, std::as_bytes(std::span(&parameters, 1)),
                     static_cast<std::uint32_t>((count + isovalue_group_size - 1) / isovalue_group_size), *output,
                     count * octant_words);
}

std::vector<std::uint32_t> IsovalueSet::evaluate(const ClassOctants& of_class,
                                                 std::span<const std::uint32_t> elements_and_codes) {
    std::vector<std::uint32_t> octants;
    const std::size_t n_octants = elements_and_codes.size() / 2;
    octants.reserve(n_octants * octant_words);
    for (std::size_t first = 0; first < n_octants; first += isovalue_block) {
        const std::size_t count = std::min<std::size_t>(isovalue_block, n_octants - first);
        std::vector<std::unique_ptr<const Buffer>> buffers;
        KernelResults results;
        dispatch(of_class, elements_and_codes.subspan(2 * first, 2 * count), buffers, results);
        results.read();
        octants.insert(octants.end(), results[0].begin(), results[0].end());
    }
    return octants;
}

/** Those with which all classes begin are waited for together. */
void IsovalueSet::make_octants() {
    struct Begun {
        std::size_t index;
        OctantsAhead ahead;
        std::vector<std::uint32_t> first;
    };
    std::vector<Begun> classes;
    std::vector<std::unique_ptr<const Buffer>> buffers;
    KernelResults results;
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        const ClassOctants& of_class = m_classes[index];
        if (of_class.chosen.empty()) {
            continue;
        }
        OctantsAhead ahead(m_device, m_volume.classes()[index].shape,
                           [&](std::span<const std::uint32_t> asked) { return evaluate(of_class, asked); });
        std::vector<std::uint32_t> elements;
        for (const std::uint32_t element : of_class.chosen) {
            elements.insert(elements.end(), {element, 0});
        }
        std::vector<std::uint32_t> first = ahead.with_parts(elements);
        if (first.size() / 2 <= isovalue_block) {
            dispatch(of_class, first, buffers, results);
        } else {
            first.clear();
        }
        classes.push_back({index, std::move(ahead), std::move(first)});
    }
    results.read();
    for (std::size_t n_read = 0; Begun & begun : classes) {
        if (!begun.first.empty()) {
            begun.ahead.keep(begun.first, results[n_read++]);
        }
        make_octants(m_classes[begun.index], m_volume.classes()[begun.index].shape, begun.ahead);
    }
}

/** Where nothing is skipped, only for what cannot be found otherwise. */
bool IsovalueSet::is_divided(const Octants& octants, std::size_t octant, std::uint32_t level) const {
    return m_choice.skips_by_range ? octants.is_rough(octant, level)
                                   : octants.is_bent(octant, level) && octants.holds_any(octant, m_choice.isovalues);
}

void IsovalueSet::make_octants(ClassOctants& of_class, elvis_shape shape, OctantsAhead& ahead) {
    // Index into what is chosen, by local element.
    std::vector<std::uint32_t> place(of_class.ranges.size());
    std::vector<std::uint32_t> wanted;
    for (std::size_t i = 0; i < of_class.chosen.size(); ++i) {
        place[of_class.chosen[i]] = static_cast<std::uint32_t>(i);
        wanted.insert(wanted.end(), {of_class.chosen[i], 0});
    }
    Octants octants{ahead(wanted)};
    Octants done;
    for (std::uint32_t level = 0;; ++level) {
        wanted.clear();
        Octants undivided;
        for (std::size_t i = 0; i < octants.size(); ++i) {
            if (is_divided(octants, i, level)) {
                add_octants(wanted, octants.word(i, octant_element), octants.word(i, octant_code), shape);
            } else {
                undivided.add(octants, i);
            }
        }
        if (wanted.empty() || wanted.size() / 2 > 2 * of_class.most) {
            break;
        }
        const Octants candidates{ahead(wanted)};
        Octants divided;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (!may_skip(of_class.ranges[candidates.word(i, octant_element)]) || candidates.holds_any(i, m_choice.isovalues)) {
                divided.add(candidates, i);
            }
        }
        if (done.size() + undivided.size() + divided.size() > of_class.most) {
            break;
        }
        done.append(undivided);
        octants = std::move(divided);
    }
    done.append(octants);
    write_octants(of_class, place, done);
}

void IsovalueSet::write_octants(ClassOctants& of_class, std::span<const std::uint32_t> place, const Octants& octants) {
    std::vector<std::uint32_t> records;
    std::vector<double> boxes;
    records.reserve(octants.size() * octant_size);
    boxes.reserve(octants.size() * 6);
    for (std::size_t i = 0; i < octants.size(); ++i) {
        const std::uint32_t element = octants.word(i, octant_element);
        const double* whole = &of_class.boxes[6 * std::size_t{place[element]}];
        std::array<double, 6> box{};
        std::copy(whole, whole + 6, box.begin());
        for (std::size_t k = 0; k < 3; ++k) {
            const double least = m_centre[k] + double{octants.number(i, octant_box + k)};
            const double most = m_centre[k] + double{octants.number(i, octant_box + 3 + k)};
            if (std::isfinite(most - least)) {
                box[k] = std::clamp(least, whole[k], whole[3 + k]);
                box[3 + k] = std::clamp(most, box[k], whole[3 + k]);
            }
        }
        boxes.insert(boxes.end(), box.begin(), box.end());
        const auto begin = octants.words.begin() + static_cast<std::ptrdiff_t>(i * octant_words);
        records.insert(records.end(), begin, begin + octant_size);
        std::uint32_t* record = &records[records.size() - octant_size];
        if (of_class.ranges[element].is_estimated && !rests_on_estimates()) {
            record[octant_code] |= octant_is_estimated;
        }
        if (!octants.is_linear(i)) {
            write_box(record, box.data());
        }
    }
    of_class.n_octants = octants.size();
    if (octants.size() == 0) {
        return;
    }
    make_room(of_class, octants.size());
    of_class.octants->write_uints(0, records);
    const Hierarchy hierarchy(boxes, m_centre);
    of_class.octant_nodes->write_uints(0, node_words(hierarchy.nodes()));
}

void IsovalueSet::write_box(std::uint32_t* record, const double* box) const {
    for (std::size_t k = 0; k < 3; ++k) {
        const double middle = 0.5 * (box[k] + box[3 + k]) - m_centre[k];
        // The middle is rounded, and so is all that is computed from it.
        const double half = 0.5 * (box[3 + k] - box[k]) + 1e-6 * (std::abs(middle) + box[3 + k] - box[k]) + 1e-30;
        for (std::size_t j = 0; j < 3; ++j) {
            record[4 * k + j] = std::bit_cast<std::uint32_t>(j == k ? static_cast<float>(1 / half) : 0.0f);
        }
        record[4 * k + 3] = std::bit_cast<std::uint32_t>(static_cast<float>(middle));
        record[octant_slope + k] = 0;
    }
}

void IsovalueSet::provide_element_nodes(std::uint32_t element_class) {
    ClassOctants& of_class = m_classes[element_class];
    if (!of_class.has_element_nodes && !of_class.chosen.empty()) {
        const Hierarchy hierarchy(of_class.boxes, m_centre);
        std::vector<std::uint32_t> words = node_words(hierarchy.nodes());
        for (std::size_t i = 0; i < hierarchy.nodes().size(); ++i) {
            std::uint32_t& child = words[node_size * i + child_word];
            child = hierarchy.nodes()[i].is_leaf() ? of_class.chosen[child] : child;
        }
        of_class.nodes->write_uints(0, words);
        of_class.has_element_nodes = true;
    }
}

std::vector<FetchBuffer> IsovalueSet::element_buffers(std::uint32_t element_class) const {
    return {{"core_nodes", m_classes[element_class].nodes.get()}, m_models.host_buffer(element_class)};
}

std::vector<FetchBuffer> IsovalueSet::octant_buffers(std::uint32_t element_class) const {
    return {{"core_nodes", m_classes[element_class].octant_nodes.get()},
            {"core_octants", m_classes[element_class].octants.get()}};
}

} // namespace elvis
