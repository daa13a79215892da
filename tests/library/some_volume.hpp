/**
 * @file some_volume.hpp
 * A context and a volume for tests of the library.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <string>

namespace elvis::test {

inline elvis_context_options own_plugins() {
    auto options = detail::sized<elvis_context_options>();
    options.plugin_path = ELVIS_TEST_PLUGINS;
    return options;
}

/** 27 bent hexahedra with the field p = x^2 y + z, about [0, 1]^3. */
inline constexpr const char* bent_box = R"({"generator": 1, "mesh": "waves", "elements": [3, 3, 3], "geometry_order": 2,
    "fields": [{"field": "polynomial", "name": "p", "coefficients": [[2, 1, 0, 1], [0, 0, 1, 1]]}]})";

/** What the generator makes of the description, in the folder. */
/** Into a file of that name; returns the report. */
inline std::string convert_to(const context& library, const TemporaryFolder& folder, const std::string& name,
                              const std::string& description) {
    const std::string input = folder.path("input.json"), output = folder.path(name);
    std::ofstream(input) << description;
    auto conversion = detail::sized<elvis_conversion>();
    const char* const inputs[] = {input.c_str()};
    conversion.n_inputs = 1;
    conversion.inputs = inputs;
    conversion.output = output.c_str();
    conversion.order = -1;
    return library.convert(conversion);
}

inline std::string convert(const context& library, const TemporaryFolder& folder, const char* description = bent_box) {
    CHECK_THAT(convert_to(library, folder, "volume.h5", description), Catch::Contains("\"exact\": true"));
    return folder.path("volume.h5");
}

/** The same, opened. */
inline data opened(const context& library, const TemporaryFolder& folder, const char* name, const std::string& description) {
    convert_to(library, folder, name, description);
    return library.open(folder.path(name));
}

} // namespace elvis::test
