// Rows of a picture in which a box can be seen, against the rays of all its pixels.
#include <core/oracle/picture/picture.hpp>
#include <core/oracle/samples/random.hpp>

#include <core/render/picture/picture_rows.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

bool meets(const Ray& ray, const std::array<double, 6>& box) {
    long double from = 0, to = 1e30L;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        const long double a = (box[axis] - ray.origin(i)) / ray.direction(i),
                          b = (box[axis + 3] - ray.origin(i)) / ray.direction(i);
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from <= to;
}

} // namespace

TEST_CASE("no ray of another row meets the box") {
    constexpr std::uint32_t width = 40, height = 30;
    Random random(7);
    std::size_t n_rows = 0, n_empty = 0, n_needed = 0, n_full = 0;
    for (int view = 0; view < 400; ++view) {
        std::array<double, 6> box{};
        Camera camera;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box[axis] = random.between(-2, 1);
            box[axis + 3] = box[axis] + random.between(0.1, 1.5);
            camera.eye[axis] = random.between(-4, 4);
            camera.look_at[axis] = random.between(-1.5, 1.5);
            camera.up[axis] = random.between(-1, 1);
        }
        camera.orthographic = view % 3 == 0;
        camera.height = random.between(1, 6);
        camera.field_of_view = random.between(10, 110);
        camera.image_shift = {random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
        const PixelRows rows = rows_of_box(box, camera, height, 0);
        REQUIRE(rows.first <= rows.end);
        REQUIRE(rows.end <= height);
        CAPTURE(view, rows.first, rows.end);
        std::size_t needed = 0;
        for (std::uint32_t row = 0; row < height; ++row) {
            bool is_met = false;
            for (std::uint32_t column = 0; column < width; ++column) {
                is_met = is_met || meets(pixel_ray(camera, width, height, column, row), box);
            }
            needed += is_met ? 1 : 0;
            CHECK((!is_met || (row >= rows.first && row < rows.end)));
        }
        n_rows += rows.end - rows.first;
        n_needed += needed;
        n_full += rows.end - rows.first == height ? 1 : 0;
        n_empty += rows.end == rows.first ? 1 : 0;
    }
    WARN(n_rows << " rows for " << n_needed << " in which it is met; all of them " << n_full << " times, none " << n_empty
                << " times");
    CHECK(n_needed > 2000);
    CHECK(n_empty > 0);
    CHECK(n_rows < 2 * n_needed);
}

} // namespace elvis::oracle
