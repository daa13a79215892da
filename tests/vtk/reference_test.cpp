// Fields of VTK's files are what the programs say that wrote them.
#include "vtk_fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace elvis;

namespace {

void check_cells(const std::string& name, std::size_t n_cells) {
    const SourceVolume source = open_vtk({sample_file(name + ".vtu")});
    const std::vector<VtkReference> references = read_reference(name + ".ref");
    CHECK(source.info().n_elements == n_cells);
    CHECK(source.fields().at(0).name == "u");
    CHECK(source.fields().at(1).name == "v");
    CHECK(source.fields().at(2).name == "number");
    CHECK(source.fields().size() == 3);
    const Difference before = source_difference(source, references);
    const ConvertedVolume volume(source);
    const Difference after = converted_difference(source, volume, references);
    WARN(name << ": source differs from VTK by " << before.position << " in position and " << before.value
              << " in value, converted volume by " << after.position << " and " << after.value);
    CHECK(after.position < 1e-11);
    CHECK(after.value < 1e-11);
    CHECK(volume.report().geometry_exact);
    for (const FieldReport& field : volume.report().fields)
        CHECK(field.exact);
    for (std::uint64_t cell = 0; cell < n_cells; ++cell)
        CHECK(volume.value(cell, 2, {-0.5, -0.5, -0.5}) == static_cast<double>(cell));
}

} // namespace

TEST_CASE("volume cells of every kind are those of VTK", "[vtk]") { check_cells("cells3", 59); }

TEST_CASE("surface cells of every kind are those of VTK", "[vtk]") {
    const SourceVolume source = open_vtk({sample_file("cells2.vtu")});
    CHECK(source.info().dimension == 2);
    CHECK(source.info().n_elements == 37);
    const Difference difference = source_difference(source, read_reference("cells2.ref"));
    WARN("cells2: source differs from VTK by " << difference.position << " in position and " << difference.value
                                               << " in value");
}

TEST_CASE("rational cells are those of VTK and their conversion is not called exact", "[vtk]") {
    const SourceVolume source = open_vtk({sample_file("rational.vtu")});
    const std::vector<VtkReference> references = read_reference("rational.ref");
    const Difference before = source_difference(source, references);
    const ConvertedVolume volume(source);
    WARN("rational: source differs from VTK by " << before.position << " in position and " << before.value
                                                 << " in value; conversion leaves a residual of "
                                                 << volume.report().fields.at(0).residual);
    CHECK_FALSE(volume.report().fields.at(0).exact);
    CHECK_FALSE(volume.report().geometry_exact);
    CHECK(volume.report().fields.at(0).residual > 1e-6);
    CHECK(volume.report().fields.at(0).residual < 0.2);
}

TEST_CASE("what MFEM writes for ParaView has MFEM's own values", "[vtk][data]") {
    const SourceVolume source = open_vtk({elvis::test::data_file("vtk/poisson-fichera-q3-p5/poisson-fichera-q3-p5.pvd")});
    const ConvertedVolume volume(source);
    CHECK(volume.n_elements() == 448);
    CHECK(volume.report().fields.at(0).name == "u");
    CHECK(volume.report().fields.at(0).exact);
    CHECK(volume.report().geometry_exact);
    CHECK(volume.report().n_unknown_faces == 0);
    CHECK(volume.report().fields.at(0).continuity == ELVIS_CONTINUITY_CONTINUOUS);

    std::ifstream file(elvis::test::data_file("mfem/poisson-fichera-q3-p5/sol.ref"));
    double position = 0, in_source = 0, in_volume = 0, slope = 0;
    std::size_t n_points = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#'))
            continue;
        std::istringstream numbers(line);
        std::uint64_t element = 0;
        int geometry = 0;
        native::Point ip, x;
        double value = 0;
        std::array<double, 3> gradient;
        numbers >> element >> geometry >> ip[0] >> ip[1] >> ip[2] >> x[0] >> x[1] >> x[2] >> value >> gradient[0] >>
            gradient[1] >> gradient[2];
        REQUIRE(numbers);
        ++n_points;
        const native::Point xi{2 * ip[0] - 1, 2 * ip[1] - 1, 2 * ip[2] - 1};
        std::vector<double> sampled(source.n_values());
        source.sample(0, element, xi, sampled);
        in_source = std::max(in_source, std::abs(sampled[0] - value));
        native::Point converted_gradient;
        in_volume = std::max(in_volume, std::abs(volume.value(element, 0, xi, &converted_gradient) - value));
        const auto converted = volume.position(element, xi);
        for (std::size_t d = 0; d < 3; ++d) {
            position = std::max(position, std::abs(converted[d] - x[d]));
            slope = std::max(slope, std::abs(converted_gradient[d] - gradient[d]));
        }
    }
    WARN(n_points << " points: position " << position << ", value " << in_source << " in the source and " << in_volume
                  << " converted, gradient " << slope);
    // MFEM's reference was computed from files of 8 digits; those for ParaView come from the numbers in memory.
    CHECK(n_points > 1000);
    CHECK(position < 1e-7);
    CHECK(in_source < 1e-7);
    CHECK(in_volume < 1e-7);
}
