// format.md suffices to write a volume: one written by a short Python program is read.
#include "volume_fixture.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace elvis::native;

TEST_CASE("A volume written with h5py is read") {
    const std::string python = "/usr/bin/python3";
    if (std::system((python + " -c 'import h5py' 2> /dev/null").c_str()) != 0) {
        WARN("skipped: no Python with h5py");
        return;
    }
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    REQUIRE(std::system((python + " " ELVIS_NATIVE_TESTS "/write_volume.py " + path).c_str()) == 0);
    const VolumeData data = read_all(path);
    const Description& d = data.description;
    CHECK(d.times == std::vector<double>{0.5});
    CHECK(d.fields[0].name == "s");
    CHECK(d.boundary_groups == std::vector<std::string>{"wall"});
    CHECK(d.notes[0] == std::pair<std::string, std::string>{"created with", "h5py"});
    REQUIRE(d.classes.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const Space& geometry = d.classes[i].geometry;
        const std::size_t n = n_modes(geometry);
        for (int c = 0; c < n_corners(geometry.shape); ++c) {
            const Point xi = corner(geometry.shape, c);
            Point x{};
            for (std::size_t direction = 0; direction < 3; ++direction)
                x[direction] = evaluate(geometry, std::span(data.geometry[i]).subspan(direction * n, n), xi);
            const Point unit{(1 + xi[0]) / 2, (1 + xi[1]) / 2, (1 + xi[2]) / 2};
            const bool brick = geometry.shape == Shape::hexahedron;
            CHECK(x == (brick ? Point{2 + unit[0], unit[1], 4 * unit[2]} : unit));
            CHECK(evaluate(d.classes[i].fields[0], data.fields[0][0][i], xi) == x[0] + 2 * x[1] + 3 * x[2]);
        }
    }
}
