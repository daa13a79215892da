// Partitions that a file gives.
#include "parts_fixture.hpp"

#include <core/parts/partition_file.hpp>
#include <tests/support/error_of.hpp>

#include <catch2/catch.hpp>

using namespace elvis;
using namespace elvis::test;

TEST_CASE("A file gives each element its part, by the element's number") {
    const Stage stage(
        R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "order": 1, "field": "waves"})");
    const RuntimeVolume& volume = stage.volume();
    const TemporaryFolder folder;
    const auto read = [&](const std::string& text) {
        folder.write("parts", text);
        return read_partition(folder.path("parts"), volume);
    };
    std::string text;
    for (std::uint64_t number = 0; number < volume.n_elements(); ++number) {
        text += std::to_string(2 * (number % 3)) + "\n";
    }
    const Partition partition = read(text);
    REQUIRE(partition.n_parts() == 5);
    std::uint64_t n = 0;
    for (std::uint32_t part = 0; part < 5; ++part) {
        const std::vector<std::uint64_t> elements = partition.elements(part);
        CHECK(partition.n_elements(part) == elements.size());
        CHECK(std::ranges::is_sorted(elements));
        n += elements.size();
        for (const std::uint64_t element : elements) {
            std::int64_t number = -1;
            volume.element_numbers(element, 1, std::span(&number, 1));
            CHECK(2 * (number % 3) == part);
        }
    }
    CHECK(n == volume.n_elements());
    CHECK(partition.n_elements(1) == 0);
    // Those that are wrong are told.
    const auto error = [&](const std::string& wrong) { return error_of([&] { read(wrong); }); };
    CHECK(error("0 1 2").find("has 3 numbers; the volume has") != std::string::npos);
    CHECK(error(text + "1\n").find("has more numbers") != std::string::npos);
    CHECK(error("0 1 -2").find("number 3 is '-2'") != std::string::npos);
    CHECK(error("0 1000000").find("number 2 is '1000000'") != std::string::npos);
    CHECK(error("0 x").find("number 2 is 'x'") != std::string::npos);
    CHECK(error_of([&] { read_partition("nowhere", volume); }).find("nowhere: there is no such file") != std::string::npos);
}
