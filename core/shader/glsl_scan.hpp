/**
 * @file glsl_scan.hpp
 * What names a GLSL text uses and defines, found without a compiler.
 */
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace elvis {

/** Whether an identifier or a number may go on with this character. */
bool continues_identifier(char c);

/** Something that a text defines outside all functions. */
struct GlslDefinition {
    enum class Kind { function, prototype, type, constant, macro };
    std::string name;
    Kind kind = Kind::function;
    int line = 0;
    /** Of functions and prototypes: the result's type, and those of the parameters, with "out " or "inout " before them. */
    std::string type;
    std::vector<std::string> parameters;
};

struct GlslNames {
    /** Every identifier outside comments, those in preprocessor lines included. */
    std::set<std::string, std::less<>> identifiers;
    std::vector<GlslDefinition> definitions;
    /** The first line with #version, #extension or `layout`, none of which a snippet may contain; 0: there is none. */
    int forbidden_line = 0;
    std::string forbidden;
};

/**
 * Scans a text whose lines count from 1. Both branches of every #if count. Names that macros put together (##) are not seen,
 * nor those that a macro's expansion defines.
 */
GlslNames scan_glsl(std::string_view text);

} // namespace elvis
