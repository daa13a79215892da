// The reference page has an entry for every function of the interface, with everything that an entry is to say.

#include <core/shader/snippet_check.hpp>

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using elvis::test::read_file;

namespace {

const std::string api = ELVIS_PLUGIN_API;

/** "elvis_runtime.get_info" for every function pointer of every struct in a header. */
std::vector<std::string> table_functions(const std::string& header) {
    std::vector<std::string> names;
    const std::string text = read_file(api + "/include/elvis/" + header);
    const std::regex structs(R"((?:typedef )?struct (elvis_\w+) \{([\s\S]*?)\n\})");
    for (std::sregex_iterator found(text.begin(), text.end(), structs), end; found != end; ++found) {
        const std::string body = (*found)[2];
        const std::regex pointers(R"(\(\*(\w+)\)\()");
        for (std::sregex_iterator function(body.begin(), body.end(), pointers); function != end; ++function) {
            names.push_back((*found)[1].str() + "." + (*function)[1].str());
        }
    }
    return names;
}

/** Entries by title; a title may name several functions, separated by commas. */
std::map<std::string, std::string> read_entries() {
    std::map<std::string, std::string> entries;
    std::istringstream lines(read_file(api + "/reference.md"));
    std::vector<std::string> titles;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("#", 0) == 0) {
            titles.clear();
            std::istringstream words(line.rfind("### ", 0) == 0 ? line.substr(4) : "");
            for (std::string word; words >> word;) {
                titles.push_back(word.substr(0, word.find(',')));
            }
        }
        for (const std::string& title : titles) {
            entries[title] += line + "\n";
        }
    }
    return entries;
}

void check_entry(const std::map<std::string, std::string>& entries, const std::string& name) {
    INFO(name);
    const auto entry = entries.find(name);
    REQUIRE(entry != entries.end());
    for (const char* part : {"| Shapes | ", "| Units | ", "| Ownership | ", "| Thread | ", "| Errors | ", "```"}) {
        INFO(part);
        CHECK(entry->second.find(part) != std::string::npos);
    }
}

} // namespace

TEST_CASE("Every function of the C headers has an entry in the reference") {
    const auto entries = read_entries();
    std::size_t n = 0;
    for (const char* header : {"host.h", "plugin.h", "runtime.h", "converter.h", "extrema.h", "apex_bounds.h"}) {
        for (const std::string& name : table_functions(header)) {
            check_entry(entries, name);
            ++n;
        }
    }
    check_entry(entries, "elvis_plugin_get_descriptor");
    CHECK(n >= 40); // 4 of the host, 1 of the descriptor, 21 of runtime, 12 of converter, 1 of extrema, 1 of apex_bounds
}

TEST_CASE("Every function of the GLSL interface has an entry in the reference and stands in glsl_interface.md") {
    const auto entries = read_entries();
    const std::string page = read_file(api + "/glsl_interface.md");
    for (const elvis::SnippetFunction& function : elvis::snippet_functions()) {
        check_entry(entries, function.name);
        CHECK(page.find(function.name) != std::string::npos);
    }
    for (const char* name :
         {"elvis_fetch_NAME", "elvis_fetch4_NAME", "elvis_origin", "elvis_sin", "elvis_pow", "elvis_debug"}) {
        check_entry(entries, name);
    }
}
