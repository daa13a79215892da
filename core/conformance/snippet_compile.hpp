/**
 * @file snippet_compile.hpp
 * Compiles a snippet from its file: alone, with stand-ins for what its plugin gives, or in place of a source of its plugin.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/conformance/check.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace elvis::conformance {

/** What a plugin would say about a snippet. */
struct SnippetSurroundings {
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    std::uint32_t n_components = 1;
    /** None: what most of the snippet's names begin with. */
    std::optional<std::string> prefix;
    /** Constants of get_class_field; others that the snippet uses are 1. */
    std::map<std::string, std::int64_t> constants;
    /** Buffers of kind UINT; the others are REAL. */
    std::vector<std::string> uint_buffers;
};

/** What was compiled, and what was taken to be so. */
struct SnippetReport {
    std::size_t n_kernels = 0;
    std::vector<std::string> notes;
};

/** The file and those below its folder that it includes; the first is the file. Library files stay out. */
std::vector<SnippetText> read_snippet(const std::string& path);

/** In both precisions, without a device. An Error names file and line. */
SnippetReport compile_alone(const std::string& path, const SnippetSurroundings& surroundings);

/** Every class and field whose snippet has a source of the file's name, with the file instead. */
SnippetReport compile_in_plugin(const std::string& path, Subject subject);

/**
 * What the plugin's snippet gives at a point of an element, one line a function, and the numbers that it gave to elvis_debug
 * there; in single precision if `in_float32`. With the file in place of the source of its name.
 */
std::vector<std::string> evaluate_at(const std::string& path, const Subject& subject, std::uint64_t element, const Vector3& xi,
                                     bool in_float32);

} // namespace elvis::conformance
