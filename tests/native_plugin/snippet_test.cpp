/*
 * The snippets on the device against the CPU evaluation of the native spaces.
 */
#include "volume_fixture.hpp"

#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>
#include <tests/support/device.hpp>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <iostream>

using namespace elvis;
using test::ClassPlan;
using test::TestVolume;

namespace {

/** As in shaders/conformance/snippet_check.comp. */
struct CheckPoint {
    double xi[3];
    std::uint32_t element;
    std::uint32_t component;
};
constexpr std::size_t numbers_per_point = 20;

/** A class of a volume with one field, on the device. */
class ClassOnDevice {
public:
    ClassOnDevice(const RuntimeVolume& volume, std::uint32_t element_class, std::uint32_t field, Precision precision,
                  std::span<const double> origins, std::span<const double> offset,
                  const std::string& kernel = "conformance/snippet_check.comp", std::size_t n_numbers = numbers_per_point,
                  std::uint32_t without = 0)
        : m_n_numbers(n_numbers) {
        m_request.name = "snippet check";
        m_request.kernel = kernel;
        m_request.with_second_derivatives = true;
        m_request.precision = precision;
        m_request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
        m_request.push_constant_bytes = 4;
        SnippetInstance instance;
        instance.snippet = volume.snippet(element_class);
        if (without != 0) {
            leave_out(instance.snippet, without);
        }
        instance.shape = volume.classes()[element_class].shape;
        instance.n_components = volume.fields()[field].n_components;
        instance.constants = volume.class_field(element_class, field).constants;
        for (std::uint32_t i = 0; i < volume.n_buffers(); ++i) {
            const BufferInfo info = volume.buffer(i, field);
            if (info.element_class != element_class)
                continue;
            std::vector<double> numbers(info.n_records * info.record_size);
            const elvis_fill_request request{
                sizeof(elvis_fill_request), i, field, 0, 0, info.n_records, offset.data(), origins.data()};
            volume.fill_buffer(request, numbers.data());
            m_buffers.push_back(std::make_unique<RecordBuffer>(test::validated_device(), RecordKind::real, precision,
                                                               info.n_records, info.record_size));
            m_buffers.back()->write_reals(0, numbers);
            instance.buffers.push_back({info.name, m_buffers.back().get()});
        }
        m_request.instances = {instance};
        m_kernel.emplace(test::validated_device(), m_request);
    }

    std::vector<double> evaluate(const std::vector<CheckPoint>& points) const {
        const Buffer input(test::validated_device(), points.size() * sizeof(CheckPoint));
        const Buffer output(test::validated_device(), points.size() * m_n_numbers * sizeof(double));
        input.write_items(std::span<const CheckPoint>(points));
        const auto n = static_cast<std::uint32_t>(points.size());
        const std::array<const Buffer*, 2> bindings{&input, &output};
        m_kernel->dispatch(bindings, std::as_bytes(std::span(&n, 1)), (n + 7) / 8);
        return output.read_items<double>(points.size() * m_n_numbers);
    }

private:
    /** The snippet without functions of these capabilities: they are renamed. */
    static void leave_out(Snippet& snippet, std::uint32_t capabilities) {
        snippet.capabilities &= ~capabilities;
        for (SnippetText& source : snippet.sources) {
            for (const char* name : {"elvis_field_hessian", "elvis_mapping_hessian"}) {
                const std::string old = name;
                for (std::size_t at = source.text.find(old); at != std::string::npos; at = source.text.find(old, at)) {
                    source.text.replace(at, old.size(), "native_" + old.substr(6) + "_unused");
                }
            }
        }
    }

    std::size_t m_n_numbers;
    KernelRequest m_request;
    std::vector<std::unique_ptr<RecordBuffer>> m_buffers;
    std::optional<ComposedKernel> m_kernel;
};

/** Points inside, on faces, edges and corners; collapsed vertices among them. */
std::vector<CheckPoint> check_points(native::Shape shape, std::uint32_t n_elements, std::uint32_t n_components,
                                     Precision precision) {
    test::Random random(9);
    std::vector<CheckPoint> points;
    for (int i = 0; i < 64; ++i) {
        native::Point eta;
        for (std::size_t d = 0; d < 3; ++d)
            eta[d] = (i >> d) % 8 == 0 ? (i % 3 == 0 ? -1 : 1) : random.between(-1, 1);
        native::Point xi = native::expand(shape, eta);
        for (double& coordinate : xi)
            if (precision == Precision::float32)
                coordinate = static_cast<double>(static_cast<float>(coordinate));
        points.push_back(
            {{xi[0], xi[1], xi[2]}, static_cast<std::uint32_t>(i) % n_elements, static_cast<std::uint32_t>(i) % n_components});
    }
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        const native::Point xi = native::corner(shape, corner);
        points.push_back({{xi[0], xi[1], xi[2]}, 0, 0});
    }
    return points;
}

/** Errors relative to the largest magnitude of what is compared, over all points. */
class Comparison {
public:
    void add(double actual, double expected) {
        m_error = std::isfinite(actual) ? std::max(m_error, std::abs(actual - expected)) : INFINITY;
        m_scale = std::max(m_scale, std::abs(expected));
    }
    double error() const { return m_error == 0 ? 0 : m_error / m_scale; }

private:
    double m_error = 0;
    double m_scale = 0;
};

struct Errors {
    double value, gradient, position, jacobian;
    double largest() const { return std::max({value, gradient, position, jacobian}); }
};

/** Compares all that the snippet of a class gives with the volume's CPU evaluation, at points with xi3 <= top. */
Errors check_class(const TestVolume& file, std::uint32_t element_class, std::uint32_t field, Precision precision, double centre,
                   double top = 1) {
    const RuntimeVolume volume = file.open();
    const std::uint32_t n_components = volume.fields()[field].n_components;
    const std::vector<double> origins(3 * volume.n_elements(), centre);
    const std::vector<double> offset{0.5, -0.25, 0.125};
    const ClassOnDevice on_device(volume, element_class, field, precision, origins, std::span(offset).first(n_components));
    std::vector<CheckPoint> points =
        check_points(file.description().classes[element_class].geometry.shape,
                     static_cast<std::uint32_t>(volume.classes()[element_class].n_elements), n_components, precision);
    std::erase_if(points, [top](const CheckPoint& point) { return point.xi[2] > top; });
    const std::vector<double> results = on_device.evaluate(points);
    // In two dimensions the third direction is of no meaning.
    const std::size_t n_axes = volume.dimension();
    Comparison value, gradient, position, jacobian;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double* result = results.data() + i * numbers_per_point;
        const std::uint64_t element = volume.classes()[element_class].first_element + points[i].element;
        const std::size_t component = points[i].component;
        std::array<double, 3> x{};
        std::array<double, 9> j{};
        std::vector<double> values(n_components), gradients(3 * n_components);
        volume.evaluate_mapping(element, points[i].xi, x, j);
        volume.evaluate_field(field, 0, element, points[i].xi, values, gradients);
        value.add(result[0], values[component] - offset[component]);
        value.add(result[1], values[component] - offset[component]);
        for (std::size_t d = 0; d < 3; ++d) {
            if (d < n_axes)
                gradient.add(result[2 + d], gradients[3 * component + d]);
            position.add(result[5 + d], x[d] - centre);
            position.add(result[8 + d], x[d] - centre);
            for (std::size_t k = 0; k < n_axes; ++k)
                jacobian.add(result[11 + 3 * k + d], j[3 * d + k]);
        }
    }
    return {value.error(), gradient.error(), position.error(), jacobian.error()};
}

/** One class for each text of GLSL that the snippet turns into. */
std::vector<native::Space> snippet_spaces(std::uint32_t order) {
    std::vector<native::Space> spaces;
    for (const native::Space& space : test::spaces_of_order(order)) {
        using native::Basis;
        if (space.shape == native::Shape::pyramid || space.basis == Basis::modified)
            spaces.push_back(space);
    }
    return spaces;
}

std::string describe(const Errors& errors) {
    char text[200];
    std::snprintf(text, sizeof text, "value %.1e, gradient %.1e, position %.1e, Jacobian %.1e", errors.value, errors.gradient,
                  errors.position, errors.jacobian);
    return text;
}

native::Field field_of(std::uint32_t n_components, native::Transform transform) {
    return {"f", "", n_components, native::Continuity::unknown, transform, std::nan("")};
}

/** One class of each of the spaces, with geometry of the others, about the point (centre, centre, centre). */
TestVolume volume_of(const std::vector<native::Space>& spaces, const std::vector<native::Space>& geometry,
                     std::uint32_t n_components, double centre) {
    std::vector<ClassPlan> classes;
    for (std::size_t i = 0; i < spaces.size(); ++i)
        classes.push_back({geometry[i], {spaces[i]}});
    return TestVolume(classes, {field_of(n_components, native::Transform::none)}, {0.0}, centre);
}

/** In float64, the first spaces of an order, with geometry of every order from 1 to 4. Each order has kernels of its own. */
void check_order(std::uint32_t order, std::size_t n_spaces = SIZE_MAX) {
    std::vector<native::Space> spaces = snippet_spaces(order);
    spaces.resize(std::min(n_spaces, spaces.size()));
    const TestVolume file = volume_of(spaces, snippet_spaces(1 + order % 4), 2, 1);
    for (std::uint32_t i = 0; i < spaces.size(); ++i) {
        const Errors errors = check_class(file, i, 0, Precision::float64, 1);
        std::cout << "float64 " << test::describe(spaces[i]) << ": " << describe(errors) << "\n";
        CHECK(errors.value < 1e-13);
        CHECK(errors.gradient < 1e-12);
        CHECK(errors.position < 1e-13);
        // In tensor pyramids the CPU's terms of size 1/t cancel: a few 1e-16 / t.
        CHECK(errors.jacobian < 1e-12);
    }
}

} // namespace

TEST_CASE("snippets agree with the CPU in float64, orders 0 to 14") {
    for (const std::uint32_t order : {0u, 3u, 7u})
        check_order(order);
    check_order(14, 1);
}

TEST_CASE("snippets agree with the CPU in float64, every order", "[.long]") {
    for (std::uint32_t order = 0; order <= 14; ++order)
        check_order(order);
}

TEST_CASE("snippets agree with the CPU in float32") {
    for (const std::uint32_t order : {2u, 6u}) {
        const std::vector<native::Space> spaces = snippet_spaces(order);
        const TestVolume file = volume_of(spaces, snippet_spaces(order / 2), 1, 1000);
        for (std::uint32_t i = 0; i < spaces.size(); ++i) {
            const Errors errors = check_class(file, i, 0, Precision::float32, 1000);
            std::cout << "float32 " << test::describe(spaces[i]) << ": " << describe(errors) << "\n";
            CHECK(errors.largest() < 2e-6);
        }
    }
}

TEST_CASE("snippets agree with the CPU where orders differ between directions") {
    for (const native::Space& space : test::spaces_of_mixed_order()) {
        const TestVolume file({{space, {space}}}, {field_of(1, native::Transform::none)});
        const Errors errors = check_class(file, 0, 0, Precision::float64, 0);
        INFO(test::describe(space) << ": " << describe(errors));
        CHECK(errors.largest() < 1e-12);
    }
}

TEST_CASE("snippets give vector fields with a transform and their gradients") {
    const native::Transform transform = GENERATE(native::Transform::covariant, native::Transform::contravariant);
    const std::vector<native::Space> spaces = snippet_spaces(3);
    std::vector<ClassPlan> classes;
    for (const native::Space& space : spaces)
        classes.push_back({space, {space}});
    const TestVolume file(classes, {field_of(3, transform)});
    for (std::uint32_t i = 0; i < spaces.size(); ++i) {
        // At the apex of a curved pyramid the Jacobian depends on the direction, and so does the vector.
        const double top = spaces[i].shape == native::Shape::pyramid ? 0.9 : 1;
        const Errors errors = check_class(file, i, 0, Precision::float64, 0, top);
        INFO(test::describe(spaces[i]) << ": " << describe(errors));
        CHECK(errors.largest() < 1e-11);
    }
}

TEST_CASE("snippets give vector fields of the plane with a transform and their gradients") {
    const native::Transform transform = GENERATE(native::Transform::covariant, native::Transform::contravariant);
    const native::Shape shape = GENERATE(native::Shape::quadrilateral, native::Shape::triangle);
    const native::Space space{shape, native::Basis::modified, {3, 3, 0}};
    const TestVolume file({{space, {space}}}, {field_of(2, transform)});
    const Errors errors = check_class(file, 0, 0, Precision::float64, 0);
    INFO(describe(errors));
    CHECK(errors.largest() < 1e-11);
}

namespace {

/** Sixth-order difference of numbers along axis `d`; with h = 2e-3 its own error is a few 1e-12 of the gradient. */
template <class Function> std::vector<double> difference(const Function& function, const double* xi, std::size_t d) {
    constexpr double h = 2e-3;
    constexpr double weights[] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
    std::vector<double> sum;
    for (int k = -3; k <= 3; ++k) {
        if (k == 0)
            continue;
        std::array<double, 3> at{xi[0], xi[1], xi[2]};
        at[d] += k * h;
        const std::vector<double> numbers = function(at);
        sum.resize(numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i)
            sum[i] += (k < 0 ? -1 : 1) * weights[std::abs(k) - 1] * numbers[i] / h;
    }
    return sum;
}

/** Second derivatives of field and mapping against differences of the CPU's gradients; points with xi3 <= top. */
std::array<double, 2> hessian_errors(const TestVolume& file, std::uint32_t element_class, Precision precision, double top,
                                     std::uint32_t without = 0) {
    const RuntimeVolume volume = file.open();
    const std::uint32_t n_components = volume.fields()[0].n_components;
    const std::vector<double> origins(3 * volume.n_elements(), 0.0), offset(n_components, 0.0);
    const ClassOnDevice on_device(volume, element_class, 0, precision, origins, offset, "conformance/hessian_check.comp", 52,
                                  without);
    std::vector<CheckPoint> points =
        check_points(file.description().classes[element_class].geometry.shape,
                     static_cast<std::uint32_t>(volume.classes()[element_class].n_elements), n_components, precision);
    std::erase_if(points, [top](const CheckPoint& point) { return point.xi[2] > top; });
    const std::vector<double> results = on_device.evaluate(points);
    Comparison field, mapping;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double* result = results.data() + i * 52;
        const std::uint64_t element = volume.classes()[element_class].first_element + points[i].element;
        const auto gradient = [&](const std::array<double, 3>& xi) {
            std::vector<double> values(n_components), gradients(3 * n_components);
            volume.evaluate_field(0, 0, element, xi, values, gradients);
            return std::vector<double>(gradients.begin() + 3 * points[i].component,
                                       gradients.begin() + 3 * points[i].component + 3);
        };
        const auto jacobian = [&](const std::array<double, 3>& xi) {
            std::vector<double> x(3), j(9);
            volume.evaluate_mapping(element, xi, x, j);
            return j;
        };
        for (std::size_t l = 0; l < 3; ++l) {
            const std::vector<double> of_field = difference(gradient, points[i].xi, l);
            const std::vector<double> of_mapping = difference(jacobian, points[i].xi, l);
            for (std::size_t j = 0; j < 3; ++j) {
                field.add(result[4 + 3 * l + j], of_field[j]);
                for (std::size_t k = 0; k < 3; ++k)
                    mapping.add(result[25 + 9 * k + 3 * l + j], of_mapping[3 * k + j]);
            }
        }
    }
    return {field.error(), mapping.error()};
}

constexpr std::uint32_t both_hessians = ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN;

/** The snippets' own second derivatives, or without them the host's differences: errors below those given, of float64 and
 * float32. */
void check_hessians(std::uint32_t order, Precision precision, std::uint32_t without) {
    const std::vector<native::Space> spaces = snippet_spaces(order);
    const TestVolume file = volume_of(spaces, snippet_spaces(2 + order % 3), 2, 1);
    const bool is_single = precision == Precision::float32;
    // The CPU's gradient of tensor pyramids loses a few 1e-16 / t, which a difference divides by 2e-3. In float32 0.02 of the
    // way to a corner, the step of the host's differences, is a large one where a pyramid's functions are rational.
    const double largest = without == 0 ? (is_single ? 5e-6 : 1e-8) : (is_single ? 2e-2 : 1e-9);
    for (std::uint32_t i = 0; i < spaces.size(); ++i) {
        // Second derivatives of a pyramid's functions grow towards its apex, and so do the differences' errors.
        const double top = spaces[i].shape == native::Shape::pyramid ? 0.5 : 1;
        const auto [field, mapping] = hessian_errors(file, i, precision, top, without);
        std::cout << test::describe(spaces[i]) << (is_single ? ", float32" : ", float64")
                  << (without == 0 ? "" : ", by differences") << ": second derivatives of the field " << field
                  << ", of the mapping " << mapping << "\n";
        CHECK(field < largest);
        CHECK(mapping < largest);
    }
}

} // namespace

TEST_CASE("snippets give second derivatives of field and mapping") {
    check_hessians(2, Precision::float32, 0);
    check_hessians(5, Precision::float64, 0);
}

TEST_CASE("second derivatives that a snippet lacks are differences") {
    check_hessians(2, Precision::float64, both_hessians);
    check_hessians(2, Precision::float32, both_hessians);
}

TEST_CASE("second derivatives of higher order, in both precisions", "[.long]") {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        for (const std::uint32_t order : {2u, 3u, 5u, 8u})
            check_hessians(order, precision, 0);
        check_hessians(4, precision, both_hessians);
    }
}

TEST_CASE("volumes with transformed fields announce no second derivatives of fields") {
    const std::vector<native::Space> spaces = snippet_spaces(2);
    const TestVolume file({{spaces[0], {spaces[0], spaces[0]}}},
                          {field_of(3, native::Transform::covariant),
                           {"g", "", 1, native::Continuity::unknown, native::Transform::none, std::nan("")}});
    const RuntimeVolume volume = file.open();
    CHECK((volume.snippet(0).capabilities & ELVIS_SNIPPET_FIELD_HESSIAN) == 0);
    CHECK((volume.snippet(0).capabilities & ELVIS_SNIPPET_MAPPING_HESSIAN) != 0);
}

TEST_CASE("the validation layer has nothing to say") { CHECK(test::validated_device().validation_messages().empty()); }
