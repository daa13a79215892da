// INLINE meshes, against what MFEM makes of them.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace elvis;
using Catch::Contains;

namespace {

SourceVolume open_inline(const std::string& text) {
    const TemporaryFolder folder;
    return open_mfem({folder.write("grid.mesh", "MFEM INLINE mesh v1.0\n" + text)});
}

std::string grid_text(const std::string& type, int nx, int ny, int nz) {
    return "type = " + type + "\nnx = " + std::to_string(nx) + "\nny = " + std::to_string(ny) + "\nnz = " + std::to_string(nz) +
           "\nsx = 1\nsy = 1\nsz = 1\n";
}

std::array<double, 3> position(const SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi) {
    std::array<double, 3> x;
    source.evaluate_mapping(element, xi, x);
    return x;
}

/** The faces of an element by their corners, and their groups' names. */
std::map<std::set<std::int64_t>, std::string> groups(const SourceVolume& source, const elvis_source_element& element) {
    std::map<std::set<std::int64_t>, std::string> result;
    const auto shape = static_cast<native::Shape>(element.shape);
    for (int face = 0; face < native::n_faces(shape); ++face) {
        std::set<std::int64_t> corners;
        for (int corner : native::face_corners(shape, face)) {
            corners.insert(element.corners[corner]);
        }
        const auto group = element.face_groups[face];
        result[corners] = group < 0 ? "" : source.boundary_groups()[static_cast<std::size_t>(group)];
    }
    return result;
}

/** Cells of a grid of nx by ny squares in the order of the elements. */
std::vector<std::array<int, 2>> cells(const SourceVolume& source, int nx, int ny) {
    std::vector<std::array<int, 2>> result;
    for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
        const auto x = position(source, element, {0, 0, 0});
        result.push_back({static_cast<int>(x[0] * nx), static_cast<int>(x[1] * ny)});
    }
    return result;
}

} // namespace

TEST_CASE("inline meshes are those that MFEM makes", "[mfem][data]") {
    struct Case {
        const char* grid;
        const char* written;
        bool is_turned;
    };
    // When MFEM wrote the tetrahedra it had turned them for refinement.
    const auto [grid, written, is_turned] = GENERATE(Case{"inline-wedge", "mfem-more/inline-wedge-h1-p3/mesh.mesh", false},
                                                     Case{"inline-pyramid", "mfem/poisson-inline-pyramid-p3/mesh.mesh", false},
                                                     Case{"inline-tet", "mfem/poisson-inline-tet-p6/mesh.mesh", true});
    const auto made = open_mfem({test::data_file(std::string("mfem-more/meshes/") + grid + ".mesh")});
    const auto read = open_mfem({test::data_file(written)});
    INFO(grid);
    REQUIRE(made.info().n_elements == read.info().n_elements);
    CHECK(made.info().n_corner_ids == read.info().n_corner_ids);
    CHECK(made.boundary_groups() == read.boundary_groups());
    for (std::uint64_t number = 0; number < made.info().n_elements; ++number) {
        auto ours = get_element(made, number), theirs = get_element(read, number);
        REQUIRE(ours.shape == theirs.shape);
        CHECK(groups(made, ours) == groups(read, theirs));
        const auto centre = native::expand(static_cast<native::Shape>(ours.shape), {0, 0, -1.0 / 3});
        if (is_turned) {
            std::sort(ours.corners, ours.corners + 4);
            std::sort(theirs.corners, theirs.corners + 4);
        } else {
            const auto x = position(made, number, centre), y = position(read, number, centre);
            CHECK(std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) <= 1e-8);
        }
        CHECK(
            std::equal(ours.corners, ours.corners + native::n_corners(static_cast<native::Shape>(ours.shape)), theirs.corners));
    }
}

TEST_CASE("squares of an inline mesh follow a Hilbert curve", "[mfem]") {
    using Cells = std::vector<std::array<int, 2>>;
    CHECK(cells(open_inline(grid_text("quad", 2, 2, 1)), 2, 2) == Cells{{0, 0}, {0, 1}, {1, 1}, {1, 0}});
    CHECK(cells(open_inline(grid_text("quad", 4, 2, 1)), 4, 2) ==
          Cells{{0, 0}, {0, 1}, {1, 1}, {1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 0}});
    CHECK(cells(open_inline(grid_text("quad", 1, 3, 1)), 1, 3) == Cells{{0, 0}, {0, 1}, {0, 2}});
    CHECK(cells(open_inline(grid_text("quad", 2, 3, 1)), 2, 3) == Cells{{0, 0}, {1, 0}, {1, 1}, {1, 2}, {0, 2}, {0, 1}});
    CHECK(cells(open_inline(grid_text("quad", 2, 5, 1)), 2, 5) ==
          Cells{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}, {1, 3}, {1, 4}, {0, 4}, {0, 3}});
}

TEST_CASE("cells of inline meshes are there once, neighbours follow neighbours", "[mfem]") {
    const auto [nx, ny, nz] = GENERATE(std::array{4, 4, 4}, std::array{6, 4, 2}, std::array{2, 8, 4}, std::array{2, 2, 10});
    const bool is_flat = GENERATE(false, true);
    const auto source = open_inline(grid_text(is_flat ? "quad" : "hex", nx, ny, nz));
    REQUIRE(source.info().n_elements == std::uint64_t(nx) * std::uint64_t(ny) * std::uint64_t(is_flat ? 1 : nz));
    std::set<std::array<int, 3>> seen;
    std::array<int, 3> last{};
    for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
        const auto x = position(source, element, {0, 0, 0});
        const std::array cell{static_cast<int>(x[0] * nx), static_cast<int>(x[1] * ny), static_cast<int>(x[2] * nz)};
        CHECK(seen.insert(cell).second);
        CHECK(std::abs(cell[0] - last[0]) + std::abs(cell[1] - last[1]) + std::abs(cell[2] - last[2]) <= 1);
        last = cell;
    }
}

TEST_CASE("lines of an inline mesh have any order, with semicolons or without", "[mfem]") {
    const auto source = open_inline("sy = 3.5 ;\nny =1; # one row\nnx = 2;\nsx =4\ntype =tri\n");
    CHECK(source.info().dimension == 2);
    REQUIRE(source.info().n_elements == 4);
    // Each cell has the triangle at its left before the one at its right.
    const auto upper = position(source, 2, {-1, 1, 0}), lower = position(source, 3, {1, -1, 0});
    CHECK(std::hypot(upper[0] - 2, upper[1] - 3.5, upper[2]) <= 1e-15);
    CHECK(std::hypot(lower[0] - 4, lower[1], lower[2]) <= 1e-15);
    CHECK(source.boundary_groups() == std::vector<std::string>{"attribute 1", "attribute 2", "attribute 3", "attribute 4"});
}

TEST_CASE("what of an inline mesh cannot be read is refused", "[mfem]") {
    const TemporaryFolder folder;
    const auto of = [&](const std::string& text) {
        return failure({folder.write("bad.mesh", "MFEM INLINE mesh v1.0\n" + text)});
    };
    REQUIRE(of(grid_text("hex", 2, 3, 4)) == "no failure");
    CHECK_THAT(of("type = segment\nnx = 4\n"), Contains("size in x"));
    CHECK_THAT(of("type = cube\n"), Contains("'cube'"));
    CHECK_THAT(of("type = quad\nnx = 4\nny = 4\nsx = 1\n"), Contains("in y is missing"));
    CHECK_THAT(of("type = quad\nnx = 4\nny = -4\nsx = 1\nsy = 1\n"), Contains("line 4") && Contains("positive"));
    CHECK_THAT(of("type = quad\nnx = 4\nny = 4\nsx = nan\nsy = 1\n"), Contains("line 5") && Contains("positive"));
    CHECK_THAT(of("type quad\n"), Contains("line 2") && Contains("'='"));
    CHECK_THAT(of("kind = quad\n"), Contains("'kind'"));
    CHECK_THAT(of("type =\n"), Contains("ends"));
    CHECK_THAT(of(grid_text("hex", 100000, 100000, 100000)), Contains("10000000"));
    CHECK_THAT(of(grid_text("hex", 2147483647, 2147483647, 2147483647)), Contains("10000000"));
}
