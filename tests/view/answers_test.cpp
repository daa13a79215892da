// The line probe and the table of numbers, without a window.

#include <apps/elvis/view/model/data_file.hpp>
#include <apps/elvis/view/model/line_probe.hpp>
#include <apps/elvis/view/model/numbers.hpp>
#include <apps/elvis/view/scene/items.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace elvis;
using namespace elvis::view;

namespace {

VolumeFacts flow_facts(std::uint32_t dimension = 3) {
    VolumeFacts volume;
    volume.path = "flow.h5";
    volume.dimension = dimension;
    volume.bounds = volume.shown_bounds = {-1, -2, 0, 3, 2, dimension == 2 ? 0.0 : 1.0};
    FieldFacts velocity, pressure;
    velocity.name = "velocity";
    velocity.n_components = 3;
    pressure.name = "pressure";
    pressure.n_components = 1;
    volume.fields = {velocity, pressure};
    volume.times = {0};
    volume.has_faces = true;
    return volume;
}

Camera from_the_front() {
    Camera camera;
    camera.eye = {1, 0, 10};
    camera.look_at = {1, 0, 0.5};
    camera.up = {0, 1, 0};
    return camera;
}

/** Of a value that is x up to 1, where it jumps to 5 and stays till the volume ends at 1.5. */
commands::SampleTable jumping_table() {
    commands::SampleTable table;
    table.points = commands::points_along({{0, 0, 0}, {2, 0, 0}}, 5);
    table.columns = {{"u", 1, 0}};
    table.n_values = 1;
    table.elements = {7, 7, 7, 8, -1};
    table.values = {0, 0.5, 1, 5, std::nan("")};
    table.breaks = {{0, {0, 0, 0}, {}, {{7, {0}}}}, {1, {1, 0, 0}, {{7, {1}}}, {{8, {5}}}}, {1.5, {1.5, 0, 0}, {{8, {5}}}, {}}};
    return table;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

} // namespace

TEST_CASE("A line begins across the picture, within the volume") {
    const LineProbe line = line_across(flow_facts(), from_the_front());
    CHECK(line.from[0] == Approx(-1));
    CHECK(line.to[0] == Approx(3));
    CHECK(line.from[1] == Approx(0).margin(1e-12));
    CHECK(line.to[2] == Approx(0.5));
    LineProbe along = line;
    lay_along(along, flow_facts(), 1);
    CHECK(along.from == Vector3{1, -2, 0.5});
    CHECK(along.to == Vector3{1, 2, 0.5});
}

TEST_CASE("Ends of a line move, stay apart, and stay in a plane volume") {
    const VolumeFacts flat = flow_facts(2);
    const LineProbe line = line_across(flat, from_the_front());
    const LineProbe moved = with_moved_end(line, flat, 1, {2, 1, 0.7});
    CHECK(moved.to == Vector3{2, 1, 0});
    CHECK(moved.from == line.from);
    CHECK(with_moved_end(line, flat, 0, line.to) == line);
    CHECK(handles_of(line).size() == 2);
}

TEST_CASE("A jump is a gap in a line's curve, and both of its values are in the table") {
    const LineAnswer answer = answer_of({{0, 0, 0}, {2, 0, 0}, {}}, jumping_table());
    REQUIRE(answer.curves.size() == 1);
    const auto& points = answer.curves[0].points;
    std::vector<std::array<double, 2>> at_one;
    for (const auto& point : points) {
        if (point[0] == 1) {
            at_one.push_back(point);
        }
    }
    // Before, a gap, after; the sample on the face gives way to them.
    REQUIRE(at_one.size() == 3);
    CHECK(at_one[0][1] == 1);
    CHECK(std::isnan(at_one[1][1]));
    CHECK(at_one[2][1] == 5);
    CHECK(std::isnan(points.back()[1]));
    const std::vector<std::string> lines = lines_of(table_text(answer));
    CHECK(lines[0] == "arc_length\tx\ty\tz\telement\tu");
    CHECK(lines[1] == "0\t0\t0\t0\t\t");
    CHECK(lines[2] == "0\t0\t0\t0\t7\t0");
    CHECK(lines[4] == "1\t1\t0\t0\t7\t1");
    CHECK(lines[5] == "1\t1\t0\t0\t8\t5");
    CHECK(answer.breaks.size() == 3);
}

TEST_CASE("Numbers are asked of the volume by each field, and of each surface that is shown") {
    Scene scene = scene_of_files({});
    scene["field"] = "pressure";
    scene["volume"]["time_step"] = 2;
    scene["surfaces"] = {{{"type", "boundary"}, {"groups", {"inlet"}}},
                         {{"type", "plane"}, {"plane", {1, 0, 0, -0.5}}, {"field", "velocity"}, {"clip", {{0, 0, 1, 0}}}},
                         {{"type", "plane"}, {"plane", {0, 1, 0, 0}}, {"visible", false}},
                         {{"type", "sphere"}, {"center", {0, 0, 0}}, {"radius", 1}},
                         {{"type", "isosurface"}, {"values", {0.25, 0.5}}, {"color_field", "velocity[0]"}}};
    const std::vector<NumbersQuestion> questions = questions_of(scene, flow_facts());
    REQUIRE(questions.size() == 7);
    CHECK(questions[0].field == "pressure");
    CHECK(questions[1].field == "velocity");
    CHECK(questions[2].field == "velocity[0]");
    CHECK(questions[2].domain == ELVIS_DOMAIN_VOLUME);
    CHECK(questions[3].domain == ELVIS_DOMAIN_BOUNDARY);
    CHECK(questions[3].groups == std::vector<std::string>{"inlet"});
    CHECK(questions[4].is_clipped);
    CHECK(questions[4].plane == std::array<double, 4>{1, 0, 0, -0.5});
    CHECK(questions[6].level_field == "pressure");
    CHECK(questions[6].isovalue == 0.5);
    CHECK(questions[6].field == "velocity[0]");
    CHECK(questions[6].time_step == 2);
    CHECK(questions_of(scene, flow_facts()) == questions);
    scene["volume"]["time_step"] = 1;
    CHECK_FALSE(questions_of(scene, flow_facts()) == questions);
}

TEST_CASE("The table of numbers has all digits, places and what is not certain") {
    Numbers row;
    row.question.of = "Cut plane\ta";
    row.question.field = "pressure";
    row.question.is_clipped = true;
    row.integral = elvis_integral{};
    row.integral->value = 1.0 / 3;
    row.integral->measure = 2;
    row.integral->is_converged = 0;
    Numbers of_volume;
    of_volume.question.of = "Volume";
    of_volume.extrema = elvis_range{};
    of_volume.extrema->minimum = -1;
    of_volume.extrema->certainty = ELVIS_CERTIFIED;
    const std::vector<std::string> lines = lines_of(table_text({row, of_volume}));
    REQUIRE(lines.size() == 3);
    CHECK(lines[1].find("Cut plane a\tpressure\t0\t0.33333333333333331\t0\t2\t0\t0.16666666666666666\t") == 0);
    CHECK(lines[1].find("larger than the tolerance; of all of it, with what is cut away") != std::string::npos);
    for (const std::string& line : lines) {
        CHECK(std::count(line.begin(), line.end(), '\t') == 16);
    }
    CHECK(remark_of(of_volume).empty());
}

TEST_CASE("Streamlines are added, and their seeds are handles") {
    Scene scene = scene_of_files({});
    const ItemId item = add(scene, flow_facts(), NewItem::streamlines, 0);
    REQUIRE(scene["surfaces"].size() == 1);
    CHECK(scene["surfaces"][0]["flow"] == "velocity");
    CHECK(item_label(scene, item) == "Streamlines velocity");
    CHECK(handles_of(scene, item, flow_facts()).empty());
    scene["surfaces"][0]["seeds"] = {{0, 0, 0.5}, {1, 0, 0.5}};
    CHECK(handles_of(scene, item, flow_facts()).size() == 2);
    const Scene moved = with_moved_handle(scene, item, flow_facts(), 1, {2, 1, 0.25});
    CHECK(moved["surfaces"][0]["seeds"][1] == Json{2.0, 1.0, 0.25});
    CHECK(moved["surfaces"][0]["seeds"][0] == Json{0, 0, 0.5});
    VolumeFacts scalar = flow_facts();
    scalar.fields.erase(scalar.fields.begin());
    CHECK(flows_of(scalar) == std::vector<std::string>{"grad(pressure)"});
    CHECK(displacements_of(scalar).empty());
    CHECK(displacements_of(flow_facts()) == std::vector<std::string>{"velocity"});
}

TEST_CASE("Both ends of a line of seeds are handles, and stay apart") {
    Scene scene = scene_of_files({});
    const ItemId item = add(scene, flow_facts(), NewItem::streamlines, 0);
    scene["surfaces"][0]["seed_line"] = {{0, 0, 0.5}, {1, 0, 0.5}};
    const std::vector<Handle> handles = handles_of(scene, item, flow_facts());
    REQUIRE(handles.size() == 2);
    CHECK(handles[1].position == Vector3{1, 0, 0.5});
    const Scene moved = with_moved_handle(scene, item, flow_facts(), 1, {2, 1, 0.25});
    CHECK(moved["surfaces"][0]["seed_line"] == Json{{0, 0, 0.5}, {2, 1, 0.25}});
    CHECK(with_moved_handle(scene, item, flow_facts(), 0, {1, 0, 0.5}) == scene);
}

TEST_CASE("What is shown can be written, under names that its files have") {
    Scene scene = scene_of_files({"flow.h5"});
    scene["surfaces"] = {{{"type", "boundary"}},
                         {{"type", "isosurface"}, {"values", {0.5, 1}}, {"field", "pressure"}, {"clip", {{1, 0, 0, 0}}}},
                         {{"type", "plane"}, {"plane", {0, 0, 1, 0}}, {"visible", false}},
                         {{"type", "streamlines"}, {"flow", "velocity"}, {"field", "pressure"}}};
    const std::vector<Writable> all = writables_of(scene, flow_facts(), LineProbe{{0, 0, 0}, {1, 0, 0}, "pressure"});
    using Kind = Writable::Kind;
    REQUIRE(all.size() == 6);
    CHECK(all[0].what.domain == ELVIS_DOMAIN_BOUNDARY);
    CHECK(all[2].what.isovalue == 1);
    CHECK(all[2].what.is_clipped);
    CHECK(all[3].kind == Kind::lines);
    CHECK(all[3].surface == 3);
    CHECK(all[3].what.field == "pressure");
    CHECK(all[4].kind == Kind::line_probe);
    CHECK(all[5].kind == Kind::grid);
    CHECK(writables_of(scene, flow_facts(2), std::nullopt).size() == 3);
    CHECK_FALSE(all[3].what.is_clipped);
    Scene cut = scene;
    cut["threshold"] = "pressure > 0.2";
    for (const Writable& what : writables_of(cut, flow_facts(), std::nullopt)) {
        CHECK(what.what.is_clipped);
    }
    CHECK(usual_grid(flow_facts()) == std::array<std::size_t, 3>{64, 64, 16});
    CHECK(usual_grid(flow_facts(2)) == std::array<std::size_t, 3>{64, 64, 1});
    for (const Writable& what : all) {
        for (const char* ending : endings_of(what.kind)) {
            DataFile file{what, std::string("file") + ending};
            file.values = WrittenValues::none;
            CHECK(problem_of(file).empty());
        }
        CHECK(problem_of({what, "file.png"}) != "");
    }
    CHECK(problem_of({all[0], "file.stl"}) == ".stl holds no values; .vtp, .ply and .glb do");
}
