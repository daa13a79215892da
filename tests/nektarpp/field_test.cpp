// Fields in every basis and layout, against sums over the native library's modes; time steps; partitions.
#include "fixture.hpp"
#include "nektar_writer.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace elvis;
using Catch::Contains;
using native::Basis;
using native::Shape;
using native::Space;
using nektar_writer::Block;
using nektar_writer::Point;

namespace {

std::vector<double> random_numbers(std::size_t n, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> numbers(n);
    std::ranges::generate(numbers, [&] { return uniform(generator); });
    return numbers;
}

/** Points inside a shape and at its corners, the singular ones included. */
std::vector<Point> points_in(Shape shape) {
    std::vector<Point> points;
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        points.push_back(native::corner(shape, corner));
    }
    const std::vector<double> eta = random_numbers(36, 5);
    for (std::size_t at = 0; at < eta.size(); at += 3) {
        points.push_back(native::expand(shape, {eta[at], eta[at + 1], eta[at + 2]}));
    }
    return points;
}

/** Largest difference of a field from modes times coefficients, in the source and after conversion. */
double largest_error(const SourceVolume& source, std::uint64_t element, std::size_t field, const Space& space,
                     std::span<const double> coefficients, double factor = 1) {
    double largest = 0;
    for (const Point& xi : points_in(space.shape)) {
        const double wanted = factor * native::evaluate(space, coefficients, xi);
        largest = std::max(largest, std::abs(value_at(source, element, xi, field) - wanted));
    }
    return largest;
}

std::string cube() { return sample_file("CubeAllElements.xml"); }

struct Case {
    std::string shape;
    std::string basis;
    std::string ids;
    std::uint64_t element;
    Space space;
};

} // namespace

TEST_CASE("every basis is read in its order and converts exactly", "[nektarpp][data]") {
    const auto c = GENERATE(values<Case>({
        {"Hexahedron", "Modified_A,Modified_A,Modified_A", "70", 70, {Shape::hexahedron, Basis::modified, {2, 4, 3}}},
        {"Hexahedron", "Ortho_A,Ortho_A,Ortho_A", "70", 70, {Shape::hexahedron, Basis::orthogonal, {2, 4, 3}}},
        {"Hexahedron", "GLL_Lagrange,GLL_Lagrange,GLL_Lagrange", "70", 70, {Shape::hexahedron, Basis::gll_lagrange, {3, 1, 5}}},
        {"Hexahedron",
         "Gauss_Lagrange, Gauss_Lagrange, Gauss_Lagrange",
         "70",
         70,
         {Shape::hexahedron, Basis::gauss_lagrange, {4, 3, 2}}},
        {"Prism", "Modified_A,Modified_A,Modified_B", "80", 80, {Shape::prism, Basis::modified, {2, 4, 3}}},
        {"Prism", "Ortho_A,Ortho_A,Ortho_B", "80", 80, {Shape::prism, Basis::orthogonal, {2, 4, 3}}},
        {"Tetrahedron", "Modified_A,Modified_B,Modified_C", "3", 3, {Shape::tetrahedron, Basis::modified, {3, 4, 6}}},
        {"Tetrahedron", "Ortho_A,Ortho_B,Ortho_C", "3", 3, {Shape::tetrahedron, Basis::orthogonal, {3, 4, 6}}},
        {"Pyramid", "Modified_A,Modified_A,ModifiedPyr_C", "120", 120, {Shape::pyramid, Basis::modified, {6, 6, 6}}},
        {"Pyramid", "Modified_A,Modified_A,ModifiedPyr_C", "120", 120, {Shape::pyramid, Basis::modified, {1, 1, 1}}},
        {"Pyramid", "Ortho_A,Ortho_A,OrthoPyr_C", "120", 120, {Shape::pyramid, Basis::orthogonal, {1, 1, 1}}},
        {"Pyramid", "Ortho_A,Ortho_A,OrthoPyr_C", "120", 120, {Shape::pyramid, Basis::orthogonal, {5, 5, 5}}},
    }));
    const auto& order = c.space.order;
    const std::vector<double> coefficients = random_numbers(native::n_modes(c.space), 1);
    const std::string modes =
        "UNIORDER:" + std::to_string(order[0] + 1) + "," + std::to_string(order[1] + 1) + "," + std::to_string(order[2] + 1);
    const TemporaryFolder folder;
    const SourceVolume source = open_nektar(
        {cube(), folder.write("one.fld", nektar_writer::field_file({{"u", c.shape, c.basis, modes, c.ids, coefficients}}))});
    CAPTURE(c.shape, c.basis, modes);
    CHECK(largest_error(source, c.element, 0, c.space, coefficients) <= 1e-12);
    std::vector<elvis_source_space> spaces(1);
    source.spaces(0, c.element, 1, spaces);
    CHECK(spaces[0].is_contained != 0);
    // Other elements have no data.
    CHECK(std::isnan(value_at(source, c.element + 1, native::corner(c.space.shape, 0))));
    const Converted converted(source);
    double largest = 0;
    for (const Point& xi : points_in(c.space.shape)) {
        largest = std::max(largest, std::abs(converted.value(c.element, xi) - native::evaluate(c.space, coefficients, xi)));
    }
    CHECK(largest <= 1e-12);
    CHECK(converted.report().fields[0].residual <= 1e-12);
    CHECK(converted.report().fields[0].n_not_finite == source.info().n_elements - 1);
}

TEST_CASE("one mode is a constant of its basis", "[nektarpp][data]") {
    const TemporaryFolder folder;
    const SourceVolume source = open_nektar(
        {cube(),
         folder.write("one.fld",
                      nektar_writer::field_file(
                          {{"u", "Hexahedron", "Ortho_A,Ortho_A,Ortho_A", "UNIORDER:1,1,1", "66", {2}},
                           {"u", "Tetrahedron", "Ortho_A,Ortho_B,Ortho_C", "UNIORDER:1,1,1", "1", {2}},
                           {"u", "Hexahedron", "Gauss_Lagrange,Gauss_Lagrange,Gauss_Lagrange", "UNIORDER:1,1,1", "67", {2}},
                           {"u", "Hexahedron", "Ortho_A,Ortho_A,Ortho_A", "UNIORDER:1,3,1", "68", {2, 0, 1}}}))});
    CHECK(value_at(source, 66, {0.3, 0.1, 0.2}) == Approx(2 * std::pow(0.5, 1.5)).epsilon(1e-14));
    CHECK(value_at(source, 1, {-0.9, -0.8, -0.7}) == Approx(2 * std::sqrt(0.5 * 1 * 1.5)).epsilon(1e-14));
    CHECK(value_at(source, 67, {0.3, 0.1, 0.2}) == Approx(2).epsilon(1e-14));
    // 2/2 * sqrt(1/2) + 1/2 * sqrt(5/2) P_2(y)
    CHECK(value_at(source, 68, {0.3, 0.1, 0.2}) ==
          Approx(std::sqrt(0.5) + 0.5 * std::sqrt(2.5) * 0.5 * (3 * 0.01 - 1)).epsilon(1e-14));
    std::vector<elvis_source_space> spaces(3);
    source.spaces(0, 66, 3, spaces);
    CHECK(spaces[0].order[0] == 0);
    CHECK(spaces[2].order[0] == 1);
    CHECK(spaces[2].order[1] == 2);
}

TEST_CASE("fields of several blocks keep their own orders", "[nektarpp][data]") {
    const Space fine{Shape::hexahedron, Basis::modified, {3, 3, 3}}, coarse{Shape::hexahedron, Basis::modified, {1, 2, 1}};
    const std::vector<double> of_u_v = random_numbers(2 * 2 * native::n_modes(fine), 2);
    // p in two elements of different orders.
    const std::vector<double> of_p = random_numbers(native::n_modes(coarse) + native::n_modes(fine), 3);
    const std::string basis = "Modified_A,Modified_A,Modified_A";
    const TemporaryFolder folder;
    const SourceVolume source = open_nektar(
        {cube(), folder.write("fields.fld", nektar_writer::field_file(
                                                {{"u,v", "Hexahedron", basis, "UNIORDER:4,4,4", "75,66", of_u_v},
                                                 {"p", "Hexahedron", basis, "MIXORDER:2,3,2,4,4,4", "66,75", of_p, ""}}))});
    REQUIRE(source.fields().size() == 3);
    CHECK(source.fields()[2].name == "p");
    const std::size_t n = native::n_modes(fine);
    const std::span<const double> all(of_u_v);
    CHECK(largest_error(source, 75, 0, fine, all.subspan(0, n)) <= 1e-13);
    CHECK(largest_error(source, 66, 0, fine, all.subspan(n, n)) <= 1e-13);
    CHECK(largest_error(source, 75, 1, fine, all.subspan(2 * n, n)) <= 1e-13);
    CHECK(largest_error(source, 66, 1, fine, all.subspan(3 * n, n)) <= 1e-13);
    CHECK(largest_error(source, 66, 2, coarse, std::span(of_p).first(native::n_modes(coarse))) <= 1e-13);
    CHECK(largest_error(source, 75, 2, fine, std::span(of_p).last(n)) <= 1e-13);
    std::vector<elvis_source_space> spaces(1);
    source.spaces(2, 66, 1, spaces);
    CHECK(spaces[0].order[0] == 1);
    CHECK(spaces[0].order[1] == 2);
}

TEST_CASE("files become time steps in the order of their times", "[nektarpp][data]") {
    const TemporaryFolder folder;
    const auto step = [&](const std::string& name, double value, const std::string& metadata, const std::string& modes = "1") {
        std::vector<double> coefficients(modes == "1" ? 10 : 270, 0.0);
        for (std::size_t at = 0; at < coefficients.size(); at += coefficients.size() / 10) {
            coefficients[at] = value;
        }
        const std::string per_direction = "UNIORDER:" + modes + "," + modes + "," + modes;
        return folder.write(
            name, nektar_writer::field_file(
                      {{"u", "Hexahedron", "Ortho_A,Ortho_A,Ortho_A", per_direction, "66-75", coefficients}}, metadata));
    };
    const double factor = std::pow(0.5, 1.5);
    const std::string late = step("a_10.chk", 10, "<Provenance><Hostname>h</Hostname></Provenance><Time>2.5</Time>", "3");
    const std::string early = step("a_2.chk", 2, "<Time>0.5</Time>");
    const std::string timeless = step("b.fld", 7, "");
    const SourceVolume source = open_nektar({cube(), late, early});
    CHECK(source.times() == std::vector<double>{0.5, 2.5});
    for (int repeat = 0; repeat < 2; ++repeat) {
        CHECK(value_at(source, 70, {0, 0, 0}, 0, 0) == Approx(2 * factor));
        CHECK(value_at(source, 70, {0, 0, 0}, 0, 1) == Approx(10 * factor));
    }
    // One space for all steps.
    std::vector<elvis_source_space> spaces(1);
    source.spaces(0, 70, 1, spaces);
    CHECK(spaces[0].order[0] == 2);
    CHECK(Converted(source, 0, 0).value(70, {0.1, 0.2, 0.3}) == Approx(2 * factor));
    CHECK(Converted(source, 0, 1).value(70, {0.1, 0.2, 0.3}) == Approx(10 * factor));
    CHECK(open_nektar({cube(), late, timeless}).times() == std::vector<double>{0, 1});
    CHECK(open_nektar({cube(), late}).times() == std::vector<double>{2.5});
    std::string old_text = read_file(late);
    const std::size_t first = old_text.find("<Metadata>"), last = old_text.find("</Metadata>") + 11;
    old_text.replace(first, last - first, R"(<FIELDMETADATA><P PARAM="Kinvis">1</P><P PARAM="Time">1.25</P></FIELDMETADATA>)");
    CHECK(open_nektar({cube(), folder.write("old.chk", old_text)}).times() == std::vector<double>{1.25});
    const std::string other = folder.write(
        "other.fld", nektar_writer::field_file({{"v", "Hexahedron", "Ortho_A,Ortho_A,Ortho_A", "UNIORDER:1,1,1", "66", {1}}}));
    CHECK_THAT(failure({cube(), late, other}), Contains("other.fld") && Contains("holds the fields v, the first time step u"));
}

TEST_CASE("partitions are one mesh and one field", "[nektarpp][data]") {
    const std::string whole = read_file(sample_file("Helmholtz3D_Prism_VarP.xml"));
    const std::size_t begin = whole.find("<ELEMENT>") + 9, end = whole.find("</ELEMENT>");
    const std::string elements = whole.substr(begin, end - begin);
    const std::size_t cut = elements.find("<R ID=\"7\"");
    REQUIRE(cut != std::string::npos);
    const auto with_elements = [&](const std::string& some) { return whole.substr(0, begin) + some + whole.substr(end); };
    const std::string fields = read_file(sample_file("Helmholtz3D_Prism_VarP.fld"));
    const SourceVolume reference =
        open_nektar({sample_file("Helmholtz3D_Prism_VarP.xml"), sample_file("Helmholtz3D_Prism_VarP.fld")});

    const TemporaryFolder folder;
    folder.write("m_xml/P0000000.xml", with_elements(elements.substr(0, cut)));
    folder.write("m_xml/P0000001.xml", with_elements(elements.substr(cut)));
    const Space space{Shape::prism, Basis::modified, {1, 1, 1}};
    const std::vector<double> first = random_numbers(7 * 6, 7), second = random_numbers(9 * 6, 8);
    const std::string basis = "Modified_A,Modified_A,Modified_B";
    folder.write("m.fld/P0000000.fld", nektar_writer::field_file({{"u", "Prism", basis, "UNIORDER:2,2,2", "0-6", first}}));
    folder.write("m.fld/P0000001.fld", nektar_writer::field_file({{"u", "Prism", basis, "UNIORDER:2,2,2", "7-15", second}}));
    const auto check = [&] {
        const SourceVolume source = open_nektar({folder.path("m_xml"), folder.path("m.fld")});
        CHECK(source.info().n_elements == 16);
        CHECK(source.boundary_groups() == reference.boundary_groups());
        for (std::uint64_t element = 0; element < 16; ++element) {
            for (const Point& xi : points_in(Shape::prism)) {
                CHECK(position_at(source, element, xi) == position_at(reference, element, xi));
            }
            const std::span<const double> of_part(element < 7 ? first : second);
            CHECK(largest_error(source, element, 0, space, of_part.subspan((element < 7 ? element : element - 7) * 6, 6)) <=
                  1e-14);
        }
        return source.times();
    };
    CHECK(check() == std::vector<double>{0});
    const std::string listed =
        R"(<NEKTAR><Metadata><Time>0.75</Time></Metadata><Partition FileName="P0000000.fld">0-6</Partition>
                                  <Partition FileName="P0000001.fld">7-15</Partition></NEKTAR>)";
    folder.write("m.fld/Info.xml", listed);
    CHECK(check() == std::vector<double>{0.75});
    folder.write("m.fld/Info.xml", R"(<NEKTAR><Partition FileName="../m.fld/P0000000.fld">0-6</Partition></NEKTAR>)");
    CHECK_THAT(failure({folder.path("m_xml"), folder.path("m.fld")}), Contains("Info.xml") && Contains("FileName"));
    // A mesh in parts with a field in one, whatever else lies there.
    folder.write("m_xml/P0000001.xml.info", "");
    CHECK_THAT(failure({folder.path("m_xml"), sample_file("Hex_CurvedFace.fld")}), Contains("element 0 is no hexahedron"));
}

TEST_CASE("fields of two dimensions are given", "[nektarpp]") {
    const bool is_triangle = GENERATE(true, false);
    const Shape shape = is_triangle ? Shape::triangle : Shape::quadrilateral;
    const nektar_writer::Element element{shape, [](const Point& xi) { return Point{2 * xi[0], xi[1], 0}; }, 0, {}, {}, 0, true,
                                         {}};
    const Basis basis = GENERATE(Basis::modified, Basis::orthogonal);
    const Space space{shape, basis, {3, 4, 0}};
    const std::vector<double> coefficients = random_numbers(native::n_modes(space), 9);
    const std::string family = basis == Basis::modified ? "Modified_" : "Ortho_";
    const TemporaryFolder folder;
    const SourceVolume source =
        open_nektar({folder.write("flat.xml", nektar_writer::geometry_file(element)),
                     folder.write("flat.fld", nektar_writer::field_file({{"u", is_triangle ? "Triangle" : "Quadrilateral",
                                                                          family + "A," + family + (is_triangle ? "B" : "A"),
                                                                          "UNIORDER:4,5", "7", coefficients}}))});
    CHECK(source.info().dimension == 2);
    CHECK(largest_error(source, 0, 0, space, coefficients) <= 1e-13);
    CHECK(position_at(source, 0, {-0.5, 0.25, 0}) == std::array<double, 3>{-1, 0.25, 0});
}
