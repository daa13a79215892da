#include "line_judge.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

namespace elvis::hunt {
namespace {

/** A cut through a ball of waves, and its picture. */
class Example {
public:
    explicit Example(Precision precision, bool has_lines = false) : m_file("ball.h5") {
        oracle::generate(R"({"generator": 1, "mesh": "ball", "elements": 2, "order": 4, "field": "jump"})", m_file.path());
        m_volume.emplace(oracle::open_volume(m_file.path()));
        std::vector<elvis_face> faces(m_volume->n_faces());
        m_volume->faces(0, faces.size(), faces);
        m_oracle.emplace(m_file.path(), std::move(faces));
        request.width = 60;
        request.height = 45;
        request.camera.eye = {2, 3, 1.5};
        request.camera.up = {0, 0, 1};
        request.camera.field_of_view = 40;
        Surface surface;
        surface.geometry = CutPlane{{1, 2, 0.3, 0.05}};
        surface.colors.points = {{0, {0, 0.1, 0.9}}, {2, {1, 0.8, 0.1}}};
        if (has_lines) {
            surface.contours = Contours{{0.8, 1.3}, {1, std::array<double, 3>{0, 0, 0}, {}}};
            surface.mesh_lines.emplace();
        }
        request.surfaces = {surface};
        Renderer renderer(test::device(), *m_volume, precision);
        frame = renderer.render(request);
        std::string reason;
        m_judge.emplace(*m_oracle, request, reason);
        m_judge->draw();
        m_precision = precision;
    }
    Judgement judge() { return m_judge->judge(frame, m_precision); }

    FrameRequest request;
    Frame frame;

private:
    TemporaryFile m_file;
    std::optional<RuntimeVolume> m_volume;
    std::optional<oracle::SceneVolume> m_oracle;
    std::optional<Judge> m_judge;
    Precision m_precision = Precision::float32;
};

} // namespace

TEST_CASE("The judge finds each buffer that is off by more than its tolerance, and nothing else") {
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    Example example(precision);
    const Tally good = example.judge().tally;
    CHECK(good.pixels == 60 * 45);
    CHECK(good.hits > 300);
    CHECK(good.far + good.near == 0);

    const std::size_t pixel = 22 * 60 + 30;
    REQUIRE(example.frame.element[pixel] >= 0);
    REQUIRE(example.frame.flags[pixel] == 0);
    const Tolerances tolerances = tolerances_of(precision);
    const auto check = [&](unsigned bit) {
        const Judgement judgement = example.judge();
        CHECK(judgement.tally.far + judgement.tally.near == 1);
        CHECK(judgement.tally.silent.at(bit) == 1);
        REQUIRE(judgement.findings.size() == 1);
        CHECK(judgement.findings[0].row == 22);
        CHECK(judgement.findings[0].column == 30);
    };
    const Frame right = example.frame;
    example.frame.color[4 * pixel + 1] += 1.5 * tolerances.color;
    check(buffer::color);
    example.frame = right;
    example.frame.value[pixel] += 1e3 * tolerances.field;
    check(buffer::value);
    example.frame = right;
    example.frame.depth[pixel] += 20 * tolerances.position;
    check(buffer::depth);
    example.frame = right;
    example.frame.element[pixel] = example.frame.element[pixel] == 0 ? 1 : 0;
    check(buffer::element);
    example.frame = right;
    example.frame.depth[pixel] = std::numeric_limits<double>::quiet_NaN();
    check(buffer::surface);
}

TEST_CASE("A flag covers a wrong pixel, and on a right one is a false alarm") {
    Example example(Precision::float32);
    const std::size_t pixel = 22 * 60 + 30;
    const Tally good = example.judge().tally;
    example.frame.flags[pixel] |= pixel_flag::undecided;
    CHECK(example.judge().tally.false_alarms[pixel_flag::undecided] == good.all_false_alarms + 1);
    example.frame.color[4 * pixel] += 0.5;
    const Tally wrong = example.judge().tally;
    CHECK(wrong.far + wrong.near == 0);
    CHECK(wrong.flagged_wrong == good.flagged_wrong + 1);
}

TEST_CASE("The judge finds each flag of a line that is there or is not, and wrong colours of lines") {
    Example example(Precision::float32, true);
    const Frame right = example.frame;
    const Tally good = example.judge().tally;
    CHECK(good.lines > 200);
    CHECK(good.far + good.near == 0);
    // Lines that are lost, and such as are invented everywhere else. Some of the pixels are judged, of the last few, since they
    // take thousands of rays.
    const auto flip = [&](std::uint32_t bit, unsigned buffer_bit, bool is_there) {
        example.frame = right;
        for (std::size_t pixel = 0; pixel < right.flags.size(); ++pixel) {
            if (right.element[pixel] < 0 || ((right.flags[pixel] & bit) != 0) != is_there)
                continue;
            example.frame.flags[pixel] ^= bit;
        }
        INFO((is_there ? "lost " : "invented ") << bit);
        CHECK(example.judge().tally.silent[buffer_bit] >= (is_there ? 100 : 5));
    };
    flip(pixel_flag::contour, buffer::contour, true);
    flip(pixel_flag::mesh_line, buffer::mesh_line, true);
    flip(pixel_flag::contour, buffer::contour, false);
    flip(pixel_flag::mesh_line, buffer::mesh_line, false);
    example.frame = right;
    const auto marked =
        std::ranges::find_if(right.flags, [](std::uint32_t flags) { return (flags & pixel_flag::contour) != 0; });
    example.frame.color[static_cast<std::size_t>(4 * (marked - right.flags.begin()))] += 0.3;
    CHECK(example.judge().tally.silent.contains(buffer::color));
}

} // namespace elvis::hunt
