/**
 * @file workplace.hpp
 * A folder with a volume, in which the program is run.
 */
#pragma once

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace elvis::test {

namespace fs = std::filesystem;

/** With a small curved volume in it. */
class Workplace : public ProgramFolder {
public:
    Workplace() {
        write(
            "ball.json",
            R"({"generator": 1, "mesh": "ball", "elements": [2, 2, 2], "geometry_order": 2, "fields": ["sphere", "taylor-green"]})");
        const Outcome converted = run("convert ball.json -o ball.h5 --report report.json");
        INFO(converted.err);
        REQUIRE(converted.status == 0);
    }
};

} // namespace elvis::test
