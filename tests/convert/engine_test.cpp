// What the engine promises beside numbers: choices, provenance, cancelling, failing without a trace.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

using namespace elvis;
using Catch::Contains;

namespace {

const char* const three_fields = R"({"generator":1,"mesh":"ball","shape":"mixed","elements":2,"layers":2,"time_steps":3,
                                    "fields":["sphere",{"field":"waves","order":3},"taylor-green"]})";

std::string failure(const SourceVolume& source, const std::string& path, const ConvertOptions& options = {}) {
    try {
        convert(source, path, options, {});
    } catch (const Error& error) {
        return error.what();
    }
    return "no failure";
}

} // namespace

TEST_CASE("fields are chosen by name and order", "[convert]") {
    const SourceVolume source = generate(three_fields);
    ConvertOptions options;
    options.fields = {"velocity", "sphere"};
    const ConvertedVolume volume(source, options);
    REQUIRE(volume.description().fields.size() == 2);
    CHECK(volume.description().fields[0].name == "velocity");
    CHECK(volume.description().fields[0].n_components == 3);
    CHECK(volume.description().fields[1].name == "sphere");
    const native::Point xi{-0.5, -0.5, -0.5};
    const auto x = volume.position(7, xi);
    CHECK(volume.value(7, 1, xi) == Approx(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).epsilon(1e-13));
    CHECK(volume.value(7, 0, xi, nullptr, 2) == Approx(0).margin(1e-14));

    const TemporaryFolder folder;
    options.fields = {"speed"};
    CHECK_THAT(failure(source, folder.path("x.h5"), options),
               Contains("speed") && Contains("velocity") && Contains("pressure"));
    options.fields = {"sphere", "sphere"};
    CHECK_THAT(failure(source, folder.path("x.h5"), options), Contains("twice"));
    CHECK(names_in(folder).size() == 0);
}

TEST_CASE("every time step is converted", "[convert]") {
    const ConvertedVolume volume(generate(three_fields));
    CHECK(volume.description().times == std::vector<double>{0, 1, 2});
    const native::Point xi{-0.4, -0.6, -0.8};
    for (std::uint64_t element : {std::uint64_t{0}, volume.n_elements() - 1}) {
        const auto x = volume.position(element, xi);
        for (std::size_t step = 0; step < 3; ++step)
            CHECK(volume.value(element, 0, xi, nullptr, 0, step) ==
                  Approx(static_cast<double>(1 + step) * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2])).epsilon(1e-12));
    }
}

TEST_CASE("the result does not depend on the run", "[convert]") {
    const SourceVolume source = generate(three_fields);
    const ConvertedVolume first(source), second(source);
    for (std::uint64_t element = 0; element < first.n_elements(); ++element)
        REQUIRE(first.field_coefficients(element, 1, 0, 2) == second.field_coefficients(element, 1, 0, 2));
    CHECK(first.report().fields[1].residual == second.report().fields[1].residual);
    CHECK(first.report().fields[1].max_jump == second.report().fields[1].max_jump);
}

TEST_CASE("the file says where it comes from", "[convert]") {
    ConvertOptions options;
    options.program_version = "9.8.7";
    const ConvertedVolume volume(generate(three_fields), options);
    std::string notes;
    for (const auto& [key, value] : volume.description().notes)
        notes += key + "=" + value + "\n";
    CHECK_THAT(notes, Contains("description.json") && Contains("converter=org.elvis.generator") &&
                          Contains("converter version=") && Contains("9.8.7") && Contains("created=20"));
}

TEST_CASE("the report has the keys of the contract", "[convert]") {
    const ConvertedVolume volume(generate(three_fields));
    const auto report = nlohmann::json::parse(to_json(volume.report()));
    REQUIRE(report["fields"].size() == 4);
    CHECK(report["fields"][0]["name"] == "sphere");
    CHECK(report["fields"][0]["exact"] == true);
    CHECK(report["fields"][0]["residual"].get<double>() < 1e-12);
    CHECK(report["fields"][0]["mantissa_bits"] == 53);
    CHECK(report["fields"][1]["exact"] == false);
    std::uint64_t n_elements = 0;
    for (const char* shape : {"hexahedron", "prism", "pyramid", "tetrahedron"})
        n_elements += report["elements"][shape].get<std::uint64_t>();
    CHECK(n_elements == volume.n_elements());
    CHECK(report["seconds"].get<double>() > 0);
}

TEST_CASE("progress does not run backwards and cancelling leaves nothing", "[convert]") {
    const SourceVolume source = generate(R"({"generator":1,"mesh":"waves","elements":8,"field":"waves","order":4})");
    const TemporaryFolder folder;
    int n_stops = 0;
    for (const double stop : {-1.0, 0.0, 0.3, 0.7, 0.99, 2.0}) {
        TaskControl control;
        double last = 0;
        std::string phase;
        control.on_progress = [&](double fraction, std::string_view activity) {
            CHECK(fraction <= 1);
            if (fraction >= 0 && phase == activity)
                CHECK(fraction >= last);
            phase = activity;
            last = fraction;
            if (stop < 0 || (activity == "projecting" && fraction >= stop))
                control.cancelled = true;
        };
        try {
            convert(source, folder.path("x.h5"), {}, control);
        } catch (const Cancelled&) {
            ++n_stops;
            CHECK(names_in(folder).size() == 0);
        }
    }
    CHECK(n_stops == 5);
    CHECK(names_in(folder).size() == 1);
}

TEST_CASE("an output that cannot be written is an error that names it", "[convert]") {
    const SourceVolume source = generate(R"({"generator":1,"mesh":"box","elements":2,"field":"sphere"})");
    const TemporaryFolder folder;
    CHECK_THAT(failure(source, folder.path("missing/x.h5")), Contains("missing/x.h5"));
    CHECK_THAT(failure(source, "/proc/x.h5"), Contains("/proc/x.h5"));
    std::filesystem::create_directory(folder.path("directory"));
    CHECK_THAT(failure(source, folder.path("directory")), Contains("directory"));
    CHECK(names_in(folder).size() == 1);
}

TEST_CASE("an existing file stays until the new one is complete", "[convert]") {
    const SourceVolume source = generate(R"({"generator":1,"mesh":"box","elements":2,"field":"sphere"})");
    const TemporaryFolder folder;
    const std::string path = folder.write("x.h5", "old");
    TaskControl control;
    control.cancelled = true;
    CHECK_THROWS_AS(convert(source, path, {}, control), Cancelled);
    CHECK(std::filesystem::file_size(path) == 3);
    convert(source, path, {}, {});
    CHECK(std::filesystem::file_size(path) > 1000);
    CHECK(names_in(folder).size() == 1);
}

TEST_CASE("conversion is fast", "[convert]") {
    const SourceVolume source =
        generate(R"({"generator":1,"mesh":"waves","elements":12,"geometry_order":2,"order":6,"field":"waves"})");
    const TemporaryFolder folder;
    const ConvertReport report = convert(source, folder.path("x.h5"), {}, {});
    // A figure, not a promise: it depends on the machine and on what else runs there.
    std::printf("%.2g coefficients a second\n", static_cast<double>(report.n_coefficients) / report.seconds);
    CHECK(report.n_coefficients == 1728u * (81 + 343));
}
