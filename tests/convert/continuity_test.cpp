// Continuous targets from sources outside the space agree across faces; labels say what jumps show; faces are known.
#include "dat_writer.hpp"
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace elvis;

namespace {

std::string describe(const std::string& mesh, const std::string& shape, const std::string& rest) {
    return R"({"generator":1,"mesh":")" + mesh + R"(","shape":")" + shape + R"(","elements":4,"geometry_order":2,)" + rest +
           "}";
}

} // namespace

TEST_CASE("neighbours agree on a continuous target without talking", "[convert]") {
    double largest = 0;
    for (const char* mesh : {"waves", "ball"})
        for (const char* shape : {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"})
            for (int order : {1, 2, 5}) {
                CAPTURE(mesh, shape, order);
                const ConvertedVolume volume(
                    generate(describe(mesh, shape, R"("field":"waves","order":)" + std::to_string(order))));
                const FieldReport& field = volume.report().fields[0];
                CHECK_FALSE(field.exact);
                CHECK(field.max_jump <= 1e-13);
                CHECK(volume.description().fields[0].max_jump == field.max_jump);
                CHECK(volume.description().fields[0].continuity == native::Continuity::continuous);
                largest = std::max(largest, field.max_jump);
            }
    std::printf("continuous targets: largest jump %.1e\n", largest);
}

TEST_CASE("continuous targets converge", "[convert]") {
    for (const char* shape : {"hexahedron", "prism", "tetrahedron", "pyramid"}) {
        std::vector<double> residuals;
        for (int order : {2, 4, 6, 8})
            residuals.push_back(
                ConvertedVolume(generate(describe("waves", shape, R"("field":"waves","order":)" + std::to_string(order))))
                    .report()
                    .fields[0]
                    .residual);
        std::printf("waves on curved %s: residual %.1e %.1e %.1e %.1e at orders 2 4 6 8\n", shape, residuals[0], residuals[1],
                    residuals[2], residuals[3]);
        CHECK(residuals[1] < 0.2 * residuals[0]);
        CHECK(residuals[2] < 0.2 * residuals[1]);
        CHECK(residuals[3] < 0.2 * residuals[2]);
    }
}

TEST_CASE("a discontinuous target is fitted element by element", "[convert]") {
    const SourceVolume source = generate(describe("waves", "hexahedron", R"("field":"waves","order":3)"));
    ConvertOptions options;
    options.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
    const ConvertedVolume volume(source, options);
    CHECK(volume.report().fields[0].max_jump > 1e-4);
    CHECK(volume.description().fields[0].continuity == native::Continuity::discontinuous);
}

TEST_CASE("jumps are measured and never smoothed", "[convert]") {
    const ConvertedVolume volume(generate(describe("ball", "mixed", R"("fields":["jump","element","sphere"])")));
    const auto& fields = volume.report().fields;
    CHECK(fields[0].exact);
    CHECK(fields[1].exact);
    CHECK(fields[0].max_jump > 0.5);
    CHECK(fields[0].continuity == ELVIS_CONTINUITY_DISCONTINUOUS);
    CHECK(fields[2].continuity == ELVIS_CONTINUITY_CONTINUOUS);
    double largest = 0;
    for (const native::Face& face : volume.faces())
        if (face.neighbour >= 0)
            largest = std::max(largest, std::abs(static_cast<double>(face.element - face.neighbour)));
    CHECK(fields[1].max_jump == largest);
    for (std::uint64_t element = 0; element < volume.n_elements(); ++element)
        CHECK(volume.field_coefficients(element, 1, 0, 0) == std::vector<double>{static_cast<double>(element)});
}

TEST_CASE("a wrong label is put right", "[convert]") {
    const ConvertedVolume volume(
        generate(describe("waves", "hexahedron", R"("fields":[{"field":"jump","continuity":"continuous"}])")));
    CHECK(volume.report().fields[0].exact);
    CHECK(volume.description().fields[0].continuity == native::Continuity::discontinuous);
}

TEST_CASE("faces carry neighbours and boundary groups", "[convert]") {
    const ConvertedVolume volume(generate(R"({"generator":1,"mesh":"box","elements":[3,2,2],"field":"sphere"})"));
    CHECK(volume.report().n_faces == 3 * 2 * 2 * 3 + 2 * 2 + 3 * 2 + 3 * 2);
    CHECK(volume.report().n_boundary_faces == 2 * (2 * 2 + 3 * 2 + 3 * 2));
    REQUIRE(volume.description().boundary_groups == std::vector<std::string>{"x-", "x+", "y-", "y+", "z-", "z+"});
    std::array<int, 6> counts{};
    for (const native::Face& face : volume.faces()) {
        if (face.neighbour < 0) {
            CHECK(face.neighbour == -1);
            ++counts.at(static_cast<std::size_t>(face.group));
            continue;
        }
        CHECK(face.group == -1);
        CHECK(face.element < face.neighbour);
        // The centre of the face is the same from both sides.
        const auto centre = [&](std::int64_t element, int local) {
            native::Point xi{};
            for (int corner : native::face_corners(native::Shape::hexahedron, local))
                for (std::size_t d = 0; d < 3; ++d)
                    xi[d] += 0.25 * native::corner(native::Shape::hexahedron, corner)[d];
            return volume.position(static_cast<std::uint64_t>(element), xi);
        };
        const auto a = centre(face.element, face.local_face);
        const auto b = centre(face.neighbour, face.neighbour_local_face);
        for (std::size_t d = 0; d < 3; ++d)
            CHECK(a[d] == Approx(b[d]).margin(1e-14));
    }
    CHECK(counts == std::array<int, 6>{4, 4, 6, 6, 6, 6});
}

TEST_CASE("hanging faces are unknown, the boundary is not", "[convert]") {
    // A cube of edge 2 beside four of edge 1, which share its face x = 2; the last one is shifted in the second case.
    const auto volume = [](double shift) {
        DatWriter writer;
        writer.add_box({0, 0, 0}, {2, 2, 2});
        for (double y : {0.0, 1.0})
            for (double z : {0.0, 1.0})
                writer.add_box({2 + (y + z == 2 ? shift : 0), y, z}, {3 + (y + z == 2 ? shift : 0), y + 1, z + 1});
        const TemporaryFolder folder;
        return ConvertedVolume(open_dat(folder.write("hanging.dat", writer.bytes())));
    };
    const ConvertedVolume touching = volume(0);
    CHECK(touching.report().n_unknown_faces == 5);
    CHECK(touching.report().n_faces == 30 - 4);
    CHECK(touching.report().n_boundary_faces == 30 - 8 - 5);
    const ConvertedVolume apart = volume(0.1);
    // The large face, three on it, and two pairs between the shifted cube and its neighbours, which overlap in part.
    CHECK(apart.report().n_unknown_faces == 1 + 3 + 4);
}

TEST_CASE("faces with the same corners and other maps are unknown", "[convert]") {
    // The second hexahedron names the corners of the shared face in an order that folds it.
    DatWriter writer;
    writer.add_box({0, 0, 0}, {1, 1, 1});
    std::array<std::array<double, 3>, 8> corners = box_corners({1, 0, 0}, {2, 1, 1});
    std::swap(corners[0], corners[3]);
    writer.add(1, {corners.begin(), corners.end()}, {1, 1, 1}, std::vector<double>(8, 1.0));
    const TemporaryFolder folder;
    const ConvertedVolume volume(open_dat(folder.write("folded.dat", writer.bytes())));
    CHECK(volume.report().n_faces == 12);
    for (const native::Face& face : volume.faces()) {
        const bool is_contact = face.local_face == (face.element == 0 ? 2 : 4);
        CHECK((is_contact ? face.neighbour == -2 : face.neighbour < 0));
    }
}

TEST_CASE("a face of three elements is unknown to all", "[convert]") {
    DatWriter writer;
    writer.add_box({0, 0, 0}, {1, 1, 1});
    writer.add_box({1, 0, 0}, {2, 1, 1});
    writer.add_box({1, 0, 0}, {3, 1, 1});
    const TemporaryFolder folder;
    const ConvertedVolume volume(open_dat(folder.write("three.dat", writer.bytes())));
    CHECK(volume.report().n_faces == 18);
    for (const native::Face& face : volume.faces())
        if (face.local_face == (face.element == 0 ? 2 : 4))
            CHECK(face.neighbour == -2);
}
