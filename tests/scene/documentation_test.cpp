// What the page on scenes shows is read as it stands there.

#include <core/scene/color/color_map.hpp>
#include <core/scene/scene.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>

using namespace elvis;

namespace {} // namespace

TEST_CASE("Every scene of the page on scenes is read") {
    const test::TemporaryFolder folder;
    std::istringstream lines(test::read_file(ELVIS_SCENE_PAGE));
    int n = 0;
    bool is_open = false;
    std::string scene;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("```", 0) == 0) {
            if (is_open) {
                INFO(scene);
                CHECK_NOTHROW(read_scene(folder.write("scene.json", scene)));
                ++n;
            }
            is_open = !is_open;
            scene.clear();
        } else if (is_open) {
            scene += line + "\n";
        }
    }
    CHECK(n >= 4);
}

TEST_CASE("The page on scenes and the schema name every colour map") {
    const std::string page = test::read_file(ELVIS_SCENE_PAGE);
    for (const std::string& name : color_map_names()) {
        INFO(name);
        CHECK(page.find(name) != std::string::npos);
    }
    const auto schema = nlohmann::json::parse(scene_schema_text());
    CHECK(schema["$defs"]["color_map"]["properties"]["name"]["enum"] == nlohmann::json(color_map_names()));
}
