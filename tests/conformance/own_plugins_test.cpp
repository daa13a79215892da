// The plugins that come with ElVis keep the contract themselves.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <vector>

using namespace elvis::test;

namespace {

void check(const ProgramFolder& place, const std::string& library, const std::string& volumes) {
    const Outcome checked = place.run("check-plugin '" ELVIS_PLUGINS "/" + library + ".so' " + volumes + " --json");
    INFO(checked.out);
    CHECK(checked.status == 0);
    const auto answer = nlohmann::json::parse(checked.out);
    std::printf("%-20s %2d passed, %d failed, %2d skipped in %5.1f s\n", library.c_str(), answer["passed"].get<int>(),
                answer["failed"].get<int>(), answer["skipped"].get<int>(), answer["seconds"].get<double>());
}

/** Options that name these files of tests/data. */
std::string volumes(const std::vector<std::string>& names) {
    std::string options;
    for (const std::string& name : names) {
        options += " --volume '" + data_file(name) + "'";
    }
    return options;
}

const std::string ball =
    R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "geometry_order": 2, "order": 3,)"
    R"( "fields": ["sphere", "taylor-green"]})";

} // namespace

TEST_CASE("The native plugin passes every check") {
    const ProgramFolder place;
    place.write("ball.json", ball);
    REQUIRE(place.run("convert ball.json -o ball.h5").status == 0);
    check(place, "elvis_native_plugin", "--volume ball.h5");
}

TEST_CASE("The plugin of closed-form fields passes every check") {
    check(ProgramFolder(), "elvis_analytic", "--volume '" ELVIS_SOURCES "/plugins/analytic/samples/twisted_box.txt'");
}

TEST_CASE("The plugin of cut cells passes every check") {
    check(ProgramFolder(), "elvis_cut_cells", "--volume '" ELVIS_SOURCES "/plugins/cut_cells/samples/ball.cut'");
    check(ProgramFolder(), "elvis_cut_cells", "--volume '" ELVIS_SOURCES "/plugins/cut_cells/samples/gyroid.cut'");
}

TEST_CASE("The plugin of lattices passes every check") {
    check(ProgramFolder(), "elvis_lattice", "--volume '" ELVIS_SOURCES "/plugins/lattice/samples/tiny.txt'");
}

TEST_CASE("The conversion plugins pass every check") {
    const ProgramFolder place;
    place.write("ball.json", ball);
    check(place, "elvis_generator", "--volume ball.json");
    check(place, "elvis_dat", volumes({"elvis/bulletH1P2.dat"}));
    check(place, "elvis_nektarpp", volumes({"nektarpp/CubeAllElements.xml", "nektarpp/CubeAllElements.fld"}));
    check(place, "elvis_mfem", volumes({"mfem/poisson-inline-tet-p6/mesh.mesh", "mfem/poisson-inline-tet-p6/sol.gf"}));
    check(place, "elvis_pyfr", volumes({"pyfr/mixed_3.1.pyfrm", "pyfr/waves_3.1.pyfrs"}));
    check(place, "elvis_hopr", volumes({"hopr/Circle_mesh.h5"}));
    check(place, "elvis_cgns", volumes({"cgns/boxes.cgns"}));
    check(place, "elvis_exodus", volumes({"exodus/solid.e"}));
    check(place, "elvis_vtk", volumes({"vtk/cells3.vtu"}));
    check(place, "elvis_nek5000", volumes({"nek5000/m22io_test0.f00003"}));
}

TEST_CASE("Checks of an interface that a plugin lacks do not count, unless they are asked for") {
    const ProgramFolder place;
    // It only converts.
    const std::string call = "check-plugin '" ELVIS_PLUGINS "/elvis_dat.so' --json";
    const Outcome checked = place.run(call);
    CHECK(checked.status == 0);
    const auto answer = nlohmann::json::parse(checked.out);
    for (const auto& check : answer["checks"]) {
        INFO(check.dump());
        CHECK(check["findings"].dump().find("serves no volumes") == std::string::npos);
    }
    CHECK(answer["passed"].get<std::size_t>() + answer["skipped"].get<std::size_t>() == answer["checks"].size());
    const Outcome bounds = place.run(call + " --check bounds");
    REQUIRE(bounds.status == 0);
    CHECK(nlohmann::json::parse(bounds.out)["checks"][0]["outcome"] == "skipped");
}
