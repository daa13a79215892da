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
 * An Error at the source's "file:line" if the snippet lacks a function that is required or announced, defines one that it does
 * not announce, defines a name outside its prefix, or contains what snippets may not contain.
 */
void check_snippet(const Snippet& snippet);

} // namespace elvis
