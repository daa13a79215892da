// The program as a user runs it: answers, exit status, and what it says about bad input.

#include "workplace.hpp"

using namespace elvis::test;

TEST_CASE("Elements with a negative Jacobian are listed with a point where it is negative") {
    const Workplace place;
    place.write("twisted.json",
                R"({"generator": 1, "mesh": "twisted-tetrahedron", "elements": 1, "geometry_order": 2, "field": "sphere"})");
    REQUIRE(place.run("convert twisted.json -o twisted.h5").status == 0);
    const Outcome info = place.run("info twisted.h5 --json");
    REQUIRE(info.status == 0);
    const auto jacobians = nlohmann::json::parse(info.out)["negative_jacobians"];
    CHECK(jacobians["certainty"] == "certified");
    CHECK(jacobians["n_elements"] == 1);
    CHECK(jacobians["n_positive"] == 0);
    REQUIRE(jacobians["elements"].size() == 1);
    const auto& found = jacobians["elements"][0];
    CHECK(found["element"] == 0);
    CHECK(found["determinant"].get<double>() < 0);
    CHECK(found["xi"].size() == 3);
    CHECK(found["x"].size() == 3);
    const Outcome text = place.run("info twisted.h5");
    CHECK(text.out.find("negative somewhere in 1 element,") != std::string::npos);
    CHECK(place.run("info twisted.h5 --jacobian-tolerance -1").status == 2);
}

TEST_CASE("A volume is converted, described, probed and drawn") {
    const Workplace place;
    const auto report = nlohmann::json::parse(place.read("report.json"));
    CHECK(report["fields"][0]["name"] == "sphere");
    CHECK(report["fields"][0]["exact"] == true);
    CHECK(report["fields"][1]["exact"] == false);
    CHECK(report["fields"][0]["residual"].get<double>() < 1e-11);

    const Outcome info = place.run("info ball.h5 --json");
    REQUIRE(info.status == 0);
    CHECK(nlohmann::json::parse(info.out)["negative_jacobians"]["n_elements"] == 0);

    const Outcome probe = place.run("probe ball.h5 --point 0.1,-0.2,0.3 --point 2,0,0 --json");
    REQUIRE(probe.status == 0);
    const auto points = nlohmann::json::parse(probe.out)["points"];
    CHECK(std::abs(points[0]["fields"]["sphere"][0].get<double>() - 0.14) < 1e-12);
    CHECK(std::abs(points[0]["gradients"]["sphere"][0][1].get<double>() + 0.4) < 1e-10);
    CHECK(points[1]["element"].is_null());

    const Outcome derived = place.run("probe ball.h5 --point 0.1,-0.2,0.3 --field 'laplacian(sphere) + x' --json");
    REQUIRE(derived.status == 0);
    const auto found = nlohmann::json::parse(derived.out)["points"][0]["expressions"]["laplacian(sphere) + x"];
    CHECK(std::abs(found["value"].get<double>() - 6.1) < 1e-9);
    CHECK(std::abs(found["gradient"][0].get<double>() - 1) < 1e-7);

    const Outcome contours =
        place.run("render ball.h5 --field 'velocity + 0 * sphere' --cut-plane 0,0,1,0.1 --contours 0.2,0.4 "
                  "--size 64x64 --validation -o ball.png --stats stats.json");
    INFO(contours.err);
    REQUIRE(contours.status == 0);
    CHECK(nlohmann::json::parse(place.read("stats.json"))["counts"]["contour_pixels"].get<int>() > 20);

    const Outcome levels =
        place.run("render ball.h5 --field sphere --isosurface 0.3 --isosurface 0.6 --size 64x64 --lighting default "
                  "--validation -o ball.png --stats stats.json");
    INFO(levels.err);
    REQUIRE(levels.status == 0);
    const auto of_levels = nlohmann::json::parse(place.read("stats.json"))["counts"];
    CHECK(of_levels["isosurface_pixels"].get<int>() > 400);
    CHECK(of_levels["undecided_isosurface_pixels"].get<int>() < 10);
    CHECK(of_levels["excluded_intervals"].get<int>() > 100);
    std::vector<std::string> pictures;
    for (const std::string options :
         {"", "--lighting default", "--lighting none", "--boundary", "--boundary --lighting none"}) {
        REQUIRE(place.run("render ball.h5 --field sphere --isosurface 0.3 --size 32x32 -o light.png " + options).status == 0);
        pictures.push_back(place.read("light.png"));
    }
    CHECK(pictures[0] == pictures[1]);
    CHECK(pictures[0] != pictures[2]);
    CHECK(pictures[3] == pictures[4]);
    place.write("unlit.json", R"({"version": 1, "volume": {"path": "ball.h5"}, "field": "sphere", "lighting": "none"})");
    REQUIRE(place.run("render unlit.json --isosurface 0.3 --size 32x32 -o light.png").status == 0);
    CHECK(place.read("light.png") == pictures[2]);

    // A spelling of versions before 0.2.
    for (const std::string share : {"rows", "parts"}) {
        REQUIRE(place.run("render ball.h5 --boundary --isosurface 0.3 --size 32x32 -o shared.png --share " + share).status ==
                0);
    }
    CHECK(place.run("render ball.h5 --boundary --size 32x32 -o shared.png --share halves").status == 2);

    for (const std::string precision : {"float32", "float64"}) {
        const Outcome render = place.run("render ball.h5 --field sphere --cut-plane 0,0,1,0 --size 64x64 --precision " +
                                         precision + " --validation -o ball.png --buffers ball.buffers.h5 --stats stats.json");
        INFO(render.err);
        REQUIRE(render.status == 0);
        CHECK(place.read("ball.png").substr(1, 3) == "PNG");
        const auto counts = nlohmann::json::parse(place.read("stats.json"))["counts"];
        CHECK(counts["pixels"] == 64 * 64);
        CHECK(counts["hit_pixels"].get<int>() > 1000);
        CHECK(counts["newton_failures"] == 0);
        CHECK(counts["nan_pixels"] == 0);
    }
}

TEST_CASE("A volume is exported and converted back") {
    const Workplace place;
    const Outcome exported = place.run("export ball.h5 -o ball.vtu");
    INFO(exported.err);
    REQUIRE(exported.status == 0);
    const Outcome back = place.run("convert ball.vtu -o back.h5 --json");
    INFO(back.err);
    REQUIRE(back.status == 0);
    CHECK(nlohmann::json::parse(back.out)["fields"][0]["exact"] == true);
    const Outcome probe = place.run("probe back.h5 --point 0.1,-0.2,0.3 --json");
    REQUIRE(probe.status == 0);
    CHECK(std::abs(nlohmann::json::parse(probe.out)["points"][0]["fields"]["sphere"][0].get<double>() - 0.14) < 1e-12);
    CHECK(place.run("export ball.h5 -o ball.obj").status == 2);
    CHECK(place.run("export ball.h5 -o late.vtu --time-step 3").status == 1);
    CHECK_FALSE(fs::exists(place.path("late.vtu")));
}

TEST_CASE("A scene file and the same options give the same picture") {
    const Workplace place;
    place.write("scene.json",
                R"({"version": 1, "volume": {"path": "ball.h5"}, "field": "velocity[0]", "image": {"size": [80, 60]},
                                  "color_map": {"name": "coolwarm", "range": [-1, 1]},
                                  "surfaces": [{"type": "plane", "plane": [1, 0, 0.5, 0]}]})");
    REQUIRE(place.run("render scene.json -o scene.png").status == 0);
    REQUIRE(
        place
            .run("render ball.h5 --field 'velocity[0]' --size 80x60 --color-map coolwarm --range -1,1 --cut-plane 1,0,0.5,0 "
                 "-o options.png")
            .status == 0);
    CHECK(place.read("scene.png") == place.read("options.png"));
}

TEST_CASE("A picture is annotated only if that is asked for, from a scene file as from the command line") {
    const Workplace place;
    place.write("scene.json",
                R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [320, 240], "annotation": "default"}})");
    place.write("own.json", R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [320, 240], "annotation": {
                               "title": "", "color_bars": false, "axes": false}}})");
    const auto picture = [&](const std::string& arguments) {
        const Outcome outcome = place.run("render " + arguments + " -o annotated.png");
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return place.read("annotated.png");
    };
    const std::string plain = picture("ball.h5 --size 320x240");
    const std::string annotated = picture("ball.h5 --size 320x240 --annotation default");
    CHECK(plain != annotated);
    CHECK(picture("ball.h5 --size 320x240 --annotation none") == plain);
    CHECK(picture("scene.json") == annotated);
    CHECK(picture("scene.json --annotation none") == plain);
    // Everything is turned off by itself, and back on by the command line.
    CHECK(picture("own.json") == plain);
    CHECK(picture("own.json --annotation default") == annotated);
    // What finds no room is said.
    const Outcome tiny = place.run("render ball.h5 --size 64x48 --annotation default -o annotated.png");
    CHECK(tiny.status == 0);
    CHECK_THAT(tiny.err, Catch::Contains("no room for the color bar of sphere"));
}

TEST_CASE("Surfaces are lit only if that is asked for, and each by itself") {
    const Workplace place;
    const auto scene = [&](const std::string& name, const std::string& lighting, const std::string& own) {
        place.write(name, R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [80, 60]}, "lighting": )" +
                              lighting + R"(, "surfaces": [{"type": "boundary", "lighting": )" + own + "}]}");
    };
    scene("default.json", R"("default")", "true");
    scene("same.json", R"({"ambient": [0.3, 0.3, 0.3], "headlight": [0.7, 0.7, 0.7]})", "true");
    scene("own.json", R"({"lights": [{"type": "point", "position": [2, 2, 2]}], "specular": 0.5})", "true");
    scene("not_here.json", R"("default")", "false");
    const auto picture = [&](const std::string& arguments) {
        const Outcome outcome = place.run("render " + arguments + " --validation -o lit.png");
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return place.read("lit.png");
    };
    const std::string plain = picture("ball.h5 --boundary --size 80x60");
    const std::string lit = picture("ball.h5 --boundary --size 80x60 --lighting default");
    CHECK(plain != lit);
    CHECK(picture("default.json") == lit);
    CHECK(picture("same.json") == lit);
    CHECK(picture("not_here.json") == plain);
    CHECK(picture("default.json --lighting none") == plain);
    const std::string own = picture("own.json");
    CHECK(own != lit);
    CHECK(own != plain);
}

TEST_CASE("Volume rendering is added to surfaces, counted, and turned off") {
    const Workplace place;
    place.write("levels.json", R"({"color": [[0, 1, 0, 0]], "density": [[0, 1], [1, 2]]})");
    place.write("scene.json", R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [40, 30]},
                                  "volume_rendering": {"density": [[0, 0], [1, 2]]}})");
    const Outcome both =
        place.run("render ball.h5 --size 40x30 --cut-plane 0,0,1,0 --volume levels.json --integrator trapezoid "
                  "--volume-step 0.1 -o both.png --stats stats.json");
    INFO(both.err);
    REQUIRE(both.status == 0);
    const auto counts = nlohmann::json::parse(place.read("stats.json"))["counts"];
    CHECK(counts["hit_pixels"] > 100);
    for (const char* key : {"volume_pixels", "inexact_volume_pixels", "volume_segments", "empty_segments", "volume_steps",
                            "volume_breakpoints"}) {
        CHECK(counts.contains(key));
    }
    REQUIRE(place.run("render scene.json --volume none -o none.png").status == 0);
    REQUIRE(place.run("render ball.h5 --size 40x30 -o plain.png").status == 0);
    CHECK(place.read("none.png") == place.read("plain.png"));
}

TEST_CASE("A scene cuts with surfaces of every kind, and says what is wrong with one") {
    const Workplace place;
    place.write("plate.obj", "v -1 -1 0.1\nv 1 -1 0.1\nv 1 1 0.1\nv -1 1 0.1\nf 1 2 3 4\n");
    std::string patch = "1\n3 3\n";
    for (int i = 0; i < 16; ++i) {
        patch += std::to_string(i / 4 - 1.5) + " " + std::to_string(i % 4 - 1.5) + " 0.1\n";
    }
    place.write("plate.bpt", patch);
    const auto draw = [&](const std::string& surface) {
        place.write("scene.json",
                    R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [60, 60]}, "surfaces": [)" + surface +
                        "]}");
        return place.run("render scene.json -o out.png --stats stats.json");
    };
    const auto hits = [&](const std::string& surface) {
        const Outcome outcome = draw(surface);
        INFO(surface << ": " << outcome.err);
        REQUIRE(outcome.status == 0);
        return nlohmann::json::parse(place.read("stats.json"))["counts"]["hit_pixels"].get<int>();
    };
    CHECK(hits(R"({"type": "sphere", "center": [0, 0, 0], "radius": 0.5})") > 100);
    CHECK(hits(R"({"type": "cylinder", "from": [0, 0, -0.5], "to": [0, 0, 0.5], "radius": 0.4, "capped": false})") > 100);
    CHECK(hits(R"({"type": "cone", "from": [0, 0, -0.5], "to": [0, 0, 0.5], "from_radius": 0.5, "to_radius": 0})") > 100);
    CHECK(hits(R"({"type": "torus", "center": [0, 0, 0], "axis": [0, 1, 1], "major_radius": 0.5, "minor_radius": 0.2})") > 100);
    // The same plane in five ways.
    const int plate = hits(R"({"type": "plane", "plane": [0, 0, 1, -0.1]})");
    CHECK(plate > 100);
    for (const char* surface : {R"({"type": "quadric", "coefficients": [0, 0, 0, 0, 0, 0, 0, 0, 1, -0.1]})",
                                R"({"type": "implicit", "expression": "z - 0.1"})", R"({"type": "mesh", "file": "plate.obj"})",
                                R"({"type": "bezier", "file": "plate.bpt"})"}) {
        // The view follows a plane, not these.
        CHECK(hits(std::string(surface) + R"(, {"type": "sphere", "center": [0, 0, -9], "radius": 0.1})") > 100);
    }
    // A plane beside the volume shows nothing else.
    CHECK(hits(R"({"type": "plane", "plane": [0, 0, 1, -1.5]})") == 0);
    CHECK(hits(R"({"type": "plane", "plane": [0, 0, 1, -1.5], "outside": [1, 0, 0]})") > 500);
    // All the rest of the picture that the surface reaches is outside.
    CHECK(hits(R"({"type": "sphere", "center": [0, 0, 0], "radius": 1.4, "outside": [1, 0, 0]})") > 500);

    const auto fault = [&](const std::string& surface) {
        const Outcome outcome = draw(surface);
        CHECK(outcome.status == 1);
        return outcome.err;
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(fault(R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "axis": [0, 0, 1]})"),
               Contains("scene.json") && Contains("'surfaces[0].axis' means nothing where 'type' is \"sphere\""));
    CHECK_THAT(fault(R"({"type": "sphere", "center": [0, 0, 0]})"), Contains("'surfaces[0].radius' is missing"));
    CHECK_THAT(fault(R"({"type": "cylinder", "from": [0, 0, 0], "to": [0, 0, 0], "radius": 1})"), Contains("the same point"));
    CHECK_THAT(fault(R"x({"type": "implicit", "expression": "x + sine(y)"})x"), Contains("surfaces[0]") && Contains("sine"));
    CHECK_THAT(fault(R"({"type": "mesh", "file": "nothing.stl"})"), Contains("nothing.stl") && Contains("cannot be read"));
    CHECK_THAT(fault(R"({"type": "boundary", "outside": [1, 0, 0]})"), Contains("outside"));
    CHECK_THAT(fault(R"({"type": "boundary", "values": [1]})"), Contains("'surfaces[0].values' means nothing"));
    CHECK_THAT(fault(R"({"type": "isosurface"})"), Contains("'surfaces[0].values' is missing"));
    CHECK_THAT(fault(R"({"type": "isosurface", "values": [0.5], "color": [1, 0, 0], "color_field": "x"})"),
               Contains("'surfaces[0].color'"));
    CHECK_THAT(fault(R"({"type": "isosurface", "values": [0.5], "color_field": "temprature"})"), Contains("temprature"));
    // Nothing is where the field does not get to.
    CHECK(hits(R"({"type": "isosurface", "values": [0.5]})") > 250);
    CHECK(hits(R"({"type": "isosurface", "values": [50]})") == 0);
}

namespace {

/** Scenes, transfer functions and volumes, most with a mistake. */
void write_bad_input(const Workplace& place) {
    place.write("unknown_key.json", R"({"version": 1, "volume": {"path": "ball.h5"}, "colour_map": {"name": "viridis"}})");
    const auto annotation = [&](const std::string& name, const std::string& value) {
        place.write(name, R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"annotation": )" + value + "}}");
    };
    annotation("annotation_key.json", R"({"titel": "x"})");
    annotation("annotation_word.json", R"("all")");
    annotation("annotation_number.json", "7");
    annotation("annotation_flag.json", R"({"axes": 1})");
    annotation("annotation_font.json", R"({"font": "missing.ttf"})");
    const auto lighting = [&](const std::string& name, const std::string& value) {
        place.write(name, R"({"version": 1, "volume": {"path": "ball.h5"}, "lighting": )" + value + "}");
    };
    const auto rendering = [&](const std::string& name, const std::string& value) {
        place.write(name, R"({"version": 1, "volume": {"path": "ball.h5"}, "volume_rendering": )" + value + "}");
    };
    rendering("volume_key.json", R"({"desnity": [[0, 1]]})");
    rendering("volume_both.json", R"({"transfer": "levels.json", "density": [[0, 1]]})");
    rendering("volume_field.json", R"({"field": "velocty"})");
    rendering("volume_file.json", R"({"transfer": "missing.json"})");
    place.write("levels.json", R"({"color": [[0, 1, 0, 0]], "density": [[0, 1], [1, -2]]})");
    place.write("good_levels.json", R"({"color": [[0, 1, 0, 0]], "density": [[0, 1], [1, 2]]})");
    place.write("preset.json", R"([{"RGBPoints": [0, 0, 0, 1, 1, 1, 0, 0], "ColorSpace": "RGB"}])");
    lighting("light_key.json", R"({"ambiant": [1, 1, 1]})");
    lighting("light_kind.json", R"({"lights": [{"type": "point", "direction": [1, 1, 1]}]})");
    lighting("light_nowhere.json", R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})");
    lighting("light_negative.json", R"({"headlight": [1, 1, -0.5]})");
    place.write("broken.json", "{\"version\": 1,\n \"volume\": }");
    place.write("bad_field.json", R"({"generator": 1, "mesh": "box", "fields": "sphere", "shpae": "prism"})");
    place.write("not_a_volume.h5", "this is no HDF5 file");
}

struct BadCommand {
    const char* arguments;
    int status;
    const char* says;
};

constexpr BadCommand bad_commands[] = {
    {"rendr ball.h5 -o x.png", 2, "render"},
    {"render ball.h5 --boundary lid -o x.png", 1, "sphere"},
    {"render ball.h5 --boundary all -o x.png", 1, "Without a name, the whole boundary is drawn"},
    {"render missing.h5 -o x.png", 1, "missing.h5"},
    {"render not_a_volume.h5 -o x.png", 1, "not_a_volume.h5"},
    {"render ball.h5 --field temperature -o x.png", 1, "sphere"},
    {"render ball.h5 --field 'sphere[3]' -o x.png", 1, "components"},
    {"render ball.h5 --field 'norm(curl(velocty))' -o x.png", 1,
     "column 11: 'velocty' is unknown; the nearest name is 'velocity'"},
    {"probe ball.h5 --point 0,0,0 --field 'sphere +'", 1, "column 9: the text ends where a value is expected"},
    {"render unknown_key.json -o x.png", 1, "color_map"},
    {"render annotation_key.json -o x.png", 1, "'image.annotation.titel' is unknown; the nearest known key is 'title'"},
    {"render annotation_word.json -o x.png", 1, "'image.annotation' is \"all\"; allowed are"},
    {"render annotation_number.json -o x.png", 1, "image.annotation"},
    {"render annotation_flag.json -o x.png", 1, "true or false"},
    {"render annotation_font.json -o x.png", 1, "missing.ttf"},
    {"render ball.h5 --annotation some -o x.png", 2, "--annotation"},
    {"render light_key.json -o x.png", 1, "'lighting.ambiant' is unknown; the nearest known key is 'ambient'"},
    {"render light_kind.json -o x.png", 1, "'lighting.lights[0].direction' means nothing"},
    {"render light_nowhere.json -o x.png", 1, "'lighting.lights[0].direction' has length zero"},
    {"render light_negative.json -o x.png", 1, "'lighting.headlight' is -0.5; it must be at least 0"},
    {"render volume_key.json -o x.png", 1, "'volume_rendering.desnity' is unknown; the nearest known key is 'density'"},
    {"render volume_both.json -o x.png", 1, "'volume_rendering.density' means nothing beside 'transfer'"},
    {"render volume_field.json -o x.png", 1, "velocty"},
    {"render volume_file.json -o x.png", 1, "missing.json"},
    {"render ball.h5 --volume levels.json -o x.png", 1, "levels.json: 'density[1]' is -2; it must be at least 0"},
    {"render ball.h5 --volume preset.json -o x.png", 1, "preset.json: has no list Points"},
    {"render ball.h5 --volume missing.json -o x.png", 1, "missing.json: cannot be read"},
    {"render ball.h5 --undeformed-edges -o x.png", 2, "--undeformed-edges: means nothing without --warp"},
    {"render ball.h5 --integrator exact -o x.png", 2, "--integrator: means nothing without --volume"},
    {"render ball.h5 --volume default --integrator simpson -o x.png", 2, "adaptive-trapezoid"},
    {"render ball.h5 --volume default --volume-step 0.1 -o x.png", 2, "--volume-step: is of the integrators riemann"},
    {"render ball.h5 --volume default --volume-step 0 --integrator riemann -o x.png", 2, "--volume-step"},
    {"render ball.h5 --volume good_levels.json --volume-tolerance 0.1 --integrator riemann -o x.png", 2, "--volume-tolerance"},
    {"render broken.json -o x.png", 1, "broken.json:2"},
    {"render ball.h5 --size 0x10 -o x.png", 2, "--size"},
    {"render ball.h5 --cut-plane 0,0,0,1 -o x.png", 2, "--cut-plane"},
    {"render ball.h5 --cut-plane 1,0,x,1 -o x.png", 2, "--cut-plane"},
    {"render ball.h5 --isosurface nan -o x.png", 2, "--isosurface"},
    {"render ball.h5 --isosurface 0.5 --isosurface=-inf -o x.png", 2, "--isosurface"},
    {"render ball.h5 --contours nan -o x.png", 2, "--contours"},
    {"render ball.h5 --range 0,inf -o x.png", 2, "--range"},
    {"render ball.h5 --fov nan -o x.png", 2, "--fov"},
    {"render ball.h5 --orthographic inf -o x.png", 2, "--orthographic"},
    {"render ball.h5 --device nonsense -o x.png", 1, "nonsense"},
    {"render ball.h5 --time-step 7 -o x.png", 1, "time step"},
    {"render ball.h5 --color-map nonsense -o x.png", 1, "viridis"},
    {"render ball.h5 --size 16x16 -o no/such/folder/x.png", 1, "no/such/folder/x.png"},
    {"convert missing.dat -o x.h5", 1, "missing.dat"},
    {"convert bad_field.json -o x.h5", 1, "shape"},
    {"convert ball.json -o no/such/folder/x.h5", 1, "no/such/folder/x.h5"},
    {"convert ball.json -o x.h5 --fields nothing", 1, "nothing"},
    {"info not_a_volume.h5", 1, "not_a_volume.h5"},
    {"nonsense", 2, ""},
};

} // namespace

TEST_CASE("Bad input gets one clear line, a non-zero status and no file") {
    const Workplace place;
    write_bad_input(place);
    for (const BadCommand& bad : bad_commands) {
        INFO(bad.arguments);
        const Outcome outcome = place.run(bad.arguments);
        INFO(outcome.err);
        CHECK(outcome.status == bad.status);
        CHECK_THAT(outcome.err, Catch::Contains(bad.says));
        CHECK_FALSE(fs::exists(place.path("x.png")));
        CHECK_FALSE(fs::exists(place.path("x.h5")));
    }
}

TEST_CASE("A plane that misses the volume is a stated empty picture") {
    const Workplace place;
    const Outcome outcome = place.run("render ball.h5 --cut-plane 0,0,1,-9 --size 16x16 -o empty.png --stats stats.json");
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.err, Catch::Contains("nothing is hit"));
    CHECK(nlohmann::json::parse(place.read("stats.json"))["counts"]["hit_pixels"] == 0);
}

TEST_CASE("a plugin that crashes is named before the program ends") {
    const Workplace place;
    place.write("probe-crash.cube", "");
    const Outcome outcome = place.run("info probe-crash.cube", "ELVIS_PLUGIN_PATH='" ELVIS_FIXTURES "'");
    CHECK(outcome.status != 0);
    CHECK_THAT(outcome.err, Catch::Contains("the plugin org.elvis.test.troubled crashed in its function probe"));
}
