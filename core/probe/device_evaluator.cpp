#include <core/base/error.hpp>
#include <core/expression/glsl.hpp>
#include <core/plugin_host/all_bounds.hpp>
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

const Vector3& coordinates_of(const InversionQuery& query) { return query.position; }
const Vector3& coordinates_of(const ReferencePoint& point) { return point.xi; }

// Items by their class, block by block: run(class, input, output, number of items), whose kernel gives each item so many
// answers, then take(class, index of an item, its answers).
template <class Answer, class Item, class Run, class Take>
void answer_all(const Device& device, const std::vector<ClassInfo>& classes, std::span<const Item> items, std::size_t n_answers,
                const Run& run, const Take& take) {
    std::vector<std::vector<std::size_t>> indices(classes.size());
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t c = 0; c < classes.size(); ++c)
            if (items[i].element - classes[c].first_element < classes[c].n_elements)
                indices[c].push_back(i);
    for (std::uint32_t c = 0; c < classes.size(); ++c)
        for (std::size_t first = 0; first < indices[c].size(); first += block_size) {
            const std::size_t count = std::min(block_size, indices[c].size() - first);
            std::vector<DevicePoint> points(count);
            for (std::size_t i = 0; i < count; ++i) {
                const Item& item = items[indices[c][first + i]];
                const auto [x, y, z] = coordinates_of(item);
                points[i] = {{x, y, z}, static_cast<std::uint32_t>(item.element - classes[c].first_element), 0};
            }
            const Buffer input(device, count * sizeof(DevicePoint));
            const Buffer output(device, count * n_answers * sizeof(Answer));
            input.write_items(std::span<const DevicePoint>(points));
            run(c, input, output, count);
            const auto answers = output.read_items<Answer>(count * n_answers);
            for (std::size_t i = 0; i < count; ++i)
                take(c, indices[c][first + i], std::span(answers).subspan(i * n_answers, n_answers));
        }
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
    const std::vector<double> boxes = all_bounds(volume);
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
    const auto run_class = [this](std::uint32_t c, const Buffer& input, const Buffer& output, std::size_t count) {
        run("probe/probe_invert.comp", c, std::as_bytes(std::span(&m_position_error, 1)), input, output, count);
    };
    const auto take = [&](std::uint32_t c, std::size_t index, std::span<const DeviceAnswer> answers) {
        const DeviceAnswer& answer = answers.front();
        Inversion& inversion = inversions[index];
        inversion.xi = {answer.xi[0], answer.xi[1], answer.xi[2]};
        if (answer.status == status_converged) {
            const double excess = reference_excess(m_volume->classes()[c].shape, inversion.xi);
            inversion.outcome =
                excess <= inside_tolerance + answer.error ? Inversion::Outcome::inside : Inversion::Outcome::outside;
        } else if (answer.status == status_outside) {
            inversion.outcome = Inversion::Outcome::outside;
        }
    };
    answer_all<DeviceAnswer>(m_device, m_volume->classes(), queries, 1, run_class, take);
    return inversions;
}

std::vector<FieldSample> DeviceEvaluator::evaluate(std::uint32_t field, std::uint32_t time_step,
                                                   std::span<const ReferencePoint> points, bool /*with_gradients*/) {
    const std::size_t n_components = m_volume->fields()[field].n_components;
    std::vector<FieldSample> samples(points.size());
    // Double precision has digits enough for any offset.
    m_on_device.select(field, time_step, std::vector<double>(n_components, 0.0));
    const auto run_class = [this](std::uint32_t c, const Buffer& input, const Buffer& output, std::size_t count) {
        run("probe/probe_evaluate.comp", c, {}, input, output, count);
    };
    std::vector<bool> is_estimated;
    for (std::uint32_t c = 0; c < m_volume->classes().size(); ++c)
        is_estimated.push_back((m_volume->snippet(c).capabilities & ELVIS_SNIPPET_FIELD_GRADIENT) == 0);
    const auto take = [&](std::uint32_t c, std::size_t index, std::span<const double> numbers) {
        FieldSample& sample = samples[index];
        sample.gradient_is_estimated = is_estimated[c];
        for (; !numbers.empty(); numbers = numbers.subspan(4)) {
            sample.values.push_back(numbers[0]);
            sample.gradients.insert(sample.gradients.end(), &numbers[1], &numbers[1] + 3);
        }
    };
    answer_all<double>(m_device, m_volume->classes(), points, 4 * n_components, run_class, take);
    return samples;
}

std::vector<ExpressionSample> DeviceEvaluator::evaluate(const std::shared_ptr<const Expression>& expression,
                                                        std::uint32_t time_step, std::span<const ReferencePoint> points,
                                                        bool /*with_gradients*/) {
    std::vector<ExpressionSample> samples(points.size());
    const FieldSelection selection = selection_of(expression, *m_volume, time_step);
    m_on_device.keep(std::span(&selection, 1));
    m_on_device.select(selection);
    m_expression = expression.get();
    const auto run_class = [this](std::uint32_t c, const Buffer& input, const Buffer& output, std::size_t count) {
        run("probe/probe_expression.comp", c, {}, input, output, count);
    };
    std::vector<std::array<bool, 2>> is_estimated;
    for (std::uint32_t c = 0; c < m_volume->classes().size(); ++c) {
        const ExpressionClass about = expression_class(*m_volume, c);
        is_estimated.push_back({value_is_estimated(*expression, about), gradient_is_estimated(*expression, about)});
    }
    const auto take = [&](std::uint32_t c, std::size_t index, std::span<const double> numbers) {
        samples[index] = {numbers[0], {numbers[1], numbers[2], numbers[3]}, is_estimated[c][0], is_estimated[c][1]};
    };
    answer_all<double>(m_device, m_volume->classes(), points, 4, run_class, take);
    m_expression = nullptr;
    return samples;
}

} // namespace elvis
