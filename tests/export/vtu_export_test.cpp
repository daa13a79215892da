// A volume that is exported and converted back is the same volume.
#include "../vtk/vtk_fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/export/vtu_export.hpp>
#include <core/plugin_host/plugin.hpp>

#include <elvis/native/volume_file.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace elvis;
using Catch::Contains;

namespace {

/** A generated data set as a native volume, opened. */
RuntimeVolume native_volume(const TemporaryFolder& folder, const std::string& description) {
    static const auto plugin = Plugin::load(NATIVE_PLUGIN);
    const std::string path = folder.path("volume.h5");
    convert(generate(description), path, {}, {});
    return RuntimeVolume(plugin, path);
}

std::string description(const std::string& mesh, const std::string& shape, int geometry_order, int order,
                        const std::string& more) {
    return R"({"generator": 1, "mesh": ")" + mesh + R"(", "shape": ")" + shape +
           R"(", "elements": [2, 2, 2], "geometry_order": )" + std::to_string(geometry_order) + R"(, "order": )" +
           std::to_string(order) + ", " + more + "}";
}

/** Largest differences of position and of all fields between a volume and what came back. */
Difference compare(const RuntimeVolume& before, const ConvertedVolume& after, std::size_t step) {
    Difference difference;
    std::vector<std::int64_t> numbers(before.n_elements());
    before.element_numbers(0, numbers.size(), numbers);
    for (const ClassInfo& info : before.classes()) {
        for (std::uint64_t i = 0; i < info.n_elements; ++i) {
            const std::uint64_t element = info.first_element + i;
            const auto back = static_cast<std::uint64_t>(numbers[element]);
            REQUIRE(after.shape(back) == static_cast<native::Shape>(info.shape));
            for (int point = 0; point < 4; ++point) {
                const native::Point xi = random_point(static_cast<native::Shape>(info.shape));
                std::array<double, 3> x;
                before.evaluate_mapping(element, xi, x, {});
                const std::array<double, 3> y = after.position(back, xi);
                for (std::size_t d = 0; d < 3; ++d)
                    difference.position = std::max(difference.position, std::abs(x[d] - y[d]));
                for (std::uint32_t field = 0; field < before.fields().size(); ++field) {
                    const FieldInfo& of = before.fields()[field];
                    std::vector<double> values(of.n_components);
                    before.evaluate_field(field, static_cast<std::uint32_t>(step), element, xi, values, {});
                    std::size_t found = 0;
                    while (after.description().fields.at(found).name != of.name)
                        ++found;
                    for (std::size_t c = 0; c < values.size(); ++c)
                        difference.value =
                            std::max(difference.value, std::abs(values[c] - after.value(back, found, xi, nullptr, c)));
                }
            }
        }
    }
    return difference;
}

Difference round_trip(const std::string& text, std::uint32_t step = 0) {
    const TemporaryFolder folder;
    const RuntimeVolume volume = native_volume(folder, text);
    const std::string vtu = folder.path("volume.vtu");
    ExportOptions options;
    options.time_step = step;
    export_vtu(volume, vtu, options, {});
    CHECK(names_in(folder).size() == 2);
    const SourceVolume source = open_vtk({vtu});
    CHECK(source.times().front() == volume.times()[step]);
    const ConvertedVolume back(source);
    CHECK(back.report().geometry_exact);
    for (const FieldReport& field : back.report().fields)
        CHECK(field.exact);
    CHECK(back.report().n_unknown_faces == 0);
    CHECK(back.report().n_faces == volume.n_faces());
    return compare(volume, back, step);
}

/** A quadrilateral and a triangle with random modes, which do not touch. */
void write_flat_volume(const std::string& path, std::uint32_t order) {
    native::Description description;
    description.dimension = 2;
    native::Field field;
    field.name = std::string("u");
    field.n_components = 2;
    description.fields.push_back(field);
    for (const native::Shape shape : {native::Shape::quadrilateral, native::Shape::triangle}) {
        const native::Space space{shape, native::Basis::modified, {order, order, 0}};
        description.classes.push_back({space, {space}, 1});
    }
    std::mt19937 random(order);
    std::uniform_real_distribution<double> number(-1, 1);
    native::Writer writer(path, description);
    for (std::size_t index = 0; index < 2; ++index) {
        std::vector<double> modes(3 * native::n_modes(description.classes[index].geometry));
        std::ranges::generate(modes, [&] { return number(random) + 5 * static_cast<double>(index); });
        writer.write_geometry(index, 0, 1, modes);
        writer.write_field(0, 0, index, 0, 1, std::span(modes).first(2 * modes.size() / 3));
        const std::int64_t place = static_cast<std::int64_t>(index);
        writer.write_numbers(index, 0, 1, std::span(&place, 1));
    }
    writer.commit();
}

} // namespace

TEST_CASE("fields come back from Lagrange cells as they were", "[vtk][export]") {
    for (const char* shape : {"hexahedron", "prism", "tetrahedron"}) {
        for (const bool is_curved : {false, true}) {
            Difference largest;
            for (int order = 1; order <= 6; ++order) {
                INFO(shape << " of order " << order << (is_curved ? ", curved" : ", straight"));
                const Difference difference = round_trip(description(is_curved ? "waves" : "box", shape, is_curved ? 3 : 1,
                                                                     order, R"("fields": ["jump", "waves"])"));
                CHECK(difference.position < 1e-13);
                // Values are up to 4.
                CHECK(difference.value < 1e-12);
                largest.position = std::max(largest.position, difference.position);
                largest.value = std::max(largest.value, difference.value);
            }
            WARN(shape << (is_curved ? ", curved" : ", straight") << ", orders 1 to 6: position " << largest.position
                       << ", value " << largest.value);
        }
    }
}

TEST_CASE("constants, vectors, steps and shapes side by side come back", "[vtk][export]") {
    const Difference difference = round_trip(
        R"({"generator": 1, "mesh": "ball", "shape": "prism", "elements": [2, 2, 2], "order": 4, "time_steps": 3,
            "fields": ["element", "taylor-green", {"field": "sinc", "order": 3}]})",
        2);
    WARN("several fields: position " << difference.position << ", value " << difference.value);
    CHECK(difference.position < 1e-13);
    // Element numbers are up to 100.
    CHECK(difference.value < 1e-11);
    const Difference linear = round_trip(R"({"generator": 1, "mesh": "box", "shape": "mixed", "elements": [4, 2, 2], "order": 1,
            "field": "sphere"})");
    CHECK(linear.value < 1e-13);
}

TEST_CASE("quadrilaterals and triangles come back, of the plane and bent in space", "[vtk][export]") {
    static const auto plugin = Plugin::load(NATIVE_PLUGIN);
    for (std::uint32_t order = 1; order <= 6; ++order) {
        const TemporaryFolder folder;
        write_flat_volume(folder.path("volume.h5"), order);
        const RuntimeVolume volume(plugin, folder.path("volume.h5"));
        export_vtu(volume, folder.path("volume.vtu"), {}, {});
        const ConvertedVolume back(open_vtk({folder.path("volume.vtu")}));
        const Difference difference = compare(volume, back, 0);
        INFO("order " << order << ": position " << difference.position << ", value " << difference.value);
        CHECK(difference.position < 1e-12);
        CHECK(difference.value < 1e-12);
    }
}

TEST_CASE("what cannot be exported is refused and leaves nothing", "[vtk][export]") {
    const TemporaryFolder folder;
    const auto failure = [&](const std::string& text, const ExportOptions& options) {
        const RuntimeVolume volume = native_volume(folder, text);
        try {
            export_vtu(volume, folder.path("volume.vtu"), options, {});
        } catch (const Error& error) {
            CHECK(names_in(folder).size() == 1);
            return std::string(error.what());
        }
        return std::string("no failure");
    };
    CHECK_THAT(failure(description("box", "pyramid", 1, 2, R"("field": "sphere")"), {}),
               Contains("pyramids of order 2") && Contains("no Lagrange pyramid"));
    CHECK_THAT(failure(description("box", "hexahedron", 1, 2, R"("field": "sphere")"), {.time_step = 1, .order = {}}),
               Contains("1 time step, no step 1"));
    CHECK_THAT(failure(description("box", "hexahedron", 1, 2, R"("field": "sphere")"), {.time_step = 0, .order = 21}),
               Contains("order 21 is outside 1..20"));
    TaskControl control;
    control.cancelled = true;
    const RuntimeVolume volume = native_volume(folder, description("box", "hexahedron", 1, 2, R"("field": "sphere")"));
    CHECK_THROWS_AS(export_vtu(volume, folder.path("volume.vtu"), {}, control), Cancelled);
    CHECK(names_in(folder).size() == 1);
}

TEST_CASE("MFEM's volume comes back from an export", "[vtk][export][data]") {
    const TemporaryFolder folder;
    static const auto plugin = Plugin::load(NATIVE_PLUGIN);
    convert(open_vtk({elvis::test::data_file("vtk/poisson-fichera-q3-p5/poisson-fichera-q3-p5.pvd")}), folder.path("volume.h5"),
            {}, {});
    const RuntimeVolume volume(plugin, folder.path("volume.h5"));
    export_vtu(volume, folder.path("volume.vtu"), {}, {});
    const ConvertedVolume back(open_vtk({folder.path("volume.vtu")}));
    const Difference difference = compare(volume, back, 0);
    WARN("MFEM's volume: position " << difference.position << ", value " << difference.value);
    CHECK(difference.position < 1e-13);
    CHECK(difference.value < 1e-13);
}
