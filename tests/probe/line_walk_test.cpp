// Where lines enter and leave elements, against known meshes and against dense probing.
#include <tests/support/test_volumes.hpp>

#include <core/base/error.hpp>
#include <core/probe/line_walk.hpp>
#include <core/probe/probe.hpp>

#include <catch2/catch.hpp>

#include <cmath>

namespace elvis::oracle {
namespace {

struct Generated {
    explicit Generated(const std::string& keys) {
        generate(R"({"generator": 1, "field": "jump", )" + keys + "}", file.path());
        volume.emplace(open_volume(file.path()));
    }
    TemporaryFile file{"walked.h5"};
    std::optional<RuntimeVolume> volume;
};

Vector3 position_of(const RuntimeVolume& volume, const ReferencePoint& point) {
    Vector3 position{};
    volume.evaluate_mapping(point.element, point.xi, position, {});
    return position;
}

} // namespace

TEST_CASE("a line through a box meets its faces where they are, and knows what is outside") {
    const Generated box(R"("mesh": "box", "elements": [4, 1, 1])");
    const std::vector<LineBreak> breaks = walk_line(*box.volume, {-2, 0.1, 0.2}, {2, 0.1, 0.2});
    REQUIRE(breaks.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(breaks[i].parameter == Approx(0.25 + 0.125 * static_cast<double>(i)).margin(1e-14));
        CHECK(breaks[i].before.has_value() == (i > 0));
        CHECK(breaks[i].after.has_value() == (i < 4));
    }
    CHECK(breaks[1].before->xi[0] == Approx(1).margin(1e-12));
    CHECK(breaks[1].after->xi[0] == Approx(-1).margin(1e-12));
    // It begins and ends in elements.
    const std::vector<LineBreak> inside = walk_line(*box.volume, {-0.8, 0.1, 0.2}, {-0.2, 0.1, 0.2});
    REQUIRE(inside.size() == 3);
    CHECK_FALSE(inside[0].before);
    CHECK(inside[0].parameter == 0);
    CHECK_FALSE(inside[2].after);
    CHECK(inside[2].parameter == 1);
    CHECK(walk_line(*box.volume, {-2, 3, 0}, {2, 3, 0}).empty());
    // In a face between elements, and along an edge of the box.
    CHECK(walk_line(*box.volume, {0, -2, 0.1}, {0, 2, 0.1}).size() == 2);
    CHECK(walk_line(*box.volume, {-2, 1, 1}, {2, 1, 1}).size() == 5);
}

TEST_CASE("lines through bent elements of every shape are in the elements that probing finds") {
    const std::string shape = GENERATE("hexahedron", "prism", "pyramid", "tetrahedron", "mixed");
    const Generated shell(R"("mesh": "shell", "elements": 2, "geometry_order": 3, "shape": ")" + shape + "\"");
    const RuntimeVolume& volume = *shell.volume;
    const Vector3 from{-1.2, -0.31, 0.17}, to{1.1, 0.43, -0.09};
    const std::vector<LineBreak> breaks = walk_line(volume, from, to);
    REQUIRE(breaks.size() >= 4);
    std::size_t n_gaps = 0;
    double largest = 0;
    for (std::size_t i = 0; i < breaks.size(); ++i) {
        const Vector3 place = plus(scaled(from, 1 - breaks[i].parameter), scaled(to, breaks[i].parameter));
        for (const std::optional<ReferencePoint>& side : {breaks[i].before, breaks[i].after}) {
            largest = side ? std::max(largest, length(minus(position_of(volume, *side), place))) : largest;
        }
        REQUIRE((i == 0 || breaks[i].parameter > breaks[i - 1].parameter));
        const bool goes_on = i > 0 && breaks[i - 1].after.has_value();
        REQUIRE(breaks[i].before.has_value() == goes_on);
        REQUIRE((!goes_on || breaks[i].before->element == breaks[i - 1].after->element));
        n_gaps += i > 0 && !goes_on;
    }
    // Through the hollow of the shell.
    CHECK(n_gaps == 1);
    INFO(shape << ": places off by " << largest);
    CHECK(largest < 1e-12);

    std::vector<Vector3> positions;
    constexpr int n = 4000;
    for (int i = 0; i <= n; ++i) {
        positions.push_back(plus(scaled(from, 1 - static_cast<double>(i) / n), scaled(to, static_cast<double>(i) / n)));
    }
    const std::vector<ProbedPoint> points = Prober(volume).probe(positions, 0);
    std::size_t next = 0;
    for (int i = 0; i <= n; ++i) {
        const double t = static_cast<double>(i) / n;
        while (next < breaks.size() && breaks[next].parameter < t) {
            ++next;
        }
        const std::optional<ReferencePoint> side = next > 0 ? breaks[next - 1].after : std::nullopt;
        std::int64_t number = -1;
        if (side) {
            volume.element_numbers(side->element, 1, {&number, 1});
        }
        INFO(shape << ", parameter " << t);
        CHECK(points[static_cast<std::size_t>(i)].element.value_or(-1) == number);
    }
}

} // namespace elvis::oracle
