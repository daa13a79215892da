/**
 * @file request.hpp
 * A whole conversion, from file names to the native volume.
 */
#pragma once

#include <core/convert/convert.hpp>

#include <string>
#include <vector>

namespace elvis {

struct ConvertRequest {
    /** Geometry first, then field files. */
    std::vector<std::string> inputs;
    std::string output;
    /** Id of the conversion plugin; empty: the one surest of the first input. */
    std::string plugin;
    /** JSON; may be empty. */
    std::string plugin_options;
    ConvertOptions options;
};

/** In this process, or together with others. */
ConvertReport convert(const ConvertRequest& request, const TaskControl& control, Team* team = nullptr);

} // namespace elvis
