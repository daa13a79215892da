// Links of the pages for plugin authors lead somewhere, in the sources and where they are installed.

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

const fs::path api = ELVIS_PLUGIN_API;

/** Follows the relative links of a page; returns how many. */
int follow_links(const fs::path& page) {
    const std::string all = elvis::test::read_file(page);
    const std::regex links(R"(\]\(([^)#]+)(#[^)]*)?\))");
    int n = 0;
    for (std::sregex_iterator found(all.begin(), all.end(), links), end; found != end; ++found) {
        const std::string target = (*found)[1];
        if (target.find("://") != std::string::npos) {
            continue;
        }
        INFO(page.string() << " links to " << target);
        CHECK(fs::exists(page.parent_path() / target));
        ++n;
    }
    return n;
}

int follow_all_links(const fs::path& folder) {
    int n = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".md") {
            n += follow_links(entry.path());
        }
    }
    return n;
}

} // namespace

TEST_CASE("Links of the pages for plugin authors lead somewhere") {
    CHECK(follow_all_links(api) > 20);
    CHECK(follow_all_links(api / "../plugins") > 5);
}

TEST_CASE("Links of the installed pages lead somewhere, and the examples are there") {
    const fs::path prefix = fs::path(ELVIS_WORK) / "links";
    fs::remove_all(prefix);
    REQUIRE(std::system(("'" CMAKE_PROGRAM "' --install '" ELVIS_BUILD "' --component plugin_api --prefix '" + prefix.string() +
                         "' >/dev/null")
                            .c_str()) == 0);
    const fs::path pages = prefix / "share/doc/ElVis";
    CHECK(follow_all_links(pages) > 30);
    for (const char* example : {"analytic", "cut_cells", "dubiner_dg", "elvis_dat", "lattice", "nurbs"}) {
        INFO(example);
        CHECK(fs::exists(pages / "examples" / example / "plugin.cpp"));
        CHECK(fs::exists(pages / "examples" / example / "README.md"));
    }
}
