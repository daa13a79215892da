// Meshes of surfaces as arrays.

#include "some_volume.hpp"

#include <elvis/extract.hpp>

#include <algorithm>
#include <cmath>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

elvis_extraction level_of_p(double isovalue) {
    auto wanted = detail::sized<elvis_extraction>();
    wanted.domain = ELVIS_DOMAIN_ISOSURFACE;
    wanted.level_field = "p";
    wanted.isovalue = isovalue;
    return wanted;
}

} // namespace

TEST_CASE("a mesh has vertices on the surface, values at them, and what is known of it") {
    const TemporaryFolder folder;
    const context library(own_plugins());
    const data volume = library.open(convert(library, folder));
    elvis_extraction wanted = level_of_p(0.4);
    const elvis_string fields[] = {"p", "x"};
    wanted.fields = fields;
    wanted.n_fields = 2;
    const extracted mesh = extract(library, volume, wanted);
    REQUIRE(mesh.info.n_vertices > 10);
    CHECK(mesh.info.n_values == 2);
    CHECK(mesh.info.n_inner_edges == 0);
    CHECK(mesh.info.mesh_to_surface <= mesh.info.tolerance);
    double off = 0;
    for (std::size_t i = 0; i < mesh.info.n_vertices; ++i) {
        const double x = mesh.positions[3 * i], y = mesh.positions[3 * i + 1], z = mesh.positions[3 * i + 2];
        off = std::max(
            {off, std::abs(x * x * y + z - 0.4), std::abs(mesh.values[2 * i] - 0.4), std::abs(mesh.values[2 * i + 1] - x)});
    }
    CHECK(off < 1e-11);
    CHECK(std::ranges::all_of(mesh.triangles, [&](std::uint32_t vertex) { return vertex < mesh.info.n_vertices; }));
    CHECK(std::ranges::all_of(mesh.triangle_elements, [](std::int64_t element) { return element >= 0 && element < 27; }));

    const double isovalues[] = {0.2, 0.3};
    wanted.domain = ELVIS_DOMAIN_PLANE;
    wanted.plane[0] = 1;
    wanted.plane[3] = -0.5;
    wanted.contour_field = "p";
    wanted.contours = isovalues;
    wanted.n_contours = 2;
    const extracted lines = extract(library, volume, wanted);
    CHECK(lines.info.n_triangles == 0);
    REQUIRE(lines.info.n_lines >= 2);
    CHECK(lines.line_first.back() == lines.info.n_line_vertices);
    for (const double value : lines.line_values) {
        CHECK((value == 0.2 || value == 0.3));
    }
}

TEST_CASE("mistakes in what is to be extracted are told") {
    const TemporaryFolder folder;
    const context library(own_plugins());
    const data volume = library.open(convert(library, folder));
    elvis_extraction wanted = level_of_p(0.4);
    wanted.domain = ELVIS_DOMAIN_VOLUME;
    CHECK_THROWS_WITH(extract(library, volume, wanted), Catch::Contains("domain"));
    wanted = level_of_p(0.4);
    wanted.tolerance = -1;
    CHECK_THROWS_WITH(extract(library, volume, wanted), Catch::Contains("tolerance"));
    wanted = level_of_p(0.4);
    wanted.level_field = nullptr;
    CHECK_THROWS_WITH(extract(library, volume, wanted), Catch::Contains("level_field"));
    wanted.domain = ELVIS_DOMAIN_PLANE;
    CHECK_THROWS_WITH(extract(library, volume, wanted), Catch::Contains("normal"));
    CHECK(elvis_data_extract(volume.get(), nullptr, nullptr, nullptr) == ELVIS_ERROR_INVALID_ARGUMENT);
    elvis_mesh_release(nullptr);
}
