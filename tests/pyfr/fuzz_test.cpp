// Damaged files are refused with a message or read; nothing crashes, hangs or takes gigabytes.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <tests/support/damage.hpp>

using namespace elvis::test;

TEST_CASE("damaged files are refused or read", "[pyfr][data][fuzz]") {
    const std::string version = GENERATE("2.1", "3.1", "develop");
    const std::string mesh = read_file(pyfr_data("mixed_" + version + ".pyfrm"));
    const std::string solution = read_file(pyfr_data("waves_" + version + ".pyfrs"));
    const TemporaryFolder folder;
    std::mt19937 random(20261126);
    std::array<int, 4> n_of{};
    for (int variant = 0; variant < 300; ++variant) {
        INFO("variant " << variant);
        const bool is_mesh = variant % 2 == 0;
        const std::string mesh_path = folder.write("damaged.pyfrm", is_mesh ? damaged(mesh, random) : mesh);
        const std::string solution_path = folder.write("damaged.pyfrs", is_mesh ? solution : damaged(solution, random));
        const Outcome result = outcome([&] { return open_pyfr({mesh_path, solution_path}); }, "damaged.");
        CHECK(is_right(result));
        ++n_of[static_cast<std::size_t>(result)];
    }
    std::printf("%-8s %d read, %d refused\n", version.c_str(), n_of[0], n_of[1]);
    CHECK(n_of[1] > 50);
}
