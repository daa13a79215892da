// Parts as volumes: their elements, numbers and faces.

#include "parts_fixture.hpp"

#include <core/parts/part_volume.hpp>
#include <core/parts/partition.hpp>
#include <tests/support/error_of.hpp>

#include <catch2/catch.hpp>

using namespace elvis;
using namespace elvis::test;

namespace {

constexpr const char* mixed =
    R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "order": 2, "fields": ["waves", "element"]})";

std::vector<double> boxes_of(const RuntimeVolume& volume) {
    std::vector<double> boxes(6 * volume.n_elements());
    volume.bounds(0, volume.n_elements(), boxes);
    return boxes;
}

RuntimeVolume open_part(const Stage& stage, std::span<const std::uint64_t> elements) {
    return serve_native(std::make_shared<const PartVolume>(stage.source(), by_class(stage.volume(), elements)), "part",
                        nullptr);
}

} // namespace

TEST_CASE("Shares cover all in their order, as equal as can be") {
    for (const std::uint64_t n : {0, 1, 7, 64}) {
        std::uint64_t end = 0;
        for (std::uint32_t index = 0; index < 5; ++index) {
            const Span one = share(n, 5, index);
            CHECK(one.first == end);
            CHECK((one.size() == n / 5 || one.size() == n / 5 + 1));
            end = one.end;
        }
        CHECK(end == n);
    }
}

TEST_CASE("A part has the bounds, values and numbers that its elements have in the whole") {
    const Stage stage(mixed);
    const RuntimeVolume& whole = stage.volume();
    const std::vector<std::uint64_t> own = Partition::in_shares(whole.n_elements(), 4).elements(2);
    const std::vector<std::uint64_t> elements = with_surroundings(boxes_of(whole), own);
    REQUIRE(elements.size() > own.size());
    REQUIRE(elements.size() < whole.n_elements());
    const RuntimeVolume part = open_part(stage, elements);
    REQUIRE(part.n_elements() == elements.size());
    REQUIRE(part.classes().size() == whole.classes().size());
    const std::vector<double> all = boxes_of(whole), few = boxes_of(part);
    const std::vector<double> xi{-0.5, -0.6, -0.4};
    for (std::size_t at = 0; at < elements.size(); ++at) {
        CHECK(std::equal(&few[6 * at], &few[6 * at] + 6, &all[6 * elements[at]]));
        std::int64_t number = -1, expected = -2;
        part.element_numbers(at, 1, std::span(&number, 1));
        whole.element_numbers(elements[at], 1, std::span(&expected, 1));
        CHECK(number == expected);
        double value = 0, wanted = 1;
        part.evaluate_field(0, 0, at, xi, std::span(&value, 1), {});
        whole.evaluate_field(0, 0, elements[at], xi, std::span(&wanted, 1), {});
        CHECK(value == wanted);
    }
}

TEST_CASE("Elements around a part are all that share a point with it") {
    const Stage stage(R"({"generator": 1, "mesh": "box", "elements": 5, "field": "sphere"})");
    const RuntimeVolume& whole = stage.volume();
    // One in the middle, and the 26 around it.
    std::vector<std::int64_t> numbers(whole.n_elements());
    whole.element_numbers(0, numbers.size(), numbers);
    const auto middle = static_cast<std::uint64_t>(std::ranges::find(numbers, 2 + 5 * 2 + 25 * 2) - numbers.begin());
    const std::vector<std::uint64_t> elements = with_surroundings(boxes_of(whole), std::array{middle});
    CHECK(elements.size() == 27);
}

TEST_CASE("Faces between parts are no boundary, and the boundary is that of the whole") {
    const Stage stage(mixed);
    const RuntimeVolume& whole = stage.volume();
    const auto n_boundary = [](const RuntimeVolume& volume) {
        std::vector<elvis_face> faces(volume.n_faces());
        volume.faces(0, faces.size(), faces);
        return std::ranges::count_if(faces, [](const elvis_face& face) { return face.neighbour == ELVIS_NEIGHBOUR_NONE; });
    };
    std::ptrdiff_t n = 0;
    std::uint64_t n_unknown = 0;
    for (std::uint32_t index = 0; index < 5; ++index) {
        const Span own = share(whole.n_elements(), 5, index);
        std::vector<std::uint64_t> elements(own.size());
        std::iota(elements.begin(), elements.end(), own.first);
        const RuntimeVolume part = open_part(stage, elements);
        n += n_boundary(part);
        std::vector<elvis_face> faces(part.n_faces());
        part.faces(0, faces.size(), faces);
        for (const elvis_face& face : faces) {
            CHECK(face.element >= 0);
            CHECK(static_cast<std::uint64_t>(face.element) < part.n_elements());
            n_unknown += face.neighbour == ELVIS_NEIGHBOUR_UNKNOWN ? 1 : 0;
        }
    }
    CHECK(n == n_boundary(whole));
    CHECK(n_unknown > 0);
    // Each of them is a face of two parts.
    CHECK(n_unknown % 2 == 0);
}

TEST_CASE("What cannot be drawn in parts is refused") {
    Stage stage(R"({"generator": 1, "mesh": "box", "elements": 2, "fields": ["sphere", "taylor-green"], "order": 3})");
    const auto refused = [&](const std::string& keys) {
        return error_of([&] { stage.in_parts(stage.scene(keys), 2); }).find("cannot be drawn in parts yet") !=
               std::string::npos;
    };
    CHECK(refused(R"("surfaces": [{"type": "boundary", "opacity": 0.5, "lic": {"field": "velocity"}}])"));
    CHECK(refused(R"("threshold": "sphere > 0.2", "lic": {"field": "velocity"})"));
    CHECK(refused(R"("surfaces": [{"type": "boundary", "clip": [[1, 0, 0, 0]], "lic": {"field": "velocity"}}])"));
    // Not a part alone, but the whole has none.
    const std::string keys = R"("surfaces": [{"type": "elements", "shapes": ["prism"]}])";
    CHECK(error_of([&] { stage.in_parts(stage.scene(keys), 2); }).find("no such faces of elements") != std::string::npos);
}
