// Planes through strongly bent elements, in which Newton's method can take points for outside.
#include <core/oracle/element/volume.hpp>
#include <core/oracle/picture/view.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

namespace elvis::oracle {

TEST_CASE("a plane has no hole in strongly bent pyramids") {
    const TemporaryFile file("torus.h5");
    generate(R"({"generator": 1, "mesh": "torus", "shape": "pyramid", "elements": [3, 1, 4], "layers": 2,
                 "geometry_order": 4, "order": 2, "field": "polynomial"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(read_volume(file.path()));
    const FrameRequest request = view_of(model, CutPlane{{0.03, 0.02, 1, 0.05}}, 80, 80, 0, 3);
    const Picture exact = draw(model, request);
    constexpr std::uint32_t unsure = pixel_flag::newton_failure | pixel_flag::undecided;
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const Frame frame = Renderer(device(), volume, precision).render(request);
        std::size_t n_holes = 0, n_flagged = 0;
        for (std::size_t pixel = 0; pixel < frame.element.size(); ++pixel) {
            n_flagged += (frame.flags[pixel] & unsure) != 0;
            n_holes += exact.is_inside[pixel] != 0 && frame.element[pixel] < 0 && (frame.flags[pixel] & unsure) == 0;
        }
        INFO(name_of(precision));
        CHECK(n_holes == 0);
        CHECK(n_flagged < frame.element.size() / 50);
    }
}

} // namespace elvis::oracle
