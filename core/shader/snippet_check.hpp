/**
 * @file snippet_check.hpp
 * Whether a snippet keeps the promises of plugin_api/glsl_interface.md, as far as its names tell.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <string>
#include <vector>

namespace elvis {

/** A function of the GLSL interface that a snippet gives. */
struct SnippetFunction {
    const char* name;
    const char* signature;
    /** ELVIS_SNIPPET_... that announces it; 0: required. */
    std::uint32_t capability;
};

const std::vector<SnippetFunction>& snippet_functions();

/** The prefix in upper case, for macros. */
std::string macro_prefix(const Snippet& snippet);

/**
 * An Error at the source's "file:line" if the snippet lacks a function that is required or announced, gives one other
 * parameters, defines one that it does not announce or a name outside its prefix, or contains what snippets may not contain.
 */
void check_snippet(const Snippet& snippet);

/**
 * Messages of the compiler, one a line, with what helps where they are about the interface: the expected signature of a
 * function called or defined wrongly, the nearest name for an unknown elvis_... one.
 */
std::string explain_errors(const std::string& messages);

} // namespace elvis
