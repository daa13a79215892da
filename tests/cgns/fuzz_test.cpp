// Damaged files are refused with a message or read; nothing crashes, hangs or takes gigabytes.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <tests/support/damage.hpp>

using namespace elvis::test;

TEST_CASE("damaged files are refused or read", "[cgns][fuzz]") {
    const std::string container = GENERATE("hdf5", "adf");
    const std::string kind = GENERATE("structured", "boundaries", "rind");
    const TemporaryFolder folder;
    const std::string good = read_file(write_cgns(folder, kind, container));
    std::mt19937 random(20261126);
    std::array<int, 4> n_of{};
    for (int variant = 0; variant < 250; ++variant) {
        INFO(kind << ", " << container << ", variant " << variant);
        const std::string path = folder.write("damaged.cgns", damaged(good, random));
        const Outcome result = outcome([&] { return open_cgns({path}); }, "damaged.");
        CHECK(is_right(result));
        ++n_of[static_cast<std::size_t>(result)];
    }
    std::printf("%-10s %-4s %d read, %d refused\n", kind.c_str(), container.c_str(), n_of[0], n_of[1]);
    CHECK(n_of[1] > 25);
}

constexpr std::size_t adf_block = 4096;

TEST_CASE("files that are cut off are refused", "[cgns][fuzz]") {
    const std::string container = GENERATE("hdf5", "adf");
    const TemporaryFolder folder;
    const std::string good = read_file(write_cgns(folder, "boundaries", container));
    for (std::size_t size = 0; size + 1 < good.size(); size += good.size() / 97) {
        INFO(container << " cut to " << size);
        const std::string path = folder.write("damaged.cgns", good.substr(0, size));
        const Outcome result = outcome([&] { return open_cgns({path}); }, "damaged.");
        // The last block of ADF files is filled with what nobody needs.
        const bool has_all = container == "adf" && size > good.size() - adf_block;
        CHECK((result == Outcome::refused || (has_all && result == Outcome::read)));
    }
}
