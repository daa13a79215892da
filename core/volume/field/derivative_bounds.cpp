#include <core/volume/field/derivative_bounds.hpp>
#include <core/volume/field/weighted_derivatives.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace elvis {

namespace {

constexpr std::uint32_t derivative_group_size = 32;
/** Elements at once: bounds memory, and the time of a dispatch. */
constexpr std::uint64_t derivative_block = 16384;

/** Samples miss the largest values; second derivatives, which vary most, by more. */
constexpr double bend_safety = 2;
constexpr double safety = 1.25;

/** Stands for everything that is not finite. */
constexpr double beyond_floats = 3e38;

constexpr double derivative_unknown = std::numeric_limits<double>::quiet_NaN();

/** shaders/field/derivative_bounds.comp, which stops where a shape has fewer. */
constexpr std::uint32_t most_derivative_points = 64, derivative_points_a_dispatch = 4;

struct DerivativeParameters {
    std::uint32_t first, n_elements, component;
    std::uint32_t first_point, end_point;
};

/** A row of the record. */
struct Row {
    double second = derivative_unknown, first = derivative_unknown, value = derivative_unknown, certainty = 0;

    bool is_complete() const { return std::isfinite(second) && std::isfinite(first) && std::isfinite(value); }
};
static_assert(sizeof(Row) == 4 * sizeof(double));

/** What the plugin tells of a block of elements; the rest stays unknown. */
class FromPlugin {
public:
    FromPlugin(const RuntimeVolume& volume, std::uint32_t element_class, const BoundedField& field)
        : m_volume(volume), m_class(element_class), m_field(field) {}

    void read(std::uint64_t first, std::uint64_t count, std::vector<Row>& rows) {
        const std::size_t n_components = m_field.offset.size();
        m_bounds.resize(rows.size());
        const elvis_certainty of_derivatives =
            read_weighted_derivatives(m_volume, m_class, m_field.field, m_field.time_step, first, count, m_bounds);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].second = m_bounds[i].second;
            rows[i].first = m_bounds[i].first;
            rows[i].certainty = of_derivatives == ELVIS_CERTIFIED ? 0 : 1;
        }
        if (m_volume.has_field_ranges()) {
            m_ranges.resize(rows.size());
            const auto certainty = m_volume.field_ranges(m_field.field, m_field.time_step, first, count, m_ranges);
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const double offset = m_field.offset[i % n_components];
                // The subtraction rounds: by 2^-53 of its result, twice at most.
                const double widening = certainty == ELVIS_CERTIFIED ? 1 + 1e-15 : safety;
                rows[i].value = std::max(std::abs(m_ranges[i].lower - offset), std::abs(m_ranges[i].upper - offset)) * widening;
                rows[i].certainty = certainty == ELVIS_CERTIFIED ? rows[i].certainty : 1;
            }
        }
    }

private:
    const RuntimeVolume& m_volume;
    std::uint32_t m_class;
    const BoundedField& m_field;
    std::vector<DerivativeBounds> m_bounds;
    std::vector<FieldRange> m_ranges;
};

/** The kernel that samples, made when it is first needed. */
class Sampler {
public:
    Sampler(const Device& device, const SnippetInstance& instance, Precision precision, const std::string& name)
        : m_kernel(device, request_for(instance, precision, name)), m_output(device, 3 * derivative_block * sizeof(double)),
          m_precision(precision) {}

    /** Fills what the rows of one component lack. */
    void complete(std::uint64_t first, std::uint64_t count, std::uint32_t component, std::uint32_t n_components,
                  std::vector<Row>& rows) const {
        const std::array<const Buffer*, 1> bindings = {&m_output};
        for (std::uint32_t point = 0; point < most_derivative_points; point += derivative_points_a_dispatch) {
            const DerivativeParameters parameters{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                                                  component, point, point + derivative_points_a_dispatch};
            m_kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                              (parameters.n_elements + derivative_group_size - 1) / derivative_group_size);
        }
        const std::vector<double> numbers = read_reals(m_output, m_precision, 3 * count);
        for (std::uint64_t element = 0; element < count; ++element) {
            Row& row = rows[element * n_components + component];
            if (row.is_complete()) {
                continue;
            }
            const auto replace = [](double& bound, double sampled) { bound = std::isfinite(bound) ? bound : sampled; };
            replace(row.second, bend_safety * numbers[3 * element]);
            replace(row.first, safety * numbers[3 * element + 1]);
            replace(row.value, safety * numbers[3 * element + 2]);
            row.certainty = 1;
        }
    }

private:
    static KernelRequest request_for(const SnippetInstance& instance, Precision precision, const std::string& name) {
        KernelRequest request;
        request.name = name;
        request.kernel = "field/derivative_bounds.comp";
        request.watches_loops = true;
        request.precision = precision;
        request.instances = {instance};
        request.bindings = {{0, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(DerivativeParameters);
        return request;
    }

    ComposedKernel m_kernel;
    Buffer m_output;
    Precision m_precision;
};

/** A number that is no smaller after rounding to single precision, and finite there. */
double widened(double bound) {
    return bound < beyond_floats ? bound * (1 + 1.2e-7) + std::numeric_limits<float>::min() : beyond_floats;
}

} // namespace

std::unique_ptr<RecordBuffer> make_derivative_bounds(const Device& device, const RuntimeVolume& volume,
                                                     std::uint32_t element_class, const BoundedField& field,
                                                     const SnippetInstance& instance, Precision precision,
                                                     const TaskControl* control) {
    const ClassInfo& info = volume.classes()[element_class];
    const auto n_components = static_cast<std::uint32_t>(field.offset.size());
    auto records = std::make_unique<RecordBuffer>(device, RecordKind::real, precision, info.n_elements, 4 * n_components);
    FromPlugin plugin(volume, element_class, field);
    std::optional<Sampler> sampler;
    std::vector<Row> rows;
    std::vector<double> numbers;
    for (std::uint64_t first = 0; first < info.n_elements; first += derivative_block) {
        if (control) {
            control->check();
        }
        const std::uint64_t count = std::min(derivative_block, info.n_elements - first);
        rows.assign(count * n_components, Row{});
        plugin.read(info.first_element + first, count, rows);
        for (std::uint32_t component = 0; component < n_components; ++component) {
            bool is_complete = true;
            for (std::size_t row = component; row < rows.size(); row += n_components) {
                is_complete = is_complete && rows[row].is_complete();
            }
            if (!is_complete) {
                if (!sampler) {
                    sampler.emplace(device, instance, precision,
                                    "derivative_bounds of element class " + std::to_string(element_class));
                }
                sampler->complete(first, count, component, n_components, rows);
            }
        }
        numbers.clear();
        for (const Row& row : rows) {
            numbers.insert(numbers.end(), {widened(row.second), widened(row.first), widened(row.value), row.certainty});
        }
        records->write_reals(first, numbers);
    }
    return records;
}

} // namespace elvis
