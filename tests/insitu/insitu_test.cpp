// A solver that runs on several ranks, which are threads here, and what is made of it.
#include "rank_arrays.hpp"
#include "thread_ranks.hpp"

#include <core/session/volume/warped.hpp>
#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <sstream>

using namespace elvis;
using namespace elvis::test;

namespace {

/** A native volume, of which each rank has some elements. */
class Mesh : public ProgramFolder {
public:
    explicit Mesh(const std::string& description) {
        write("input.json", description);
        REQUIRE(run("convert input.json -o whole.h5").status == 0);
        source = native_source(path("whole.h5"));
    }

    /** Of each class equal shares, in the order of ranks. */
    std::vector<RankArrays::Run> share(std::uint32_t rank, std::uint32_t size) const {
        std::vector<RankArrays::Run> runs;
        for (const native::ElementClass& of : source->description().classes) {
            runs.push_back({of.n_elements * rank / size, of.n_elements * (rank + 1) / size});
        }
        return runs;
    }

    std::shared_ptr<const native::VolumeSource> source;
};

/** A rank of a run: what a solver does with the library, with all that fails as text. */
class Rank {
public:
    Rank(const elvis_communicator& ranks, const elvis_arrays& arrays, const std::string& plan, const std::string& folder) {
        elvis_context_options options{};
        options.struct_size = sizeof options;
        options.plugin_path = ELVIS_TEST_PLUGINS;
        elvis_context_create(&options, &m_context);
        if (elvis_insitu_open(m_context, &ranks, &arrays, plan.c_str(), folder.c_str(), &m_insitu) != ELVIS_OK) {
            error = elvis_context_error(m_context);
        }
    }
    ~Rank() {
        elvis_insitu_release(m_insitu);
        elvis_context_release(m_context);
    }
    Rank(const Rank&) = delete;
    Rank& operator=(const Rank&) = delete;

    void step(std::uint64_t step, double time) {
        if (error.empty() && elvis_insitu_step(m_insitu, step, time) != ELVIS_OK) {
            error = elvis_insitu_error(m_insitu);
        }
    }
    elvis_insitu_report report() const {
        elvis_insitu_report now{};
        now.struct_size = sizeof now;
        elvis_insitu_get_report(m_insitu, &now);
        return now;
    }
    elvis_insitu* handle() const { return m_insitu; }

    std::string error;

private:
    elvis_context* m_context = nullptr;
    elvis_insitu* m_insitu = nullptr;
};

/** Rows of a table of numbers, without its head. */
std::vector<std::vector<double>> rows_of(const std::string& text) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(text);
    std::string line, cell;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) {
            rows.back().push_back(cell.empty() ? std::nan("") : std::stod(cell));
        }
    }
    return rows;
}

constexpr const char* waves = R"~({"generator": 1, "mesh": "waves", "elements": [4, 3, 3], "order": 2, "field": "waves"})~";

/** Runs `what` on `n` ranks; texts of what failed on each. */
std::vector<std::string> errors_of(std::uint32_t n, const std::function<std::string(const elvis_communicator&)>& what) {
    std::vector<std::string> errors(n);
    ThreadRanks(n).run([&](const elvis_communicator& own) { errors[own.rank] = what(own); });
    return errors;
}

/** What fails when `n` ranks with shares of the mesh open a plan, and take a step. */
std::vector<std::string> errors_of(const Mesh& mesh, std::uint32_t n, const std::string& plan) {
    return errors_of(n, [&](const elvis_communicator& own) {
        const RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
        Rank rank(own, arrays.table, plan, mesh.path(""));
        rank.step(0, 0);
        return rank.error;
    });
}

/** A plan of one output, with these keys. */
std::string plan_of(const std::string& keys) { return R"~({"version": 1, "outputs": [{"name": "out", )~" + keys + "}]}"; }

} // namespace

TEST_CASE("One, two and four ranks draw the bytes that elvis render draws in as many parts") {
    const Mesh mesh(waves);
    // Colours are said, and the camera stands where the whole volume is seen.
    mesh.write("scene.json", R"~({"version": 1, "volume": {"path": "whole.h5"}, "image": {"size": [96, 72]},
        "color_map": {"range": [-1, 1]}, "surfaces": [{"type": "plane", "plane": [1, 0.2, 0.1, 0.1], "opacity": 0.6,
        "mesh_lines": {}}, {"type": "boundary", "clip": [[0, 0, -1, 0]]}], "volume_rendering": {}})~");
    for (const std::uint32_t n : {1u, 2u, 4u}) {
        INFO(n << " ranks");
        REQUIRE(mesh.run("render scene.json --parts " + std::to_string(n) + " -o parts.png --buffers parts.h5").status == 0);
        const auto errors = errors_of(n, [&](const elvis_communicator& own) {
            const RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
            Rank rank(own, arrays.table, plan_of(R"~("scene": "scene.json", "buffers": true)~"), mesh.path(""));
            rank.step(n, 0.5);
            return rank.error;
        });
        CHECK(errors == std::vector<std::string>(n));
        const std::string number = "out_00000" + std::to_string(n);
        CHECK(mesh.read(number + ".png") == mesh.read("parts.png"));
        CHECK(mesh.read(number + ".h5") == mesh.read("parts.h5"));
    }
}

TEST_CASE("Ranks have some shapes, one, or no element, and draw what elvis render does") {
    const Mesh mesh(
        R"~({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "order": 2, "field": "waves"})~");
    mesh.write("scene.json", R"~({"version": 1, "volume": {"path": "whole.h5"}, "image": {"size": [96, 72]},
        "color_map": {"range": [-1, 1]}, "surfaces": [{"type": "plane", "plane": [1, 0.2, 0.1, 0.1]}, {"type": "boundary", "clip": [[0, 0, -1, 0]]}]})~");
    REQUIRE(mesh.run("render scene.json --parts 1 -o parts.png --buffers parts.h5").status == 0);
    // All elements on the middle rank: the picture of one part.
    const auto errors = errors_of(3, [&](const elvis_communicator& own) {
        const RankArrays arrays(*mesh.source, own.rank == 1 ? mesh.share(0, 1) : mesh.share(0, 1000000));
        Rank rank(own, arrays.table, plan_of(R"~("scene": "scene.json", "buffers": true)~"), mesh.path(""));
        rank.step(0, 0);
        return rank.error;
    });
    CHECK(errors == std::vector<std::string>(3));
    CHECK(mesh.read("out_000000.png") == mesh.read("parts.png"));
    // Shapes are ragged over ranks: the same elements are seen as in the whole.
    CHECK(errors_of(mesh, 3, R"~({"version": 1, "outputs": [{"name": "ragged", "scene": "scene.json"}]})~") ==
          std::vector<std::string>(3));
    CHECK(mesh.read("ragged_000000.png").size() > 1000);
}

TEST_CASE("Reductions, samples and triggers are those of the whole volume, on any number of ranks") {
    // x + 2 y + 3 z on a cube of side 2: the integral of its square is known.
    const Mesh mesh(R"~({"generator": 1, "mesh": "box", "elements": [3, 3, 4],
        "fields": [{"field": "polynomial", "name": "p", "coefficients": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]}]})~");
    const std::string plan = R"~({"version": 1, "outputs": [
        {"name": "sums", "quantities": ["integral(p^2)", "maximum(p)", "minimum(p) + time", "integral(1)"]},
        {"name": "line", "every": 2, "line": {"from": [-0.9, 0.1, 0.2], "to": [0.9, 0.1, 0.2], "count": 4}},
        {"name": "points", "times": [0.15], "points": [[0.5, 0.5, 0.5], [7, 7, 7]], "values": ["p", "2 * p"]},
        {"name": "large", "when": "maximum(p) > 20", "quantities": ["step"]}]})~";
    double largest = 0;
    for (const std::uint32_t n : {1u, 3u}) {
        INFO(n << " ranks");
        const auto errors = errors_of(n, [&](const elvis_communicator& own) {
            RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
            Rank rank(own, arrays.table, plan, mesh.path(std::to_string(n)));
            for (std::uint64_t step = 0; step < 5; ++step) {
                rank.step(step, 0.1 * static_cast<double>(step));
                for (double& value : arrays.values(0, 0)) {
                    value *= 2;
                }
            }
            return rank.error;
        });
        REQUIRE(errors == std::vector<std::string>(n));
        const std::string folder = std::to_string(n) + "/";
        const auto sums = rows_of(mesh.read(folder + "sums.csv"));
        REQUIRE(sums.size() == 5);
        for (std::size_t step = 0; step < sums.size(); ++step) {
            const double factor = std::pow(2, static_cast<double>(step));
            // The mean of x^2 is 1/3, and mixed terms are odd.
            const std::vector<double> expected{static_cast<double>(step),
                                               0.1 * static_cast<double>(step),
                                               factor * factor * 8 * 14 / 3,
                                               6 * factor,
                                               -6 * factor + 0.1 * static_cast<double>(step),
                                               8};
            for (std::size_t at = 0; at < expected.size(); ++at) {
                largest = std::max(largest, std::abs(sums[step][at] - expected[at]) / std::max(1.0, std::abs(expected[at])));
            }
        }
        const auto line = rows_of(mesh.read(folder + "line.csv"));
        REQUIRE(line.size() == 3 * 4);
        CHECK(line[4][0] == 2);
        CHECK(line[4][5] >= 0);
        largest = std::max(largest, std::abs(line[4][6] - 4 * (-0.9 + 0.2 + 0.6)));
        const auto points = rows_of(mesh.read(folder + "points.csv"));
        REQUIRE(points.size() == 2);
        CHECK(points[0][0] == 2);
        largest = std::max(largest, std::abs(points[0][7] - 2 * 4 * 3));
        CHECK(points[1][5] == -1);
        CHECK(std::isnan(points[1][6]));
        CHECK(mesh.read(folder + "large.csv") == "step,time,step\n2,0.2,2\n3,0.30000000000000004,3\n4,0.4,4\n");
    }
    std::printf("largest difference of reductions and samples from closed forms: %.1e\n", largest);
    CHECK(largest < 1e-12);
}

TEST_CASE("Values that change are drawn, and nothing is sent where they do not") {
    const Mesh mesh(waves);
    const std::string plan = plan_of(R"~("scene": {"image": {"size": [48, 36]}, "color_map": {"range": [-1, 1]},
        "surfaces": [{"type": "boundary"}]})~");
    std::vector<elvis_insitu_report> reports;
    const auto errors = errors_of(2, [&](const elvis_communicator& own) {
        RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
        Rank rank(own, arrays.table, plan, mesh.path(""));
        std::vector<double> moved = arrays.values(0, 0);
        const auto step = [&](std::uint64_t number) {
            rank.step(number, 0);
            if (own.rank == 1) {
                reports.push_back(rank.report());
            }
        };
        step(0);
        step(1);
        for (double& value : moved) {
            value *= -1;
        }
        elvis_insitu_set_values(rank.handle(), 0, 0, moved.data());
        step(2);
        for (double& value : moved) {
            value *= -1;
        }
        step(3);
        return rank.error;
    });
    REQUIRE(errors == std::vector<std::string>(2));
    CHECK(mesh.read("out_000000.png") == mesh.read("out_000001.png"));
    CHECK(mesh.read("out_000000.png") != mesh.read("out_000002.png"));
    CHECK(mesh.read("out_000000.png") == mesh.read("out_000003.png"));
    REQUIRE(reports.size() == 4);
    CHECK(reports[1].sent_bytes < reports[2].sent_bytes);
    CHECK(reports[2].read_bytes == 18 * 27 * sizeof(double));
    CHECK(reports[3].n_outputs == 1);
    CHECK(reports[3].device_bytes > 0);
    CHECK(reports[3].all_steps_seconds <= reports[3].run_seconds);
    std::printf("a step of 48 x 36 pixels on 2 ranks: %.3f s, %llu bytes sent, %llu with a field that has changed\n",
                reports[1].step_seconds, static_cast<unsigned long long>(reports[1].sent_bytes),
                static_cast<unsigned long long>(reports[2].sent_bytes));
}

TEST_CASE("What fails on one rank fails on all, with one text") {
    const Mesh mesh(waves);
    const std::string fine = plan_of(R"~("quantities": ["maximum(waves)"])~");
    // A plan of another rank, and arrays that are not there.
    const auto other_plan = errors_of(3, [&](const elvis_communicator& own) {
        const RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
        return Rank(own, arrays.table, own.rank == 2 ? fine + " " : fine, mesh.path("")).error;
    });
    CHECK(other_plan == std::vector<std::string>(3, "rank 2: plan: is not that of rank 0"));
    const auto no_geometry = errors_of(3, [&](const elvis_communicator& own) {
        RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
        elvis_array_class broken = arrays.table.classes[0];
        broken.geometry = nullptr;
        arrays.table.classes = own.rank == 1 ? &broken : arrays.table.classes;
        return Rank(own, arrays.table, fine, mesh.path("")).error;
    });
    CHECK(no_geometry == std::vector<std::string>(3, "rank 1: class 0: is NULL"));
    // A step before the last on one rank; afterwards the handle only says so.
    std::vector<std::string> again(2);
    std::vector<elvis_result> results(2);
    const auto in_order = errors_of(2, [&](const elvis_communicator& own) {
        const RankArrays arrays(*mesh.source, mesh.share(own.rank, own.size));
        Rank rank(own, arrays.table, fine, mesh.path(""));
        rank.step(5, 1);
        rank.step(own.rank == 1 ? 4 : 6, 2);
        // Checked afterwards, by one thread.
        results[own.rank] = elvis_insitu_step(rank.handle(), 7, 3);
        again[own.rank] = elvis_insitu_error(rank.handle());
        return rank.error;
    });
    CHECK(in_order ==
          std::vector<std::string>(2, "rank 1: step 4: comes after a later one, or its time is before that of one"));
    CHECK(results == std::vector<elvis_result>(2, ELVIS_ERROR_FAILED));
    CHECK(again[0] == "in situ: a call before this one has failed; the handle can only be released");
    // A communicator that breaks.
    const auto broken = errors_of(1, [&](const elvis_communicator& own) {
        const RankArrays arrays(*mesh.source, mesh.share(0, 1));
        elvis_communicator table = own;
        table.minimum = [](void*, double*, std::uint64_t) -> std::int32_t { return 7; };
        return Rank(table, arrays.table, fine, mesh.path("")).error;
    });
    CHECK(broken[0] == "communicator: minimum failed on rank 0: 7");
}

TEST_CASE("Plans that cannot be are refused, and name the place") {
    const Mesh mesh(waves);
    const std::vector<std::pair<std::string, std::string>> cases{
        {"{", "rank 0: plan: is no JSON"},
        {R"~({"version": 1})~", "'outputs' is missing"},
        {R"~({"version": 2, "outputs": []})~", "'version'"},
        {plan_of(R"~("quantities": ["maximum(pressure)"])~"), "pressure"},
        {plan_of(R"~("quantities": ["maximum(waves"])~"), "a parenthesis is not closed"},
        {plan_of(R"~("quantities": ["maximum(waves) + x"])~"), "only inside maximum()"},
        {plan_of(R"~("when": "maximum(waves) >", "quantities": ["step"])~"), "'maximum(waves) >'"},
        {plan_of(R"~("points": [[0, 0, 0]], "values": ["temperature"])~"), "temperature"},
        {plan_of(R"~("points": [[0, 0, 0]], "scene": {})~"), "must have one of"},
        {plan_of(R"~("every": 2, "times": [1], "points": [[0, 0, 0]])~"), "give one of the two"},
        {plan_of(R"~("color": 2, "points": [[0, 0, 0]])~"), "'outputs[0].color' is unknown"},
        {plan_of(R"~("buffers": true, "points": [[0, 0, 0]])~"), "goes with 'scene'"},
        {plan_of(R"~("scene": {"surfaces": [{"type": "streamlines", "flow": "waves"}]})~"), "streamlines"},
        {plan_of(R"~("scene": "missing.json")~"), "missing.json"},
        {plan_of(R"~("scene": {"field": "pressure"})~"), "pressure"},
        {R"~({"version": 1, "outputs": [{"name": "../a", "points": [[0, 0, 0]]}]})~", "'../a'"},
        {R"~({"version": 1, "outputs": [{"name": "a", "points": [[0, 0, 0]]}, {"name": "a", "quantities": ["step"]}]})~",
         "another output"}};
    for (const auto& [plan, text] : cases) {
        const std::vector<std::string> errors = errors_of(mesh, 2, plan);
        INFO(plan << "\n" << errors[0]);
        CHECK(errors[0] == errors[1]);
        CHECK(errors[0].find("rank 0: ") == 0);
        CHECK(errors[0].find(text) != std::string::npos);
    }
}

TEST_CASE("A table goes on where its run was begun before, and is not another's") {
    const Mesh mesh(waves);
    const std::string plan = plan_of(R"~("quantities": ["step + 0.5"])~");
    CHECK(errors_of(mesh, 1, plan)[0].empty());
    CHECK(errors_of(mesh, 1, plan)[0].empty());
    CHECK(mesh.read("out.csv") == "step,time,step + 0.5\n0,0,0.5\n0,0,0.5\n");
    CHECK(errors_of(mesh, 1, plan_of(R"~("quantities": ["step + 1"])~"))[0].find("has other columns") != std::string::npos);
    CHECK(mesh.read("out.csv") == "step,time,step + 0.5\n0,0,0.5\n0,0,0.5\n");
}

TEST_CASE("The page's plan works, and the page names every key") {
    const std::string page = read_file(ELVIS_INSITU_PAGE);
    const auto from = page.find("    {\n      \"version\""), to = page.find("\n    }\n", from);
    REQUIRE(to != std::string::npos);
    const Mesh mesh(R"({"generator": 1, "mesh": "box", "elements": 2, "fields": [{"field": "sphere", "name": "u"}]})");
    mesh.write("alarm.json", R"({"version": 1, "image": {"size": [32, 24]}})");
    const std::vector<std::string> errors = errors_of(mesh, 2, page.substr(from, to + 6 - from));
    CHECK(errors == std::vector<std::string>(2));
    CHECK(names_in(mesh).size() > 6);
    const auto schema = nlohmann::json::parse(read_file(ELVIS_INSITU_SCHEMA));
    for (const auto& [key, ignored] : schema["properties"]["outputs"]["items"]["properties"].items()) {
        INFO(key);
        CHECK(page.find("`" + key + "`") != std::string::npos);
    }
}
