// The plugins that come with ElVis keep the contract themselves.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <tests/support/files.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

class Workplace {
public:
    Workplace() : m_folder(fs::temp_directory_path() / ("elvis-own-" + std::to_string(::getpid()))) {
        fs::create_directories(m_folder);
    }
    ~Workplace() {
        std::error_code ignored;
        fs::remove_all(m_folder, ignored);
    }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(m_folder / name) << text;
        return (m_folder / name).string();
    }
    int run(const std::string& arguments) const {
        const int status =
            std::system(("cd '" + m_folder.string() + "' && '" ELVIS_PROGRAM "' " + arguments + " >out.txt 2>err.txt").c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string read(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(m_folder / name).rdbuf();
        return text.str();
    }

    void check(const std::string& library, const std::string& volumes) const {
        const int status = run("check-plugin '" ELVIS_PLUGINS "/" + library + ".so' " + volumes + " --json");
        INFO(read("out.txt"));
        CHECK(status == 0);
        const auto answer = nlohmann::json::parse(read("out.txt"));
        std::printf("%-20s %2d passed, %d failed, %2d skipped in %5.1f s\n", library.c_str(), answer["passed"].get<int>(),
                    answer["failed"].get<int>(), answer["skipped"].get<int>(), answer["seconds"].get<double>());
    }

private:
    fs::path m_folder;
};

/** Options that name these files of tests/data. */
std::string volumes(const std::vector<std::string>& names) {
    std::string options;
    for (const std::string& name : names) {
        options += " --volume '" + elvis::test::data_file(name) + "'";
    }
    return options;
}

const std::string ball =
    R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "geometry_order": 2, "order": 3,)"
    R"( "fields": ["sphere", "taylor-green"]})";

} // namespace

TEST_CASE("The native plugin passes every check") {
    const Workplace place;
    place.write("ball.json", ball);
    REQUIRE(place.run("convert ball.json -o ball.h5") == 0);
    place.check("elvis_native_plugin", "--volume ball.h5");
}

TEST_CASE("The plugin of closed-form fields passes every check") {
    Workplace().check("elvis_analytic", "--volume '" ELVIS_SOURCES "/plugins/analytic/samples/twisted_box.txt'");
}

TEST_CASE("The plugin of cut cells passes every check") {
    Workplace().check("elvis_cut_cells", "--volume '" ELVIS_SOURCES "/plugins/cut_cells/samples/ball.cut'");
    Workplace().check("elvis_cut_cells", "--volume '" ELVIS_SOURCES "/plugins/cut_cells/samples/gyroid.cut'");
}

TEST_CASE("The conversion plugins pass every check") {
    const Workplace place;
    place.write("ball.json", ball);
    place.check("elvis_generator", "--volume ball.json");
    place.check("elvis_dat", volumes({"elvis/bulletH1P2.dat"}));
    place.check("elvis_nektarpp", volumes({"nektarpp/CubeAllElements.xml", "nektarpp/CubeAllElements.fld"}));
    place.check("elvis_mfem", volumes({"mfem/poisson-inline-tet-p6/mesh.mesh", "mfem/poisson-inline-tet-p6/sol.gf"}));
    place.check("elvis_vtk", volumes({"vtk/cells3.vtu"}));
}

TEST_CASE("Checks of an interface that a plugin lacks do not count, unless they are asked for") {
    const Workplace place;
    // It only converts.
    const std::string call = "check-plugin '" ELVIS_PLUGINS "/elvis_dat.so' --json";
    CHECK(place.run(call) == 0);
    const auto answer = nlohmann::json::parse(place.read("out.txt"));
    for (const auto& check : answer["checks"]) {
        INFO(check.dump());
        CHECK(check["findings"].dump().find("serves no volumes") == std::string::npos);
    }
    CHECK(answer["passed"].get<std::size_t>() + answer["skipped"].get<std::size_t>() == answer["checks"].size());
    REQUIRE(place.run(call + " --check bounds") == 0);
    CHECK(nlohmann::json::parse(place.read("out.txt"))["checks"][0]["outcome"] == "skipped");
}
