// What PyFR 2.1, 3.1 and its development branch wrote, against values that another program computed, and closed forms.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

using namespace elvis;

namespace {

struct Files {
    std::string mesh, solution;
};

Files files_of(const std::string& version) {
    return {pyfr_data("mixed_" + version + ".pyfrm"), pyfr_data("waves_" + version + ".pyfrs")};
}

struct ReferencePoint {
    std::uint64_t element;
    std::array<double, 3> xi, x;
    std::array<double, 5> values;
};

/** tests/data/pyfr/mixed.ref, written by make_reference.py. */
std::vector<ReferencePoint> read_reference() {
    // 2 hexahedra, 4 prisms, 12 pyramids, 12 tetrahedra, in this order.
    const std::map<std::string, std::uint64_t> first = {{"hex", 0}, {"pri", 2}, {"pyr", 6}, {"tet", 18}};
    std::vector<ReferencePoint> points;
    std::ifstream file(pyfr_data("mixed.ref"));
    for (std::string kind; file >> kind;) {
        ReferencePoint point{};
        std::array<double, 3> local{};
        file >> point.element >> local[0] >> local[1] >> local[2] >> point.x[0] >> point.x[1] >> point.x[2];
        for (double& value : point.values) {
            file >> value;
        }
        REQUIRE(file);
        point.element += first.at(kind);
        point.xi = from_pyfr(kind, local);
        points.push_back(point);
    }
    REQUIRE(points.size() == 180);
    return points;
}

/** Initial conditions of case4.ini: a polynomial of degree 4 in the reference coordinates. */
double density(const std::array<double, 3>& x) { return 1 + 0.1 * x[0] + 0.2 * x[1] * x[1] - 0.1 * x[2] * x[0]; }

/** Ten times what sums of 125 products of numbers of size 1 to 3, here and in the reference, round to. */
constexpr double rounding = 2e-13;

} // namespace

TEST_CASE("positions and values are those of the reference, in all layouts", "[pyfr][data]") {
    const std::string version = GENERATE("2.1", "3.1", "develop");
    const Files files = files_of(version);
    const SourceVolume source = open_pyfr({files.mesh, files.solution});
    CHECK(source.info().n_elements == 30);
    CHECK(source.info().dimension == 3);
    CHECK(source.info().mantissa_bits == 53);
    CHECK(field_names(source) == std::vector<std::string>{"rho", "rhou", "rhov", "rhow", "E"});
    double distance = 0, difference = 0, from_closed_form = 0;
    for (const ReferencePoint& point : read_reference()) {
        const auto x = position(source, point.element, point.xi);
        const auto values = sample(source, point.element, point.xi);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            distance = std::max(distance, std::abs(x[axis] - point.x[axis]));
        }
        for (std::size_t variable = 0; variable < 5; ++variable) {
            difference = std::max(difference, std::abs(values[variable] - point.values[variable]));
        }
        from_closed_form = std::max(from_closed_form, std::abs(values[0] - density(x)));
    }
    std::printf("%-8s positions %.1e, values %.1e, density against its formula %.1e\n", version.c_str(), distance, difference,
                from_closed_form);
    CHECK(distance < rounding);
    CHECK(difference < rounding);
    CHECK(from_closed_form < rounding);
}

TEST_CASE("conversion is exact, pyramids included", "[pyfr][data]") {
    const std::string version = GENERATE("2.1", "3.1", "develop");
    const Files files = files_of(version);
    const SourceVolume source = open_pyfr({files.mesh, files.solution});
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    const ConvertReport report = convert(source, path, {}, {});
    CHECK(report.geometry_exact);
    CHECK(report.n_unknown_faces == 0);
    CHECK(report.n_boundary_faces == 38);
    REQUIRE(report.fields.size() == 5);
    for (const FieldReport& field : report.fields) {
        INFO(field.name);
        CHECK(field.exact);
        CHECK(field.residual < 1e-13);
    }
    double distance = 0, difference = 0;
    for (std::size_t variable = 0; variable < 5; ++variable) {
        const oracle::Volume volume(oracle::read_volume(path, variable));
        std::map<std::int64_t, std::size_t> place;
        for (std::size_t element = 0; element < volume.n_elements(); ++element) {
            place[volume.number(element)] = element;
        }
        for (const ReferencePoint& point : read_reference()) {
            const std::size_t element = place.at(static_cast<std::int64_t>(point.element));
            const oracle::Vector xi{point.xi[0], point.xi[1], point.xi[2]};
            const oracle::Vector x = volume.position(element, xi);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                distance = std::max(distance, std::abs(x[static_cast<int>(axis)] - point.x[axis]));
            }
            difference = std::max(difference, std::abs(volume.field(element, xi).at(0) - point.values[variable]));
        }
    }
    std::printf("%-8s converted: positions %.1e, values %.1e\n", version.c_str(), distance, difference);
    CHECK(distance < 1e-13);
    CHECK(difference < 1e-13);
}

TEST_CASE("boundary groups lie where the mesh has them", "[pyfr][data]") {
    const SourceVolume source = open_pyfr(
        {pyfr_data(GENERATE("mixed_2.1", "mixed_3.1", "mixed_develop", "mixed_develop_imported") + std::string(".pyfrm"))});
    std::map<std::string, int> n_faces;
    const std::vector<elvis_source_element> elements = all_elements(source);
    for (std::size_t number = 0; number < elements.size(); ++number) {
        const native::Shape shape{elements[number].shape};
        for (int face = 0; face < native::n_faces(shape); ++face) {
            const std::int32_t group = elements[number].face_groups[face];
            if (group < 0) {
                continue;
            }
            const std::string name = source.boundary_groups().at(static_cast<std::size_t>(group));
            ++n_faces[name];
            // mkmesh.py calls "wall" what was at z = 0 before it bent the box to z + 0.2 b(x); corners stay.
            double height = 0;
            for (const int corner : native::face_corners(shape, face)) {
                height = std::max(height, std::abs(position(source, number, native::corner(shape, corner))[2]));
            }
            CHECK((height < 1e-12) == (name == "wall"));
        }
    }
    CHECK(n_faces == std::map<std::string, int>{{"wall", 8}, {"side", 30}});
}

TEST_CASE("faces have a boundary group exactly where they have no neighbour", "[pyfr][data]") {
    const std::string version = GENERATE("2.1", "3.1", "develop");
    const TemporaryFolder folder;
    convert(open_pyfr({files_of(version).mesh}), folder.path("volume.h5"), {}, {});
    const native::Reader reader(folder.path("volume.h5"));
    std::vector<native::Face> faces(reader.description().n_faces);
    reader.read_faces(0, faces.size(), faces);
    for (const native::Face& face : faces) {
        INFO(version << ", face " << face.local_face << " of element " << face.element);
        CHECK((face.neighbour < 0) == (face.group >= 0));
    }
}

TEST_CASE("corner numbers are those of the mesh's nodes", "[pyfr][data]") {
    const SourceVolume numbered = open_pyfr({pyfr_data("mixed_3.1.pyfrm")}), other = open_pyfr({pyfr_data("mixed_2.1.pyfrm")});
    CHECK(other.info().n_corner_ids == 0);
    CHECK(numbered.info().n_corner_ids == 151);
    std::map<std::int64_t, std::array<double, 3>> places;
    const std::vector<elvis_source_element> elements = all_elements(numbered);
    for (std::size_t number = 0; number < elements.size(); ++number) {
        const native::Shape shape{elements[number].shape};
        for (int corner = 0; corner < native::n_corners(shape); ++corner) {
            const auto x = position(numbered, number, native::corner(shape, corner));
            const auto& known = places.try_emplace(elements[number].corners[corner], x).first->second;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                CHECK(std::abs(x[axis] - known[axis]) < 1e-13);
            }
        }
    }
    // 4 x 3 x 2 corners of the unit cubes below, 2 x 3 above, two centres of cubes cut into pyramids.
    CHECK(places.size() == 32);
}

TEST_CASE("a solution alone finds its mesh beside it", "[pyfr][data]") {
    const SourceVolume alone = open_pyfr({pyfr_data("waves_3.1.pyfrs")});
    const SourceVolume both = open_pyfr({pyfr_data("waves_3.1.pyfrs"), pyfr_data("mixed_3.1.pyfrm")});
    CHECK(sample(alone, 7, {-0.5, -0.6, -0.1}) == sample(both, 7, {-0.5, -0.6, -0.1}));
}

TEST_CASE("a mesh alone tells which elements are curved", "[pyfr][data]") {
    const SourceVolume source = open_pyfr({pyfr_data("mixed_3.1.pyfrm")});
    CHECK(field_names(source) == std::vector<std::string>{"curved"});
    CHECK(sample(source, 0, {0, 0, 0}) == std::vector<double>{1});
}
