// Zones, time steps, boundaries and links of files that the CGNS library writes.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <hdf5.h>

using namespace elvis;

namespace {

/** Largest difference of the fields Pressure and Velocity from their closed forms at a time. */
double field_error(const SourceVolume& source, std::uint32_t step, double time) {
    double largest = 0;
    const std::vector<elvis_source_element> elements = all_elements(source);
    for (std::uint64_t element = 0; element < elements.size(); ++element) {
        const Point xi = random_point(static_cast<native::Shape>(elements[element].shape));
        const Point x = position(source, element, xi), u = cgns_test::velocity(x, time);
        std::vector<double> values(source.n_values());
        source.sample(step, element, xi, values);
        const std::array<double, 4> expected{cgns_test::pressure(x), u[0], u[1], u[2]};
        for (std::size_t index = 0; index < expected.size(); ++index) {
            largest = std::max(largest, std::abs(values.at(index) - expected[index]));
        }
    }
    return largest;
}

/** The file of a later version of the library, whose number alone keeps older libraries from reading it. */
void set_version(const std::string& path, float version) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t data = H5Dopen2(file, "CGNSLibraryVersion/ data", H5P_DEFAULT);
    REQUIRE(H5Dwrite(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, &version) >= 0);
    H5Dclose(data);
    H5Fclose(file);
}

} // namespace

TEST_CASE("structured zones, with their time steps and boundary conditions", "[cgns]") {
    const std::string container = GENERATE("hdf5", "adf");
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "structured", container)});
    CHECK(source.info().n_elements == 9);
    CHECK(source.times() == std::vector<double>{0, 0.5, 1});
    CHECK(field_names(source) == std::vector<std::string>{"Pressure", "Velocity"});
    for (std::uint32_t step = 0; step < 3; ++step) {
        CHECK(field_error(source, step, 0.5 * step) < 1e-13);
    }
    CHECK(n_faces_by_group(source) == "Inflow 3, Outflow 3, Walls 9");
    const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
    // The zones have the three faces between them in common.
    CHECK(report.n_boundary_faces == 2 * (9 + 3 + 3));
    CHECK(report.n_unknown_faces == 0);
    CHECK(report.geometry_exact);
}

TEST_CASE("cells of the rind are left out", "[cgns]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "rind", GENERATE("hdf5", "adf"))});
    REQUIRE(source.info().n_elements == 6);
    for (std::uint64_t element = 0; element < 6; ++element) {
        const auto row = static_cast<double>(element / 3), column = static_cast<double>(element % 3);
        CHECK(sample(source, element, {0, 0, 0}) == std::vector{10 * row + column});
        CHECK(position(source, element, {0, 0, 0}) == Point{column + 0.5, row + 0.5, 0});
    }
}

TEST_CASE("boundary conditions name elements or vertices, and sections that none names are groups", "[cgns]") {
    const std::string container = GENERATE("hdf5", "adf");
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "boundaries", container)});
    CHECK(source.info().n_elements == 2);
    CHECK(source.info().n_corner_ids == 12);
    CHECK(n_faces_by_group(source) == "Bottom 2, East 1, Rest 4, Walls 2, West 1");
    CHECK(field_error(source, 0, 0) < 1e-13);
    CHECK(source.fields()[0].continuity == ELVIS_CONTINUITY_CONTINUOUS);
}

TEST_CASE("meshes in the plane, with edges on the boundary", "[cgns]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "plane", GENERATE("hdf5", "adf"))});
    CHECK(source.info().dimension == 2);
    CHECK(n_faces_by_group(source) == "Low 2");
    for (std::uint64_t element = 0; element < 4; ++element) {
        CHECK(sample(source, element, {-0.5, -0.5, 0}) == std::vector{static_cast<double>(element) + 1});
    }
    CHECK(convert(source, folder.path("volume.h5"), {}, {}).geometry_exact);
}

TEST_CASE("links lead to other files, of either container", "[cgns]") {
    const std::string container = GENERATE("hdf5", "adf"), other = GENERATE("hdf5", "adf");
    const TemporaryFolder folder;
    write_cgns(folder, "boundaries", other);
    const std::string path = write_cgns(folder, "links", container, "boundaries_" + other + ".cgns");
    const SourceVolume source = open_cgns({path});
    CHECK(source.info().n_elements == 2);
    CHECK(field_error(source, 0, 2) < 1e-13);
    std::filesystem::remove(folder.path("boundaries_" + other + ".cgns"));
    CHECK_THAT(failure(path), Catch::Contains("boundaries_" + other + ".cgns") && Catch::Contains("links_"));
}

TEST_CASE("files of later versions are read", "[cgns]") {
    const TemporaryFolder folder;
    const std::string path = write_cgns(folder, "boundaries", "hdf5");
    set_version(path, 4.5);
    CHECK(field_error(open_cgns({path}), 0, 0) < 1e-13);
}

TEST_CASE("of several bases the one of the most dimensions is read", "[cgns]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "bases", GENERATE("hdf5", "adf"))});
    CHECK(source.info().n_elements == 1);
    CHECK(source.info().mantissa_bits == 24);
    CHECK(n_faces_by_group(source) == "High 1, Low 1");
    CHECK(position(source, 0, {0, 0, 0}) == Point{0.5, 0.5, 0.5});
    CHECK(field_names(source) == std::vector<std::string>{"zone"});
    CHECK(sample(source, 0, {0, 0, 0}) == std::vector{0.0});
    CHECK(convert(source, folder.path("volume.h5"), {}, {}).fields.at(0).exact);
}

TEST_CASE("arrays in several runs of data", "[cgns]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "runs", GENERATE("hdf5", "adf"))});
    for (const Point& xi : {Point{-0.3, 0.2, -0.9}, Point{1, 1, 1}, Point{-1, -1, -1}}) {
        CHECK(std::abs(sample(source, 0, xi).at(0) - cgns_test::pressure(position(source, 0, xi))) < 1e-14);
    }
}

TEST_CASE("surfaces in space", "[cgns]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_cgns({write_cgns(folder, "upright", GENERATE("hdf5", "adf"))});
    CHECK(source.info().dimension == 2);
    CHECK(position(source, 0, {0, 0, 0}) == Point{0.5, 5, 0.5});
    CHECK(field_error(source, 0, 0) < 1e-13);
    CHECK(convert(source, folder.path("volume.h5"), {}, {}).geometry_exact);
}
