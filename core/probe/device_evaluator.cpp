#include <core/base/error.hpp>
#include <core/expression/glsl.hpp>
#include <core/probe/device_evaluator.hpp>
#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {
namespace {

// Points handed to the device at once: bounds memory and the time of one dispatch.
constexpr std::size_t block_size = 1u << 16;
// local_size_x of the kernels.
constexpr std::size_t group_size = 32;

// As in shaders/probe/probe_invert.comp and probe_evaluate.comp.
struct DevicePoint {
    double coordinates[3];
    std::uint32_t element;
    std::uint32_t unused;
};
struct DeviceAnswer {
    double xi[3];
    double error;
    std::uint32_t status;
    std::uint32_t unused;
};
// As in shaders/element/newton.glsl.
constexpr std::uint32_t status_converged = 1;
constexpr std::uint32_t status_outside = 2;

// Calls action(class index, indices of the items in that class) for every class that has some.
template <class Item, class Action>
void for_each_class(const std::vector<ClassInfo>& classes, std::span<const Item> items, const Action& action) {
    std::vector<std::vector<std::size_t>> indices(classes.size());
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t c = 0; c < classes.size(); ++c)
            if (items[i].element - classes[c].first_element < classes[c].n_elements)
                indices[c].push_back(i);
    for (std::uint32_t c = 0; c < classes.size(); ++c)
        if (!indices[c].empty())
            action(c, indices[c]);
}

const RuntimeVolume& require_fields(const RuntimeVolume& volume) {
    if (volume.fields().empty())
        throw Error(volume.path(), "a volume without fields cannot be probed on the device");
    return volume;
}

const Device& require_float64(const Device& device) {
    if (!device.summary().has_float64)
        throw Error(device.summary().name, "the device has no double precision, which probing needs");
    return device;
}

} // namespace

DeviceEvaluator::DeviceEvaluator(const RuntimeVolume& volume, const std::string& device)
    : m_device(device), m_volume(&require_fields(volume)),
      m_on_device(require_float64(m_device), volume, Precision::float64, nullptr) {
    std::vector<double> boxes(6 * volume.n_elements());
    volume.bounds(0, volume.n_elements(), boxes);
    for (const double coordinate : boxes)
        m_position_error = std::max(m_position_error, std::numeric_limits<double>::epsilon() * std::abs(coordinate));
}

void DeviceEvaluator::run(const std::string& kernel, std::uint32_t element_class, std::span<const std::byte> parameters,
                          const Buffer& input, const Buffer& output, std::size_t n_items) const {
    const auto count = static_cast<std::uint32_t>(n_items);
    std::vector<std::byte> constants(parameters.begin(), parameters.end());
    const auto tail = std::as_bytes(std::span(&count, 1));
    constants.insert(constants.end(), tail.begin(), tail.end());

    KernelRequest request;
    request.name = "probe class " + std::to_string(element_class);
    request.kernel = kernel;
    request.precision = Precision::float64;
    m_on_device.add_field(request, element_class);
    if (m_expression != nullptr) {
        request.text += gradient_glsl(*m_expression, expression_class(*m_volume, element_class));
        request.with_second_derivatives = true;
    }
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = static_cast<std::uint32_t>(constants.size());
    const std::array<const Buffer*, 2> bindings{&input, &output};
    const auto n_groups = static_cast<std::uint32_t>((n_items + group_size - 1) / group_size);
    ComposedKernel(m_device, request).dispatch(bindings, constants, n_groups);
}

std::vector<Inversion> DeviceEvaluator::invert(std::span<const InversionQuery> queries) {
    std::vector<Inversion> inversions(queries.size());
    // Only the mapping is needed; a snippet always comes with a field.
    m_on_device.select(0, 0, std::vector<double>(m_volume->fields()[0].n_components, 0.0));
    for_each_class(m_volume->classes(), queries, [&](std::uint32_t c, const std::vector<std::size_t>& indices) {
        const ClassInfo& info = m_volume->classes()[c];
        for (std::size_t first = 0; first < indices.size(); first += block_size) {
            const std::size_t count = std::min(block_size, indices.size() - first);
            std::vector<DevicePoint> points(count);
            for (std::size_t i = 0; i < count; ++i) {
                const InversionQuery& query = queries[indices[first + i]];
                points[i] = {{query.position[0], query.position[1], query.position[2]},
                             static_cast<std::uint32_t>(query.element - info.first_element),
                             0};
            }
            const Buffer input(m_device, count * sizeof(DevicePoint));
            const Buffer output(m_device, count * sizeof(DeviceAnswer));
            input.write_items(std::span<const DevicePoint>(points));
            run("probe/probe_invert.comp", c, std::as_bytes(std::span(&m_position_error, 1)), input, output, count);
            const auto answers = output.read_items<DeviceAnswer>(count);
            for (std::size_t i = 0; i < count; ++i) {
                const DeviceAnswer& answer = answers[i];
                Inversion& inversion = inversions[indices[first + i]];
                inversion.xi = {answer.xi[0], answer.xi[1], answer.xi[2]};
                if (answer.status == status_converged) {
                    const bool is_inside = reference_excess(info.shape, inversion.xi) <= inside_tolerance + answer.error;
                    inversion.outcome = is_inside ? Inversion::Outcome::inside : Inversion::Outcome::outside;
                } else if (answer.status == status_outside) {
                    inversion.outcome = Inversion::Outcome::outside;
                }
            }
        }
    });
    return inversions;
}

std::vector<FieldSample> DeviceEvaluator::evaluate(std::uint32_t field, std::uint32_t time_step,
                                                   std::span<const ReferencePoint> points) {
    const std::size_t n_components = m_volume->fields()[field].n_components;
    std::vector<FieldSample> samples(points.size());
    // Double precision has digits enough for any offset.
    m_on_device.select(field, time_step, std::vector<double>(n_components, 0.0));
    for_each_class(m_volume->classes(), points, [&](std::uint32_t c, const std::vector<std::size_t>& indices) {
        const ClassInfo& info = m_volume->classes()[c];
        const bool is_estimated = (m_volume->snippet(c).capabilities & ELVIS_SNIPPET_FIELD_GRADIENT) == 0;
        for (std::size_t first = 0; first < indices.size(); first += block_size) {
            const std::size_t count = std::min(block_size, indices.size() - first);
            std::vector<DevicePoint> inputs(count);
            for (std::size_t i = 0; i < count; ++i) {
                const ReferencePoint& point = points[indices[first + i]];
                inputs[i] = {
                    {point.xi[0], point.xi[1], point.xi[2]}, static_cast<std::uint32_t>(point.element - info.first_element), 0};
            }
            const std::size_t n_numbers = 4 * n_components * count;
            const Buffer input(m_device, count * sizeof(DevicePoint));
            const Buffer output(m_device, n_numbers * sizeof(double));
            input.write_items(std::span<const DevicePoint>(inputs));
            run("probe/probe_evaluate.comp", c, {}, input, output, count);
            const auto numbers = output.read_items<double>(n_numbers);
            for (std::size_t i = 0; i < count; ++i) {
                FieldSample& sample = samples[indices[first + i]];
                sample.gradient_is_estimated = is_estimated;
                for (std::size_t component = 0; component < n_components; ++component) {
                    const double* at = &numbers[4 * (i * n_components + component)];
                    sample.values.push_back(at[0]);
                    sample.gradients.insert(sample.gradients.end(), at + 1, at + 4);
                }
            }
        }
    });
    return samples;
}

std::vector<ExpressionSample> DeviceEvaluator::evaluate(const std::shared_ptr<const Expression>& expression,
                                                        std::uint32_t time_step, std::span<const ReferencePoint> points) {
    std::vector<ExpressionSample> samples(points.size());
    const FieldSelection selection = selection_of(expression, *m_volume, time_step);
    m_on_device.keep(std::span(&selection, 1));
    m_on_device.select(selection);
    m_expression = expression.get();
    for_each_class(m_volume->classes(), points, [&](std::uint32_t c, const std::vector<std::size_t>& indices) {
        const ClassInfo& info = m_volume->classes()[c];
        const ExpressionClass about = expression_class(*m_volume, c);
        for (std::size_t first = 0; first < indices.size(); first += block_size) {
            const std::size_t count = std::min(block_size, indices.size() - first);
            std::vector<DevicePoint> inputs(count);
            for (std::size_t i = 0; i < count; ++i) {
                const ReferencePoint& point = points[indices[first + i]];
                inputs[i] = {
                    {point.xi[0], point.xi[1], point.xi[2]}, static_cast<std::uint32_t>(point.element - info.first_element), 0};
            }
            const Buffer input(m_device, count * sizeof(DevicePoint));
            const Buffer output(m_device, 4 * count * sizeof(double));
            input.write_items(std::span<const DevicePoint>(inputs));
            run("probe/probe_expression.comp", c, {}, input, output, count);
            const auto numbers = output.read_items<double>(4 * count);
            for (std::size_t i = 0; i < count; ++i) {
                const double* at = &numbers[4 * i];
                samples[indices[first + i]] = {at[0],
                                               {at[1], at[2], at[3]},
                                               value_is_estimated(*expression, about),
                                               gradient_is_estimated(*expression, about)};
            }
        }
    });
    m_expression = nullptr;
    return samples;
}

} // namespace elvis
