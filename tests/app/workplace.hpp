/**
 * @file workplace.hpp
 * A folder in which the program is run as a user runs it.
 */
#pragma once

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace elvis::test {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

struct Outcome {
    int status = -1;
    std::string out;
    std::string err;
};

/** A folder of the test's own, with a small curved volume in it. */
class Workplace {
public:
    Workplace() : m_folder(fs::temp_directory_path() / ("elvis-app-" + std::to_string(::getpid()))) {
        fs::create_directories(m_folder);
        write(
            "ball.json",
            R"({"generator": 1, "mesh": "ball", "elements": [2, 2, 2], "geometry_order": 2, "fields": ["sphere", "taylor-green"]})");
        const Outcome converted = run("convert ball.json -o ball.h5 --report report.json");
        INFO(converted.err);
        REQUIRE(converted.status == 0);
    }
    ~Workplace() {
        std::error_code ignored;
        fs::remove_all(m_folder, ignored);
    }

    void write(const std::string& name, const std::string& text) const { std::ofstream(m_folder / name) << text; }
    fs::path path(const std::string& name) const { return m_folder / name; }

    Outcome run(const std::string& arguments, const std::string& environment = "") const {
        const std::string command =
            "cd '" + m_folder.string() + "' && " + environment + " '" ELVIS_PROGRAM "' " + arguments + " >out.txt 2>err.txt";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(m_folder / "out.txt"), read_file(m_folder / "err.txt")};
    }

private:
    fs::path m_folder;
};

} // namespace elvis::test
