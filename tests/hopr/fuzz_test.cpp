// Damaged files are refused with a message or read; nothing crashes, hangs or takes gigabytes.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>
#include <tests/support/damage.hpp>

using namespace elvis::test;

TEST_CASE("damaged files are refused or read", "[hopr][fuzz]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), mortar());
    WrittenState written;
    written.line = {-0.5, 0.5};
    written.value = [](std::size_t variable, std::size_t element, const std::array<double, 3>& xi) {
        return static_cast<double>(variable + element) + xi[0];
    };
    written.added_names = {"FV_Elems", "dt"};
    written.added.assign(5, {0, 1});
    write_state(folder.path("state.h5"), mortar(), written);
    const std::string mesh = read_file(folder.path("mesh.h5")), state = read_file(folder.path("state.h5"));
    std::mt19937 random(20261126);
    std::array<int, 4> n_of{};
    for (int variant = 0; variant < 600; ++variant) {
        INFO("variant " << variant);
        const bool is_mesh = variant % 2 == 0;
        const std::string mesh_path = folder.write("damaged.mesh.h5", is_mesh ? damaged(mesh, random) : mesh);
        const std::string state_path = folder.write("damaged.state.h5", is_mesh ? state : damaged(state, random));
        const Outcome result = outcome([&] { return open_hopr({mesh_path, state_path}); }, "damaged.");
        CHECK(is_right(result));
        ++n_of[static_cast<std::size_t>(result)];
    }
    std::printf("%d read, %d refused\n", n_of[0], n_of[1]);
    CHECK(n_of[1] > 100);
}
