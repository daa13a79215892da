// Damaged VTKHDF files are refused with a message or read; nothing crashes, hangs or takes gigabytes.
#include "vtk_fixture.hpp"
#include "written_hexahedra.hpp"

#include <catch2/catch.hpp>
#include <tests/support/damage.hpp>

using namespace elvis::test;

TEST_CASE("damaged VTKHDF files are refused or read", "[vtk][fuzz]") {
    const TemporaryFolder folder;
    const Hexahedra cells{2, 3, equidistant_line(2)};
    HdfLayout layout;
    layout.times = {0, 1};
    write_vtkhdf(folder.path("steps.vtkhdf"), cells, layout);
    write_collection(folder.path("collection.vtkhdf"), cells, {});
    const std::array<std::string, 3> good{read_file(folder.path("steps.vtkhdf")), read_file(folder.path("collection.vtkhdf")),
                                          read_file(data_file("vtkhdf/lagrange_static.vtkhdf"))};
    std::mt19937 random(20261126);
    std::array<int, 4> n_of{};
    for (int variant = 0; variant < 900; ++variant) {
        INFO("variant " << variant);
        const std::string path = folder.write("damaged.vtkhdf", damaged(good[static_cast<std::size_t>(variant % 3)], random));
        const Outcome result = outcome([&] { return open_vtk({path}); }, "damaged.");
        CHECK(is_right(result));
        ++n_of[static_cast<std::size_t>(result)];
    }
    std::printf("%d read, %d refused\n", n_of[0], n_of[1]);
    CHECK(n_of[1] > 100);
}
