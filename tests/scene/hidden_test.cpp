// Scenes of which nothing is shown.

#include "fixture.hpp"
#include "stage.hpp"

using namespace elvis;
using namespace elvis::test;

TEST_CASE("Where everything is hidden the background is seen") {
    Stage stage;
    FrameRequest request = stage.request(R"("image": {"size": [30, 20], "background": [0.1, 0.2, 0.3, 0.4]},
        "volume_rendering": {"visible": false}, "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0], "visible": false}])");
    CHECK(request.surfaces.empty());
    CHECK_FALSE(request.volume);
    for (const bool with_buffers : {true, false}) {
        request.with_buffers = with_buffers;
        const Frame frame = stage.renderer.render(request);
        REQUIRE((frame.width == 30 && frame.height == 20));
        REQUIRE(frame.color.size() == 4 * 600);
        for (std::size_t i = 0; i < frame.color.size(); ++i) {
            REQUIRE(frame.color[i] == Approx(0.1 * static_cast<double>(1 + i % 4)));
        }
        CHECK(frame.value.size() == (with_buffers ? 600 : 0));
        CHECK(frame.element.size() == (with_buffers ? 600 : 0));
        CHECK(frame.counts.hit_pixels == 0);
        CHECK(frame.counts.pixels == 600);
        // What is written on pictures asks for each surface's values; there is none.
        CHECK(make_annotation_request({}, request, frame, stage.volume).color_bars.empty());
    }
}
