#include <core/base/infinity.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/field/sampled_range.hpp>
#include <core/vulkan/real_array.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace elvis {

namespace {

constexpr std::uint32_t sampled_group_size = 32;
/** Boxes of one dispatch: bounds its time. */
constexpr std::size_t boxes_a_dispatch = 65536;
/** shaders/field/sampled_range.comp */
constexpr std::uint32_t samples_a_direction = 7, n_range_samples = 343, samples_a_dispatch = 7;
/** Of a sample's distance from the best one over that of the extrema: nearer ones are refined, but no more than some. */
constexpr double refined_share = 0.1;
constexpr std::size_t most_refined = 256;
/** The last samples of them are 3^-9 apart. */
constexpr int refinements = 8;

struct SampledBox {
    std::uint32_t element = 0; ///< In its class.
    std::array<double, 3> middle{};
    double half = 1;
};

/** Smallest and largest sample of a box; none if `lower` is above `upper`. */
struct BoxSamples {
    double lower, upper;
    std::uint32_t lowest, highest;
};

struct SampledParameters {
    std::uint32_t n_boxes, component, n_components, first_sample, end_sample;
};

/** Samples of the selected field in boxes of one element class. */
class BoxSampler {
public:
    BoxSampler(const Device& device, const DeviceVolume& data, std::uint32_t element_class)
        : m_precision(data.precision()), m_kernel(device, request_of(data, element_class)),
          m_ranges(device, 2 * boxes_a_dispatch * sizeof(double)),
          m_samples(device, 2 * boxes_a_dispatch * sizeof(std::uint32_t)),
          m_elements(device, boxes_a_dispatch * sizeof(std::uint32_t)), m_boxes(device, 4 * boxes_a_dispatch * sizeof(double)) {
    }

    /** A component, or with several of them the magnitude. */
    std::vector<BoxSamples> sample(std::span<const SampledBox> boxes, std::uint32_t component,
                                   std::uint32_t n_components) const {
        std::vector<BoxSamples> result;
        for (std::size_t first = 0; first < boxes.size(); first += boxes_a_dispatch) {
            const std::span<const SampledBox> some = boxes.subspan(first, std::min(boxes_a_dispatch, boxes.size() - first));
            write(some);
            const auto n = static_cast<std::uint32_t>(some.size());
            const std::array<const Buffer*, 4> bindings = {&m_ranges, &m_samples, &m_elements, &m_boxes};
            for (std::uint32_t at = 0; at < n_range_samples; at += samples_a_dispatch) {
                const SampledParameters parameters{n, component, n_components, at, at + samples_a_dispatch};
                m_kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(n, sampled_group_size));
            }
            const std::vector<double> ranges = read_reals(m_ranges, m_precision, 2 * some.size());
            const auto samples = m_samples.read_items<std::uint32_t>(2 * some.size());
            for (std::size_t box = 0; box < some.size(); ++box) {
                result.push_back({ranges[2 * box], ranges[2 * box + 1], samples[2 * box], samples[2 * box + 1]});
            }
        }
        return result;
    }

private:
    static KernelRequest request_of(const DeviceVolume& data, std::uint32_t element_class) {
        KernelRequest request;
        request.name = "sampled_range of element class " + std::to_string(element_class);
        request.kernel = "field/sampled_range.comp";
        request.watches_loops = true;
        request.precision = data.precision();
        request.buffers = data.host_buffers(element_class);
        data.add_field(request, element_class);
        request.bindings = buffer_bindings({.storage = 4});
        request.push_constant_bytes = sizeof(SampledParameters);
        return request;
    }

    void write(std::span<const SampledBox> boxes) const {
        std::vector<std::uint32_t> elements;
        std::vector<double> numbers;
        for (const SampledBox& box : boxes) {
            elements.push_back(box.element);
            numbers.insert(numbers.end(), {box.middle[0], box.middle[1], box.middle[2], box.half});
        }
        m_elements.write_items(std::span<const std::uint32_t>(elements));
        write_reals(m_boxes, m_precision, numbers);
    }

    Precision m_precision;
    ComposedKernel m_kernel;
    Buffer m_ranges, m_samples, m_elements, m_boxes;
};

std::vector<SampledBox> whole_elements(const ClassInfo& info) {
    std::vector<SampledBox> boxes(info.n_elements);
    for (std::size_t element = 0; element < boxes.size(); ++element) {
        boxes[element].element = static_cast<std::uint32_t>(element);
    }
    return boxes;
}

/** A sample, as core_expand (shaders/element/expand.glsl) takes it. */
std::array<double, 3> sample_of(const SampledBox& box, std::uint32_t sample) {
    std::array<double, 3> eta{};
    for (std::size_t d = 0; d < 3; ++d) {
        const double step = sample % samples_a_direction;
        sample /= samples_a_direction;
        eta[d] = std::clamp(box.middle[d] + box.half * (step / 3 - 1), -1.0, 1.0);
    }
    return eta;
}

/** The best sample known of an element: `value` is that of the field times the sign of the search, so that more is better. */
struct Candidate {
    double value;
    std::uint32_t element_class;
    SampledBox box;
};

/** Keeps the larger samples, and looks for larger ones near them. */
class Refinement {
public:
    explicit Refinement(int sign) : m_sign(sign) {}

    void add(std::uint32_t element_class, const SampledBox& box, const BoxSamples& samples) {
        Candidate candidate{-infinity, element_class, box};
        improve(candidate, samples);
        if (candidate.value > -infinity) {
            m_candidates.push_back(candidate);
        }
    }

    /** The best value; of its negative in a search for the smallest. */
    double best() const { return m_candidates.empty() ? -infinity : m_candidates[best_index()].value; }

    /** Leaves those that may still become the best. */
    void choose(double distance) {
        const double least = best() - refined_share * distance;
        std::erase_if(m_candidates, [&](const Candidate& candidate) { return candidate.value < least; });
        const std::size_t n = std::min(most_refined, m_candidates.size());
        std::ranges::partial_sort(m_candidates, m_candidates.begin() + static_cast<std::ptrdiff_t>(n), std::greater{},
                                  &Candidate::value);
        m_candidates.resize(n);
    }

    /** Samples anew around the best sample of each candidate of that class, three times as close. */
    void refine(std::uint32_t element_class, const BoxSampler& sampler, std::uint32_t component, std::uint32_t n_components) {
        std::vector<SampledBox> boxes;
        for (Candidate& candidate : m_candidates) {
            if (candidate.element_class == element_class) {
                candidate.box.half /= 3;
                boxes.push_back(candidate.box);
            }
        }
        const std::vector<BoxSamples> samples = sampler.sample(boxes, component, n_components);
        std::size_t at = 0;
        for (Candidate& candidate : m_candidates) {
            if (candidate.element_class == element_class) {
                improve(candidate, samples[at++]);
            }
        }
    }

    FieldExtremum result(const RuntimeVolume& volume) const {
        if (m_candidates.empty()) {
            return {m_sign * -infinity, m_sign * -infinity, 0, {}};
        }
        const Candidate& candidate = m_candidates[best_index()];
        const ClassInfo& info = volume.classes()[candidate.element_class];
        const double value = m_sign * candidate.value;
        return {value, value, info.first_element + candidate.box.element,
                native::expand(static_cast<native::Shape>(info.shape), candidate.box.middle)};
    }

private:
    std::size_t best_index() const {
        return static_cast<std::size_t>(std::ranges::max_element(m_candidates, {}, &Candidate::value) - m_candidates.begin());
    }

    /** The box's middle is where its best sample is. */
    void improve(Candidate& candidate, const BoxSamples& samples) const {
        const double value = m_sign > 0 ? samples.upper : -samples.lower;
        if (samples.lower <= samples.upper && value > candidate.value) {
            candidate.value = value;
            candidate.box.middle = sample_of(candidate.box, m_sign > 0 ? samples.highest : samples.lowest);
        }
    }

    int m_sign;
    std::vector<Candidate> m_candidates;
};

} // namespace

std::vector<FieldRange> ranges_from_samples(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                            std::uint32_t n_components) {
    std::vector<FieldRange> total(n_components, {infinity, -infinity});
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        const BoxSampler sampler(device, data, index);
        const std::vector<SampledBox> boxes = whole_elements(volume.classes()[index]);
        for (std::uint32_t component = 0; component < n_components; ++component) {
            for (const BoxSamples& samples : sampler.sample(boxes, component, 1)) {
                if (samples.lower <= samples.upper) {
                    total[component].lower = std::min(total[component].lower, samples.lower);
                    total[component].upper = std::max(total[component].upper, samples.upper);
                }
            }
        }
    }
    return total;
}

FieldExtrema extrema_from_samples(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, int component,
                                  std::uint32_t n_components) {
    const std::uint32_t first = component < 0 ? 0 : static_cast<std::uint32_t>(component);
    const std::uint32_t n = component < 0 ? n_components : 1;
    Refinement largest(1), smallest(-1);
    std::vector<std::unique_ptr<BoxSampler>> samplers(volume.classes().size());
    for (std::uint32_t index = 0; index < samplers.size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        samplers[index] = std::make_unique<BoxSampler>(device, data, index);
        const std::vector<SampledBox> boxes = whole_elements(volume.classes()[index]);
        const std::vector<BoxSamples> samples = samplers[index]->sample(boxes, first, n);
        for (std::size_t box = 0; box < boxes.size(); ++box) {
            largest.add(index, boxes[box], samples[box]);
            smallest.add(index, boxes[box], samples[box]);
        }
    }
    const double distance = largest.best() + smallest.best();
    for (Refinement* const search : {&largest, &smallest}) {
        search->choose(distance);
        for (int round = 0; round < refinements; ++round) {
            for (std::uint32_t index = 0; index < samplers.size(); ++index) {
                if (samplers[index]) {
                    search->refine(index, *samplers[index], first, n);
                }
            }
        }
    }
    return {smallest.result(volume), largest.result(volume), ELVIS_ESTIMATED};
}

} // namespace elvis
