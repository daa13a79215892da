// Exodus II files of every kind of netCDF, written by its own library (write_samples.py), against closed forms.
#include <core/base/error.hpp>
#include <core/convert/convert.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <elvis/native/space.hpp>
#include <tests/support/asked_source.hpp>
#include <tests/support/damage.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>

using namespace elvis;
using Catch::Contains;
using elvis::test::all_elements;
using elvis::test::TemporaryFolder;

namespace {

SourceVolume open_exodus(const std::vector<std::string>& paths) {
    static const auto plugin = Plugin::load(EXODUS_PLUGIN);
    return SourceVolume(plugin, paths);
}

std::string data(const std::string& name) { return elvis::test::data_file("exodus/" + name); }

std::string failure(const std::vector<std::string>& paths) {
    try {
        open_exodus(paths);
    } catch (const Error& error) {
        return error.what();
    }
    return "no failure";
}

/** As write_samples.py has it. */
double quadratic(const double* s, std::size_t dimension) {
    const double last = s[dimension - 1];
    return s[0] * s[0] - 0.5 * s[0] * s[1] + 0.25 * last * last + s[1] * last;
}

/** Which blocks have elements of order 2. */
bool is_bent(std::size_t block, std::size_t dimension) {
    constexpr bool solid[] = {false, true, true, false, true, false, true, true, false, true, true};
    constexpr bool flat[] = {false, true, true, false, true};
    return dimension == 3 ? solid[block] : flat[block];
}

/** Inside the shape, as a share of the corners. */
native::Point point_inside(native::Shape shape, std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.05, 1);
    native::Point xi{};
    double sum = 0;
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        const double weight = share(random);
        const native::Point at = native::corner(shape, corner);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            xi[axis] += weight * at[axis];
        }
        sum += weight;
    }
    for (double& coordinate : xi) {
        coordinate /= sum;
    }
    return xi;
}

/** Largest error of positions and values of a file at a step. */
double largest_error(const SourceVolume& source, std::uint32_t step) {
    const double time = source.times()[step];
    const std::size_t dimension = source.info().dimension;
    const auto elements = all_elements(source);
    std::mt19937 random(3);
    double largest = 0;
    for (std::size_t element = 0; element < elements.size(); ++element) {
        for (int i = 0; i < 20; ++i) {
            const native::Point xi = point_inside(static_cast<native::Shape>(elements[element].shape), random);
            std::vector<double> values(source.n_values());
            std::array<double, 3> x{};
            source.evaluate_mapping(element, xi, x);
            source.sample(step, element, xi, values);
            const double* const s = &values[1];
            const double bend = is_bent(element, dimension) ? quadratic(s, dimension) : 0;
            const double linear = 1 + s[0] - 2 * s[1] + (dimension == 3 ? 0.5 * s[2] : 0);
            const double size = 1 + std::abs(linear + bend);
            largest = std::max(largest, std::abs(values[0] - (1 + time) * (linear + bend)) / size);
            for (std::size_t axis = 0; axis < dimension; ++axis) {
                const double expected = s[axis] + (axis + 1 == dimension ? 0.1 * bend : 0);
                largest = std::max(largest, std::abs(x[axis] - expected) / (1 + std::abs(expected)));
            }
            const double quality = values[1 + dimension], material = values[2 + dimension];
            largest = std::max(largest, std::abs(quality - (10 * static_cast<double>(element + 1) + time)));
            if (element == 1) {
                CHECK(std::isnan(material));
            } else {
                largest = std::max(largest, std::abs(material - (10 * static_cast<double>(element + 1) + 1 + time)));
            }
        }
    }
    return largest;
}

} // namespace

TEST_CASE("elements of every type have their positions and values, in every kind of netCDF", "[exodus]") {
    for (const char* const name : {"solid.e", "solid_64bit.e", "solid_data64.e", "solid_netcdf4.exo", "flat.e"}) {
        const auto source = open_exodus({data(name)});
        REQUIRE(source.times() == std::vector<double>{0, 0.5, 2});
        std::vector<std::string> fields;
        for (const auto& field : source.fields()) {
            fields.push_back(field.name + " " + std::to_string(field.n_components));
        }
        const bool is_flat = std::string(name) == "flat.e";
        CHECK(fields == std::vector<std::string>{"u 1", is_flat ? "s 2" : "s 3", "quality 1", "material 1"});
        CHECK(source.info().n_elements == (is_flat ? 5 : 11));
        double error = 0;
        for (const std::uint32_t step : {0u, 2u, 1u}) {
            error = std::max(error, largest_error(source, step));
        }
        std::cout << name << ": largest error " << error << '\n';
        CHECK(error < 1e-12);
    }
}

TEST_CASE("conversion is exact, and sides become groups", "[exodus]") {
    const TemporaryFolder folder;
    for (const char* const name : {"solid.e", "flat.e"}) {
        const auto source = open_exodus({data(name)});
        const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
        CHECK(report.geometry_exact);
        for (const FieldReport& field : report.fields) {
            // A field that is not there in a block is not a number.
            CHECK((field.exact || field.name == "material"));
        }
        CHECK(source.boundary_groups() == std::vector<std::string>{"wall", "side set 8"});
        for (const elvis_source_element& element : all_elements(source)) {
            CHECK(std::ranges::count(element.face_groups, 0) == 1);
            CHECK(std::ranges::count(element.face_groups, 1) == 1);
        }
    }
    // Side 1 of the first hexahedron is where the second coordinate is least, side 3 where it is largest.
    const auto source = open_exodus({data("solid.e")});
    const elvis_source_element first = all_elements(source).front();
    for (int face = 0; face < 6; ++face) {
        double second = 0;
        for (const int corner : native::face_corners(native::Shape::hexahedron, face)) {
            second += 0.25 * native::corner(native::Shape::hexahedron, corner)[1];
        }
        CHECK(first.face_groups[face] == (second == -1 ? 0 : second == 1 ? 1 : ELVIS_GROUP_NONE));
    }
}

TEST_CASE("one part stands for all that a parallel program has written", "[exodus]") {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& named :
         {std::vector{data("cubes.e.2.1")}, std::vector{data("cubes.e.2.0"), data("cubes.e.2.1")}}) {
        const auto source = open_exodus(named);
        CHECK(source.info().n_elements == 2);
        CHECK(source.boundary_groups() == std::vector<std::string>{"inlet", "outlet"});
        const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
        CHECK(report.geometry_exact);
        // They are joined where they meet: five outer faces each.
        CHECK(report.n_boundary_faces == 10);
        CHECK(report.n_unknown_faces == 0);
        REQUIRE(report.fields.size() == 2);
        CHECK((report.fields[0].exact && report.fields[0].max_jump < 1e-14));
        CHECK((report.fields[1].name == "rank" && report.fields[1].lower == 0 && report.fields[1].upper == 1));
        const auto elements = all_elements(source);
        CHECK(std::ranges::count(elements[0].face_groups, 0) == 1);
        CHECK(std::ranges::count(elements[1].face_groups, 1) == 1);
        CHECK(std::ranges::count(elements[1].face_groups, 0) == 0);
    }
    const std::string part = test::read_file(data("cubes.e.2.0"));
    CHECK_THAT(failure({folder.write("alone.e.2.0", part)}), Contains("alone.e.2.1") && Contains("part 1 of 2"));
    std::string other = test::read_file(data("cubes.e.2.1"));
    other.replace(other.find("rank"), 4, "site");
    folder.write("mixed.e.2.0", part);
    CHECK_THAT(failure({folder.write("mixed.e.2.1", other)}), Contains("mixed.e.2.1") && Contains("variables"));
}

TEST_CASE("what cannot be read is refused with a reason", "[exodus]") {
    const TemporaryFolder folder;
    const std::string whole = test::read_file(data("solid.e"));
    CHECK_THAT(failure({data("solid.e"), data("flat.e")}), Contains("no part of the data set"));
    const auto with = [&](std::string text, const std::string& what, const std::string& by) {
        const std::size_t at = text.find(what);
        REQUIRE(at != std::string::npos);
        return failure({folder.write("changed.e", text.replace(at, what.size(), by))});
    };
    CHECK_THAT(with(whole, "TETRA10", "NSIDED7"), Contains("NSIDED7") && Contains("changed.e"));
    CHECK_THAT(with(whole, "TETRA10", "QUAD810"), Contains("10 nodes"));
    CHECK_THAT(with(whole, "num_nodes", "num_modes"), Contains("num_nodes"));
    CHECK_THAT(with(whole, "coordy", "coordq"), Contains("coordy"));
    CHECK_THAT(failure({folder.write("short.e", whole.substr(0, whole.size() - 5000))}), Contains("short.e"));
}

TEST_CASE("damaged files are refused or read", "[exodus][fuzz]") {
    const std::string name = GENERATE("solid.e", "solid_64bit.e", "solid_data64.e", "solid_netcdf4.exo");
    const std::string whole = test::read_file(data(name));
    const TemporaryFolder folder;
    std::mt19937 random(20261126);
    std::array<int, 4> n_of{};
    for (int variant = 0; variant < 300; ++variant) {
        INFO("variant " << variant);
        const std::string path = folder.write("damaged.e", test::damaged(whole, random));
        const test::Outcome result = test::outcome([&] { return open_exodus({path}); }, "damaged.");
        CHECK(test::is_right(result));
        ++n_of[static_cast<std::size_t>(result)];
    }
    std::printf("%-18s %d read, %d refused\n", name.c_str(), n_of[0], n_of[1]);
    CHECK(n_of[1] > 50);
}
