// What the program says of itself: help, version, completion, manual pages; and what it says of words that it does not know.

#include "workplace.hpp"

#include <set>

using namespace elvis::test;

namespace {

/** Words that begin with two dashes in a help text, where options stand. */
std::set<std::string> options_in(const std::string& help) {
    std::set<std::string> options;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t begin = line.starts_with("  -") ? line.find("--") : std::string::npos;
        if (begin != std::string::npos) {
            options.insert(line.substr(begin, line.find_first_of(" ,=:", begin) - begin));
        }
    }
    return options;
}

/** As the program's help lists them. */
std::vector<std::string> commands_in(const std::string& help) {
    std::vector<std::string> commands;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ') {
            commands.push_back(line.substr(2, line.find(' ', 2) - 2));
        }
    }
    return commands;
}

bool has_program(const char* name) { return std::system(("command -v " + std::string(name) + " >/dev/null").c_str()) == 0; }

} // namespace

TEST_CASE("Help and version are commands, too") {
    const Workplace place;
    CHECK(place.run("help").out == place.run("--help").out);
    CHECK(place.run("help render").out == place.run("render --help").out);
    CHECK(place.run("version").out == place.run("--version").out);
    const Outcome unknown = place.run("help rendr");
    CHECK(unknown.status == 2);
    CHECK_THAT(unknown.err, Catch::Contains("the nearest is 'render'"));
}

TEST_CASE("An unknown option names the nearest, whatever else is wrong") {
    const Workplace place;
    const struct {
        const char* arguments;
        const char* says;
    } cases[] = {
        {"render ball.h5 --colormap viridis -o x.png", "unknown option --colormap; did you mean --color-map?"},
        {"render ball.h5 --isosurfac=0.3 -o x.png", "unknown option --isosurfac; did you mean --isosurface?"},
        {"export --ouput x.vtu", "unknown option --ouput; did you mean --output?"},
        {"info ball.h5 -j", "unknown option -j; elvis info --help lists all"},
        {"--verbos info ball.h5", "unknown option --verbos; did you mean --verbose?"},
        {"rendr ball.h5 -o x.png", "the nearest is 'render'"},
        {"render ball.h5 --precision float23 -o x.png", "float32"},
        {"render ball.h5 --lighting on -o x.png", "default"},
        {"render ball.h5 --volume default --integrator exakt -o x.png", "exact"},
    };
    for (const auto& bad : cases) {
        INFO(bad.arguments);
        const Outcome outcome = place.run(bad.arguments);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Catch::Contains(bad.says));
    }
    // What the parser takes is never looked at: a value may begin with a dash.
    CHECK(place.run("render ball.h5 --field -sphere --cut-plane -1,0,0,0.1 --size 8x8 -o x.png").status == 0);
}

TEST_CASE("Completion knows every option of every command, and bash completes a word with it") {
    const Workplace place;
    const std::vector<std::string> commands = commands_in(place.run("--help").out);
    REQUIRE(commands.size() >= 12);
    for (const char* shell : {"bash", "zsh", "fish"}) {
        const Outcome script = place.run("completion " + std::string(shell));
        REQUIRE(script.status == 0);
        place.write(std::string("elvis.") + shell, script.out);
        for (const std::string& command : commands) {
            const std::set<std::string> options = options_in(place.run(command + " --help").out);
            CHECK(options.contains("--help"));
            for (const std::string& option : options) {
                INFO(shell << ": " << command << " " << option);
                CHECK_THAT(script.out, Catch::Contains(std::string(shell) == "fish" ? "-l " + option.substr(2) : option));
            }
        }
        if (has_program(shell)) {
            CHECK(std::system((std::string(shell) + " -n '" + place.path(std::string("elvis.") + shell) + "'").c_str()) == 0);
        }
    }
    place.write("complete.sh", R"(source ./elvis.bash
complete_words() {
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    COMPREPLY=()
    _elvis
    echo "${COMPREPLY[*]}"
}
complete_words elvis rend
complete_words elvis render --isos
complete_words elvis render ball.h5 --precision float6
complete_words elvis render ba
complete_words elvis help inf
)");
    REQUIRE(std::system(("cd '" + place.path().string() + "' && bash complete.sh >words.txt").c_str()) == 0);
    CHECK(place.read("words.txt") == "render\n--isosurface\nfloat64\n\ninfo\n");
}

TEST_CASE("Every command has a manual page that groff takes without a warning") {
    const Workplace place;
    REQUIRE(place.run("manual --write-all man").status == 0);
    std::vector<std::string> pages{"elvis.1"};
    for (const std::string& command : commands_in(place.run("--help").out)) {
        pages.push_back("elvis-" + command + ".1");
        const std::string text = place.read("man/" + pages.back());
        CHECK(text == place.run("manual " + command).out);
        for (const std::string& option : options_in(place.run(command + " --help").out)) {
            std::string escaped;
            for (const char letter : option) {
                escaped += letter == '-' ? "\\-" : std::string(1, letter);
            }
            INFO(command << " " << option);
            CHECK_THAT(text, Catch::Contains(escaped));
        }
    }
    for (const std::string& page : pages) {
        INFO(page);
        REQUIRE(fs::exists(place.path("man/" + page)));
        if (has_program("groff")) {
            const std::string formatted =
                "cd '" + place.path("man") + "' && groff -man -ww -Tascii " + page + " >page.txt 2>warnings.txt";
            CHECK(std::system(formatted.c_str()) == 0);
            CHECK(place.read("man/warnings.txt").empty());
        }
    }
}
