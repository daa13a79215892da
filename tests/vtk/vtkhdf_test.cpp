// VTKHDF files hold what their writer's formula says, in every layout.
#include "vtk_fixture.hpp"
#include "written_hexahedra.hpp"

#include <catch2/catch.hpp>
#include <tests/support/error_of.hpp>
#include <tests/support/written_hdf5.hpp>

#include <cmath>

using namespace elvis;

namespace {

std::string data_of(const std::string& name) { return elvis::test::data_file("vtkhdf/" + name); }

/** The field u of tests/data/vtkhdf. */
double formula(const std::array<double, 3>& x, double time) {
    return x[0] * x[0] * x[1] - x[2] * x[2] * x[2] + 2 * time * x[0] * x[1] * x[2];
}

native::Point point(const Hexahedra::Vector& r) { return {2 * r[0] - 1, 2 * r[1] - 1, 2 * r[2] - 1}; }

/** Largest difference of field 'u' from what was written; `first` is the first of the cells in the source. */
double difference(const SourceVolume& source, const Hexahedra& cells, std::uint64_t first = 0) {
    REQUIRE(source.fields().at(0).name == "u");
    double largest = 0;
    std::vector<double> values(source.n_values());
    for (std::uint32_t step = 0; step < source.times().size(); ++step) {
        for (std::uint64_t cell = 0; cell < cells.n_cells; ++cell) {
            for (const Hexahedra::Vector& r : {Hexahedra::Vector{0.1, 0.45, 0.93}, Hexahedra::Vector{0.77, 0.02, 0.61}}) {
                source.sample(step, first + cell, point(r), values);
                largest = std::max(largest, std::abs(values[0] - cells.field(cell, r, source.times()[step])));
            }
            if (values.size() > 1) {
                CHECK(values[1] == static_cast<double>(cell) + source.times()[step]);
            }
        }
    }
    return largest;
}

} // namespace

TEST_CASE("Lagrange cells with time steps have the values of the formula", "[vtk][vtkhdf]") {
    const SourceVolume source = open_vtk({data_of("lagrange_steps.vtkhdf")});
    CHECK(source.times() == std::vector<double>{0, 0.5, 1});
    CHECK(source.info().n_elements == 3);
    const ConvertedVolume volume(source);
    CHECK(volume.report().geometry_exact);
    CHECK(volume.report().n_unknown_faces == 0);
    double largest = 0;
    for (std::size_t step = 0; step < 3; ++step) {
        for (std::uint64_t element = 0; element < 3; ++element) {
            for (int n = 0; n < 40; ++n) {
                const native::Point xi = random_point(native::Shape::hexahedron);
                const std::array<double, 3> x = volume.position(element, xi);
                const double u = volume.value(element, 1, xi, nullptr, 0, step);
                largest = std::max(largest, std::abs(u - formula(x, source.times()[step])));
                // The field 'grad' is (x, y, z + 2 t).
                const double z = volume.value(element, 0, xi, nullptr, 2, step);
                largest = std::max(largest, std::abs(z - x[2] - 2 * source.times()[step]));
            }
        }
    }
    WARN("lagrange_steps: converted volume differs from the formula by " << largest);
    CHECK(largest < 1e-12);
}

TEST_CASE("Lagrange cells without time steps have the values of the formula at their nodes", "[vtk][vtkhdf]") {
    const SourceVolume source = open_vtk({data_of("lagrange_static.vtkhdf")});
    CHECK(source.times().size() == 1);
    std::vector<double> values(source.n_values());
    std::array<double, 3> x{};
    double largest = 0;
    for (std::uint64_t element = 0; element < 3; ++element) {
        for (int node = 0; node < 64; ++node) {
            const native::Point xi{node % 4 / 1.5 - 1, node / 4 % 4 / 1.5 - 1, node / 16 / 1.5 - 1};
            source.evaluate_mapping(element, xi, x);
            source.sample(0, element, xi, values);
            largest = std::max(largest, std::abs(values[3] - formula(x, 0)));
        }
    }
    WARN("lagrange_static: nodes differ from the formula by " << largest);
    CHECK(largest < 1e-13);
}

TEST_CASE("every layout of parts and steps holds the same field", "[vtk][vtkhdf]") {
    Hexahedra cells{4, 4, equidistant_line(4), bent};
    const TemporaryFolder folder;
    const std::vector<double> times{0.5, 1.5, 4};
    for (const std::size_t n_parts : {1u, 2u, 3u}) {
        for (const bool repeats : {false, true}) {
            for (const bool has_number : {false, true}) {
                INFO(n_parts << " parts, repeats the mesh " << repeats << ", has NumberOfParts " << has_number);
                const std::string path = folder.path("steps.vtkhdf");
                write_vtkhdf(path, cells, {n_parts, times, repeats, has_number});
                const SourceVolume source = open_vtk({path});
                CHECK(source.times() == times);
                CHECK(source.info().n_elements == 4);
                CHECK(source.info().mantissa_bits == 53);
                CHECK(difference(source, cells) < 1e-13);
            }
        }
    }
    write_vtkhdf(folder.path("static.hdf"), cells, {});
    const SourceVolume source = open_vtk({folder.path("static.hdf")});
    CHECK(source.times() == std::vector<double>{0});
    CHECK(difference(source, cells) < 1e-13);
    // Two files are two steps.
    CHECK(open_vtk({folder.path("static.hdf"), folder.path("static.hdf")}).times() == std::vector<double>{0, 1});
}

TEST_CASE("the values of one time step are held, those of the last that was asked for", "[vtk][vtkhdf]") {
    const Hexahedra cells{2, 3, equidistant_line(2), bent};
    const TemporaryFolder folder;
    write_vtu(folder.path("0.vtu"), cells, 0);
    write_vtu(folder.path("1.vtu"), cells, 1);
    const SourceVolume source = open_vtk({folder.path("0.vtu"), folder.path("1.vtu")});
    const auto value = [&](std::uint32_t step) {
        std::array<double, 1> all{};
        source.sample(step, 2, native::Point{0.2, 0.4, -0.6}, all);
        return all[0];
    };
    const Hexahedra::Vector r{0.6, 0.7, 0.2};
    for (const std::uint32_t step : {0u, 1u, 1u, 0u}) {
        CHECK(value(step) == Approx(cells.field(2, r, step)));
    }
    std::filesystem::remove(folder.path("1.vtu"));
    CHECK(value(0) == Approx(cells.field(2, r, 0)));
    CHECK_THAT(elvis::test::error_of([&] { value(1); }), Catch::Contains("1.vtu"));
}

TEST_CASE("single precision is told, and a conversion has no more than that", "[vtk][vtkhdf]") {
    Hexahedra cells{2, 3, equidistant_line(2), bent};
    const TemporaryFolder folder;
    HdfLayout layout;
    layout.is_single = true;
    write_vtkhdf(folder.path("single.vtkhdf"), cells, layout);
    const SourceVolume source = open_vtk({folder.path("single.vtkhdf")});
    CHECK(source.info().mantissa_bits == 24);
    CHECK(difference(source, cells) < 1e-5);
    CHECK(ConvertedVolume(source).report().fields.at(0).exact);
}

TEST_CASE("data sets of a collection become one volume", "[vtk][vtkhdf]") {
    Hexahedra cells{3, 4, equidistant_line(3), bent};
    const TemporaryFolder folder;
    HdfLayout layout;
    layout.times = {0, 2};
    write_collection(folder.path("collection.vtkhdf"), cells, layout);
    const SourceVolume source = open_vtk({folder.path("collection.vtkhdf")});
    CHECK(source.info().n_elements == 8);
    CHECK(difference(source, cells) < 1e-13);
    CHECK(difference(source, cells, 4) < 1e-13);
    std::array<double, 3> x{};
    source.evaluate_mapping(4, native::Point{-1, -1, -1}, x);
    CHECK(x[0] == Approx(100 + bent({0, 0, 0})[0]));
}

TEST_CASE("values may lie in other files, as virtual data sets", "[vtk][vtkhdf]") {
    using namespace elvis::test;
    const Hexahedra cells{5, 4, lobatto_line(5), bent};
    const TemporaryFolder folder;
    write_vtkhdf(folder.path("whole.vtkhdf"), cells, {});
    std::filesystem::create_directory(folder.path("run.data"));
    const std::vector<double> values = cells.values(0);
    WrittenFile(folder.path("run.data/0.h5")).dataset("u", number_type(H5T_IEEE_F64LE), {values.size()}, values.data());
    {
        const Handle file = made(H5Fopen(folder.path("whole.vtkhdf").c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        H5Ldelete(file.id(), "VTKHDF/PointData/u", H5P_DEFAULT);
        const hsize_t size = values.size();
        const Handle space = made(H5Screate_simple(1, &size, nullptr), H5Sclose);
        const Handle list = made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        H5Pset_virtual(list.id(), space.id(), "run.data/0.h5", "u", space.id());
        made(H5Dcreate2(file.id(), "VTKHDF/PointData/u", H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
             H5Dclose);
    }
    CHECK(difference(open_vtk({folder.path("whole.vtkhdf")}), cells) < 1e-12);
    std::filesystem::remove(folder.path("run.data/0.h5"));
    CHECK_THAT(error_of([&] { open_vtk({folder.path("whole.vtkhdf")}); }),
               Catch::Contains("PointData/u lies in the file 'run.data/0.h5', which is missing"));
}

TEST_CASE("field data tell the time of a file without steps", "[vtk][vtkhdf]") {
    const TemporaryFolder folder;
    const std::string path = folder.path("static.vtkhdf");
    write_vtkhdf(path, {2, 3, equidistant_line(2)}, {});
    {
        using namespace elvis::test;
        const Handle file = made(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        const Handle group = made(H5Gcreate2(file.id(), "VTKHDF/FieldData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
        const hsize_t one = 1;
        const Handle space = made(H5Screate_simple(1, &one, nullptr), H5Sclose);
        const Handle set = made(
            H5Dcreate2(group.id(), "TimeValue", H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
        const double time = 2.5;
        H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &time);
    }
    CHECK(open_vtk({path}).times() == std::vector<double>{2.5});
}

TEST_CASE("HDF5 files of other types and other meshes are refused with the cause", "[vtk][vtkhdf]") {
    using Catch::Contains;
    const Hexahedra cells{2, 3, equidistant_line(2)};
    const TemporaryFolder folder;
    const std::string path = folder.path("wrong.vtkhdf");
    const auto failure = [&] {
        try {
            open_vtk({path});
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string("no failure");
    };
    HdfLayout layout;
    for (const char* type : {"PolyData", "ImageData", "OverlappingAMR", "HyperTreeGrid"}) {
        layout.type = type;
        write_vtkhdf(path, cells, layout);
        CHECK_THAT(failure(), Contains("wrong.vtkhdf") && Contains(std::string("is of type '") + type + "'"));
    }
    { elvis::test::WrittenFile(path).group("other"); }
    CHECK_THAT(failure(), Contains("has no group VTKHDF"));
    // The second step's points lie beyond the end.
    layout = {};
    layout.times = {0, 1};
    write_vtkhdf(path, cells, layout);
    {
        using namespace elvis::test;
        const Handle file = made(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        const Handle set = made(H5Dopen2(file.id(), "VTKHDF/Steps/PointOffsets", H5P_DEFAULT), H5Dclose);
        const std::array<std::int64_t, 2> offsets{0, 1000};
        H5Dwrite(set.id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, offsets.data());
    }
    CHECK_THAT(failure(), Contains("VTKHDF/Points has 81 rows; 27 from row 1000 on are expected"));
}
