/**
 * @file index_checks.hpp
 * A debug build of snippets: indices beyond the end of an array, a vector or a record are found in place of being undefined.
 */
#pragma once

#include <string>
#include <string_view>

namespace elvis {

/**
 * The text with every index of a named array, vector or matrix, in functions, passed through core_index (index_declarations),
 * which remembers the first that is out of range and gives 0 in its place. Literal indices, which the compiler checks, members
 * of structures, and names that only a macro declares are left alone. Lines keep their numbers.
 */
std::string check_indices(std::string_view text);

/**
 * What the checks need: the first index out of range, the number of entries there are, and the line within its file; line 0:
 * nothing was out of range.
 */
constexpr const char* index_declarations = R"(int core_bad_index_line = 0;
double core_bad_index = 0.0LF;
double core_bad_index_limit = 0.0LF;
void core_keep_bad_index(double index, double limit, int line) {
    if (core_bad_index_line == 0) {
        core_bad_index_line = line;
        core_bad_index = index;
        core_bad_index_limit = limit;
    }
}
int core_index(int index, int limit, int line) {
    if (index < 0 || index >= limit) {
        core_keep_bad_index(double(index), double(limit), line);
        return 0;
    }
    return index;
}
uint core_index(uint index, uint limit, int line) {
    if (index >= limit) {
        core_keep_bad_index(double(index), double(limit), line);
        return 0u;
    }
    return index;
}
uint core_index(uint index, int limit, int line) { return core_index(index, uint(limit), line); }
)";

} // namespace elvis
