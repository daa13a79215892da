// Volumes with other elements, whose fields are found by place.

#include "some_volume.hpp"

#include <elvis/answers.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace elvis;
using test::convert_to;
using test::opened;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

/** Meshes of two shapes and orders, both of which hold x^2 y - z^2 + 0.3 exactly. */
std::string box(const char* shape, const char* elements, int order, const char* box = "[[-1, -1, -1], [1, 1, 1]]") {
    return std::string(R"({"generator": 1, "mesh": "box", "shape": ")") + shape + R"(", "elements": )" + elements +
           R"(, "box": )" + box + R"(, "order": )" + std::to_string(order) +
           R"(, "fields": [{"field": "polynomial", "name": "p", "coefficients": [[2, 1, 0, 1], [0, 0, 2, -1], [0, 0, 0, 0.3]]}]})";
}

scene showing(const context& library, const std::string& surface, const char* precision = "float64") {
    scene shown = library.make_scene();
    shown.set("/image/size", "[80, 60]");
    shown.set("/precision", "\"" + std::string(precision) + "\"");
    shown.set("/camera", R"({"eye": [2, -4, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 35})");
    shown.set("/surfaces/-", surface);
    return shown;
}

struct Values {
    double largest = 0;
    std::size_t n_hit = 0, n_nan = 0, n_flagged = 0;
};

Values values_of(const picture& drawn) {
    const std::vector<double> values = drawn.read<double>(ELVIS_CHANNEL_VALUE),
                              depths = drawn.read<double>(ELVIS_CHANNEL_DEPTH);
    const std::vector<std::uint32_t> flags = drawn.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS);
    Values found;
    for (std::size_t pixel = 0; pixel < values.size(); ++pixel) {
        if (std::isfinite(depths[pixel])) {
            ++found.n_hit;
            found.n_nan += std::isnan(values[pixel]) ? 1 : 0;
            found.n_flagged += (flags[pixel] & 16) != 0 ? 1 : 0;
            found.largest = std::isfinite(values[pixel]) ? std::max(found.largest, std::abs(values[pixel])) : found.largest;
        }
    }
    return found;
}

} // namespace

TEST_CASE("The difference of one polynomial on two meshes is rounding, on every kind of surface") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data one = opened(library, folder, "one.h5", box("mixed", "[4, 2, 2]", 3));
    const data other = opened(library, folder, "other.h5", box("tetrahedron", "[3, 3, 3]", 4));
    const data both = one.join({{"a", &other}});
    for (const char* const surface : {R"({"type": "plane", "plane": [0.3, 0.4, 1, 0.1], "field": "p - a.p"})",
                                      R"({"type": "boundary", "field": "p - a.p"})",
                                      R"({"type": "sphere", "center": [0.1, 0, 0], "radius": 0.7, "field": "p - a.p"})",
                                      R"({"type": "isosurface", "field": "p", "values": [0.2], "color_field": "p - a.p"})"}) {
        const Values found = values_of(both.render(showing(library, surface)));
        std::cout << surface << ": largest difference " << found.largest << " at " << found.n_hit << " pixels\n";
        CHECK(found.n_hit > 400);
        CHECK(found.n_nan == 0);
        CHECK(found.largest < 1e-13);
    }
    // A field of the other volume alone, in single precision, is that of this one.
    const picture theirs = both.render(showing(library, R"({"type": "boundary", "field": "a.p"})", "float32"));
    const picture ours = both.render(showing(library, R"({"type": "boundary", "field": "p"})", "float32"));
    const std::vector<double> here = ours.read<double>(ELVIS_CHANNEL_VALUE), there = theirs.read<double>(ELVIS_CHANNEL_VALUE);
    double largest = 0;
    for (std::size_t pixel = 0; pixel < here.size(); ++pixel) {
        largest = std::isfinite(here[pixel]) ? std::max(largest, std::abs(here[pixel] - there[pixel])) : largest;
    }
    std::cout << "single precision: values differ by " << largest << '\n';
    CHECK(largest < 1e-5);
}

TEST_CASE("Differences on two meshes are probed and integrated") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data one = opened(library, folder, "one.h5", box("hexahedron", "[2, 2, 2]", 3));
    const data other = opened(library, folder, "other.h5", box("prism", "[3, 2, 3]", 3));
    const data both = one.join({{"a", &other}});
    double largest = 0;
    for (int i = 0; i < 100; ++i) {
        const auto at = [i](int step) { return std::fmod(i * step * 0.0137, 1.9) - 0.95; };
        const std::vector<double> x{at(7), at(11), at(17)};
        const double exact = x[0] * x[0] * x[1] - x[2] * x[2] + 0.3;
        largest = std::max({largest, std::abs(both.probe(x, {"p - a.p"}).values[0]),
                            std::abs(both.probe(x, {"a.p"}).values[0] - exact),
                            std::abs(both.probe(x, {"d(a.p, x)"}).values[0] - 2 * x[0] * x[1])});
    }
    std::cout << "probed: off by " << largest << '\n';
    CHECK(largest < 1e-12);
    auto wanted = detail::sized<elvis_integration>();
    wanted.field = "a.p";
    const elvis_integral integral = both.integrate(wanted);
    // Over the box: -8/3 + 2.4.
    std::cout << "integral " << integral.value << ", off by " << std::abs(integral.value + 8.0 / 3 - 2.4) << ", error told "
              << integral.error << '\n';
    CHECK(std::abs(integral.value + 8.0 / 3 - 2.4) <= integral.error + 1e-12);
    CHECK(integral.is_exact == 0);
    CHECK(both.range("p - a.p").certainty == ELVIS_ESTIMATED);
}

TEST_CASE("Where the other volume is not, there is no value, and pixels say so") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data one = opened(library, folder, "one.h5", box("hexahedron", "[2, 2, 2]", 3));
    const data half = opened(library, folder, "half.h5", box("hexahedron", "[1, 3, 3]", 3, "[[0, -1, -1], [2, 1, 1]]"));
    const data both = one.join({{"a", &half}});
    const picture drawn = both.render(showing(library, R"({"type": "plane", "plane": [0, 0, 1, 0], "field": "p - a.p"})"));
    const Values found = values_of(drawn);
    CHECK(found.n_hit > 600);
    CHECK(found.n_nan > found.n_hit / 3);
    CHECK(found.n_nan < 2 * found.n_hit / 3);
    CHECK(found.n_flagged == found.n_nan);
    CHECK_THAT(drawn.stats(), Catch::Contains("\"nan_pixels\": " + std::to_string(found.n_nan)));
    CHECK(found.largest < 1e-13);
    CHECK(std::isnan(both.probe({-0.5, 0.1, 0.2}, {"a.p"}).values[0]));
    auto wanted = detail::sized<elvis_integration>();
    wanted.field = "a.p";
    CHECK_THROWS_WITH(both.integrate(wanted), Catch::Contains("outside of the volume"));
}

TEST_CASE("Where another value of a field that jumps in its own mesh would be as right, the pixel is undecided") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data one = opened(library, folder, "one.h5", box("hexahedron", "[3, 3, 3]", 3));
    convert_to(
        library, folder, "jumps.h5",
        R"({"generator": 1, "mesh": "box", "shape": "hexahedron", "elements": [2, 2, 2], "box": [[-1, -1, -1], [1, 1, 1]],
                   "order": 3, "fields": ["jump", {"field": "sphere", "name": "smooth", "continuity": "discontinuous"}]})");
    const data jumps = library.open(folder.path("jumps.h5"));
    const data both = one.join({{"a", &jumps}});
    const auto share_undecided = [&](const char* plane, const char* field, const char* precision) {
        const std::string surface = std::string(R"({"type": "plane", "plane": )") + plane + R"(, "field": ")" + field + R"("})";
        const picture drawn = both.render(showing(library, surface, precision));
        std::size_t n_undecided = 0;
        for (const std::uint32_t flags : drawn.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS)) {
            n_undecided += (flags & 256) != 0 ? 1 : 0;
        }
        const Values found = values_of(drawn);
        CHECK(found.n_hit > 600);
        return static_cast<double>(n_undecided) / static_cast<double>(found.n_hit);
    };
    for (const char* const precision : {"float32", "float64"}) {
        CAPTURE(precision);
        // A plane along faces of the other mesh alone.
        CHECK(share_undecided("[0, 0, 1, 0]", "p - a.jump", precision) > 0.99);
        CHECK(share_undecided("[0, 0, 1, 0]", "p - a.smooth", precision) < 0.01);
        CHECK(share_undecided("[0, 0.1, 1, 0.03]", "p - a.jump", precision) < 0.01);
    }
}

TEST_CASE("What is not certain between points is refused") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data one = opened(library, folder, "one.h5", box("hexahedron", "[2, 2, 2]", 3));
    const data other = opened(library, folder, "other.h5", box("prism", "[1, 1, 1]", 3));
    const data both = one.join({{"a", &other}});
    const auto refusal = [&](const std::string& surface, const char* key = nullptr, const char* value = nullptr) {
        scene shown = showing(library, surface);
        if (key != nullptr) {
            shown.set(key, value);
        }
        try {
            both.render(shown);
        } catch (const std::exception& reason) {
            return std::string(reason.what());
        }
        return std::string();
    };
    const auto by_place = Catch::Contains("by place in another volume");
    CHECK_THAT(refusal(R"({"type": "isosurface", "field": "p - a.p", "values": [0]})"), by_place);
    CHECK_THAT(refusal(R"({"type": "boundary", "field": "a.p", "contours": {"count": 3}})"), by_place);
    CHECK_THAT(refusal(R"({"type": "boundary", "field": "p"})", "/threshold", R"("a.p > 0")"), by_place);
    CHECK_THAT(refusal(R"({"type": "boundary", "field": "p"})", "/volume_rendering", R"({"field": "a.p"})"), by_place);
    CHECK_THAT(refusal(R"s({"type": "boundary", "field": "p", "lic": {"field": "a.p * grad(x) + grad(y)"}})s"), by_place);
    auto wanted = detail::sized<elvis_integration>();
    wanted.domain = ELVIS_DOMAIN_ISOSURFACE;
    wanted.level_field = "p - a.p";
    CHECK_THROWS_WITH(both.integrate(wanted), by_place);
}
