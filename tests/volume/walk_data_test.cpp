// Neighbours across faces, and the elements in which rays can start.
#include <tests/support/test_volumes.hpp>

#include <core/volume/segments/face_links.hpp>
#include <core/volume/segments/walk_data.hpp>
#include <elvis/native/space.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <optional>
#include <string>

namespace elvis::oracle {
namespace {

std::size_t n_open_faces(const std::vector<std::uint32_t>& links, const ClassInfo& info, std::uint64_t element) {
    const auto begin = links.begin() + static_cast<std::ptrdiff_t>(links_an_element * element);
    return static_cast<std::size_t>(std::count(begin, begin + native::n_faces(native::Shape{info.shape}), no_link));
}

/** A box of so many elements along each side, and where rays start in it. */
struct Box {
    explicit Box(int elements) {
        generate(R"({"generator": 1, "mesh": "box", "order": 1, "field": "waves", "elements": )" + std::to_string(elements) +
                     "}",
                 file.path());
        volume.emplace(open_volume(file.path()));
        data.emplace(device, *volume, Precision::float32, nullptr);
        data->select(0, 0, {0});
        walk_data.emplace(device, *volume, *data);
    }

    std::uint64_t n_starts(const ViewStart& view) {
        walk_data->look_from(view);
        return walk_data->n_starts(0);
    }

    TemporaryFile file{"box.h5"};
    std::optional<RuntimeVolume> volume;
    Device device;
    std::optional<DeviceVolume> data;
    std::optional<WalkData> walk_data;
};

} // namespace

TEST_CASE("elements in a row are linked to those beside them") {
    const TemporaryFile file("row.h5");
    generate(R"({"generator": 1, "mesh": "box", "elements": [3, 1, 1], "order": 1, "field": "waves"})", file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const std::vector<std::uint32_t> links = read_face_links(volume).at(0);
    const ClassInfo& info = volume.classes()[0];
    REQUIRE(links.size() == 3 * links_an_element);
    CHECK(n_open_faces(links, info, 0) == 5);
    CHECK(n_open_faces(links, info, 1) == 4);
    CHECK(n_open_faces(links, info, 2) == 5);
    CHECK(std::count(links.begin() + links_an_element, links.begin() + 2 * links_an_element, 0u) == 1);
    CHECK(std::count(links.begin() + links_an_element, links.begin() + 2 * links_an_element, 2u) == 1);
}

TEST_CASE("links lead back, from one element class to another too") {
    const TemporaryFile file("ball.h5");
    generate(
        R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "layers": 2, "order": 1, "field": "waves"})",
        file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const std::vector<std::vector<std::uint32_t>> links = read_face_links(volume);
    REQUIRE(volume.classes().size() > 1);
    std::size_t n_links = 0, n_lost = 0, n_others = 0;
    for (std::size_t index = 0; index < links.size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        for (std::uint64_t element = 0; element < info.n_elements; ++element) {
            CHECK(has_open_face(links[index], info, element) == (n_open_faces(links[index], info, element) > 0));
            for (int face = 0; face < native::n_faces(native::Shape{info.shape}); ++face) {
                const std::uint32_t link = links[index][links_an_element * element + face];
                if (link == no_link) {
                    continue;
                }
                n_links += 1;
                for (std::size_t other = 0; other < links.size(); ++other) {
                    const ClassInfo& there = volume.classes()[other];
                    if (link < there.first_element || link - there.first_element >= there.n_elements) {
                        continue;
                    }
                    const auto begin =
                        links[other].begin() + static_cast<std::ptrdiff_t>(links_an_element * (link - there.first_element));
                    n_lost +=
                        std::find(begin, begin + links_an_element, info.first_element + element) == begin + links_an_element;
                    n_others += other != index;
                }
            }
        }
    }
    CHECK(n_links > 100);
    CHECK(n_lost == 0);
    CHECK(n_others > 0);
}

TEST_CASE("rays start in elements with an open face, and around the eye") {
    Box box(3);
    CHECK(box.n_starts({{4, 3, 2}, {}}) == 26);
    CHECK(box.n_starts({{0.05, -0.1, 0.02}, {}}) == 27);
    // In a corner element, which has open faces anyway.
    CHECK(box.n_starts({{0.9, 0.9, 0.9}, {}}) == 26);
    // Planes across a parallel view: through the middle, and beside it.
    CHECK(box.n_starts({{0, 0, 0}, {{1, 0, 0}}}) == 27);
    CHECK(box.n_starts({{0.5, 0, 0}, {{1, 0, 0}}}) == 26);
}

TEST_CASE("where elements are left out, rays start beside them") {
    Box box(5);
    const ViewStart outside{{9, 0, 0}, {}};
    CHECK(box.n_starts(outside) == 125 - 27);
    // The one in the middle: its six neighbours have an open face now.
    std::vector<bool> kept(125, true);
    kept[62] = false;
    box.walk_data->keep_only({kept});
    CHECK(box.n_starts(outside) == 125 - 27 + 6);
    box.walk_data->look_from_anywhere();
    CHECK(box.walk_data->n_starts(0) == 124);
    box.walk_data->keep_only({});
    CHECK(box.n_starts(outside) == 125 - 27);
}

} // namespace elvis::oracle
