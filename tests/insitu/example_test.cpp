// Solvers that are built with the installed package, and run on several ranks.
#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>

#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <sstream>

using namespace elvis::test;

namespace {

/** Examples as a newcomer builds them. */
class Examples : public TemporaryFolder {
public:
    Examples() {
        for (const char* const component : {"plugin_api", "render"}) {
            shell(std::string("cmake --install '" ELVIS_BUILD_FOLDER "' --prefix prefix --component ") + component);
        }
        shell("cmake -S prefix/share/doc/*/insitu -B build -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" -DCMAKE_BUILD_TYPE=Release");
        shell("cmake --build build");
    }

    /** Runs a command that has to succeed; what it said. */
    std::string shell(const std::string& command) const {
        const int status = std::system(("cd '" + path("") + "' && { " + command + "; } >out.txt 2>&1").c_str());
        std::string said = read_file(path("out.txt"));
        INFO(command << "\n" << said);
        REQUIRE(WIFEXITED(status));
        REQUIRE(WEXITSTATUS(status) == 0);
        return said;
    }

    std::string launch(int n, const std::string& words) const {
        return shell("LP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" ELVIS_MPI_LAUNCHER
                     "' --oversubscribe -n " +
                     std::to_string(n) + " " + words);
    }

    /** Rows of a table as numbers, by the first two columns or by the first. */
    std::vector<std::vector<double>> table(const std::string& name) const {
        std::vector<std::vector<double>> rows;
        std::istringstream lines(read_file(path(name)));
        std::string line, cell;
        std::getline(lines, line);
        while (std::getline(lines, line)) {
            std::istringstream cells(line);
            rows.emplace_back();
            while (std::getline(cells, cell, ',')) {
                rows.back().push_back(std::stod(cell));
            }
        }
        return rows;
    }
};

} // namespace

TEST_CASE("A toy solver with spectral elements on one and on four ranks makes what closed forms say") {
    const Examples examples;
    const std::string plan = "prefix/share/doc/*/insitu/heat.json";
    constexpr double pi = std::numbers::pi;
    double largest = 0;
    for (const int n : {1, 4}) {
        const std::string folder = "heat" + std::to_string(n);
        const std::string said = examples.launch(n, "build/heat " + plan + " " + folder);
        INFO(said);
        CHECK(said.find("in situ: rank 0 draws with ") != std::string::npos);
        const std::size_t last = said.find("in situ: step 200: 4 outputs in ");
        REQUIRE(last != std::string::npos);
        std::printf("%d ranks: %s\n", n, said.substr(last, said.find('\n', last) - last).c_str());
        for (const char* const picture : {"heat_000000.png", "heat_000100.png", "heat_000200.png"}) {
            CHECK(read_file(examples.path(folder + "/" + picture)).size() > 1000);
        }
        const auto totals = examples.table(folder + "/totals.csv"), centre = examples.table(folder + "/centre.csv");
        REQUIRE(totals.size() == 11);
        REQUIRE(centre.size() == 11);
        for (std::size_t row = 0; row < totals.size(); ++row) {
            const double cooled = std::exp(-3 * pi * pi * totals[row][1]);
            CHECK(totals[row][0] == 20.0 * static_cast<double>(row));
            largest = std::max(largest, std::abs(totals[row][2] / cooled - std::pow(2 / pi, 3)));
            largest = std::max(largest, std::abs(totals[row][3] / cooled - 1));
            largest = std::max(largest, std::abs(centre[row][6] / cooled - 1));
        }
        const auto axis = examples.table(folder + "/axis.csv");
        REQUIRE(axis.size() == 22);
        CHECK(axis[0][0] == 100);
        CHECK(axis[11][0] == 200);
        CHECK(std::abs(axis[5][6] - std::exp(-3 * pi * pi * 0.005)) < 1e-3);
        // From when the largest value is below 0.8, and before step 160.
        const auto cool = examples.table(folder + "/cool.csv");
        REQUIRE(!cool.empty());
        CHECK(cool.front()[0] == std::ceil(std::log(1 / 0.8) / (3 * pi * pi) / 5e-5));
        CHECK(cool.back()[0] == 159);
    }
    CHECK(read_file(examples.path("heat1/heat_000000.png")) == read_file(examples.path("heat4/heat_000000.png")));
    std::printf("largest difference of sums and samples from closed forms: %.1e\n", largest);
    CHECK(largest < 1e-4);

    // All ranks fail with one text.
    examples.shell("echo '{\"version\": 1, \"outputs\": [{\"name\": \"a\", \"quantities\": [\"maximum(v)\"]}]}' > wrong.json");
    const std::string words = examples.launch(3, "build/heat wrong.json . || test $? = 1");
    INFO(words);
    CHECK(words.find("heat: rank 0: ") != std::string::npos);
    CHECK(words.find("'v'") != std::string::npos);
    CHECK(words.find("heat: ") == words.rfind("heat: "));

    // A rank that is killed ends all, at whatever it is by then; pictures are whole or not there. A busy machine takes longer
    // than the ten seconds that are promised.
    std::filesystem::create_directory(examples.path("killed"));
    examples.launch(1, "build/heat " + plan + " killed : -n 1 sh -c 'build/heat " + plan +
                           " killed & sleep 1; touch kill; kill -9 $!; wait $!' || touch end");
    CHECK(std::filesystem::last_write_time(examples.path("end")) - std::filesystem::last_write_time(examples.path("kill")) <
          std::chrono::seconds(60));
    for (const auto& entry : std::filesystem::directory_iterator(examples.path("killed"))) {
        const std::string ending = entry.path().extension().string();
        CHECK((ending == ".png" || ending == ".csv"));
    }

    if (std::filesystem::exists(examples.path("build/wave"))) {
        examples.shell("echo '{\"version\": 1, \"outputs\": [{\"name\": \"p\", \"every\": 5, \"points\": [[1.5, 1, 1.5]]},"
                       "{\"name\": \"picture\", \"every\": 10, \"scene\": {\"image\": {\"size\": [64, 48]}}}]}' > wave.json");
        examples.launch(2, "build/wave wave.json");
        const auto p = examples.table("p.csv");
        REQUIRE(p.size() == 3);
        for (const std::vector<double>& row : p) {
            CHECK(row[6] == Approx(std::sin(1.5 - row[1])).margin(1e-12)); // At a node.
        }
        CHECK(read_file(examples.path("picture_000010.png")).size() > 500);
    } else {
        WARN("the example in Fortran was not built");
    }
}
