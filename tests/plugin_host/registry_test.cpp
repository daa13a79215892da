/*
 * Where plugins are looked for, and which one serves a file.
 */
#include "fixtures.hpp"

#include <algorithm>

using namespace elvis;
using Catch::Matchers::Contains;
using test::Environment;
using test::error_of;
using test::fixture;
using test::TemporaryFolder;

namespace {

const RefusedPlugin* refused(const PluginRegistry& registry, const std::string& name) {
    for (const RefusedPlugin& entry : registry.refused()) {
        if (entry.library.filename() == name + ".so") {
            return &entry;
        }
    }
    return nullptr;
}

/** A registry of the fixtures alone. */
struct Fixtures {
    TemporaryFolder home;
    Environment home_variable{"HOME", home.path().c_str()};
    Environment data_variable{"XDG_DATA_HOME", nullptr};
    Environment path_variable{"ELVIS_PLUGIN_PATH", ELVIS_FIXTURES};
    PluginRegistry registry;
};

} // namespace

TEST_CASE("the search path is the variable, the user's folder, the installation") {
    const Environment path("ELVIS_PLUGIN_PATH", "/first::/second");
    const Environment home("HOME", "/home/ada");
    {
        const Environment data("XDG_DATA_HOME", nullptr);
        const auto folders = PluginRegistry::search_path();
        REQUIRE(folders.size() >= 4);
        CHECK(folders[0] == "/first");
        CHECK(folders[1] == "/second");
        CHECK(folders[2] == "/home/ada/.local/share/elvis/plugins");
        const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
        CHECK(folders[3] == program.parent_path().parent_path() / "lib/elvis/plugins");
    }
    const Environment data("XDG_DATA_HOME", "/data");
    CHECK(PluginRegistry::search_path()[2] == "/data/elvis/plugins");
}

TEST_CASE("folders that do not exist are no error") {
    const Environment path("ELVIS_PLUGIN_PATH", "/does/not/exist");
    const Environment data("XDG_DATA_HOME", "/does/not/exist/either");
    const PluginRegistry registry;
    CHECK(registry.plugins().empty());
    CHECK(registry.refused().empty());
}

TEST_CASE("good plugins are found beside misbehaving ones, and each refusal has its reason") {
    const Fixtures fixtures;
    std::vector<std::string> ids;
    for (const auto& plugin : fixtures.registry.plugins()) {
        ids.push_back(plugin->id());
    }
    CHECK(ids == std::vector<std::string>{"org.elvis.test.good", "org.elvis.test.newer-minor", "org.elvis.test.sampled",
                                          "org.elvis.test.shorter-table", "org.elvis.test.troubled",
                                          "org.elvis.test.troubled-source", "org.elvis.test.world-source"});
    for (const char* name : {"bad_id", "draft", "no_function", "no_interface", "no_name", "no_symbol", "not_a_library",
                             "null_descriptor", "other_major", "tiny_descriptor", "good_again"}) {
        INFO(name);
        const RefusedPlugin* entry = refused(fixtures.registry, name);
        REQUIRE(entry);
        CHECK_FALSE(entry->reason.empty());
    }
    CHECK(fixtures.registry.refused().size() == 11);
}

TEST_CASE("the first plugin with an id wins, across folders too") {
    const TemporaryFolder first;
    std::filesystem::copy_file(fixture("good_again"), first.path() / "zzz.so");
    const std::string both = first.path().string() + ":" + ELVIS_FIXTURES;
    const Environment path("ELVIS_PLUGIN_PATH", both.c_str());
    const PluginRegistry registry;
    CHECK(registry.find("org.elvis.test.good")->library() == first.path() / "zzz.so");
    const RefusedPlugin* second = refused(registry, "good");
    REQUIRE(second);
    CHECK_THAT(second->reason, Contains("org.elvis.test.good") && Contains("zzz.so"));
}

TEST_CASE("an unknown id is answered with those that are known") {
    const Fixtures fixtures;
    CHECK_THAT(error_of([&] { fixtures.registry.find("org.elvis.nothing"); }),
               Contains("org.elvis.nothing") && Contains("org.elvis.test.good"));
}

TEST_CASE("the plugin that is surest of a file serves it") {
    const Fixtures fixtures;
    const std::string cube = fixtures.home.write("a.cube", "");
    CHECK(fixtures.registry.runtime_for(cube)->id() == "org.elvis.test.good");
    const std::string tetrahedron = fixtures.home.write("a.tetrahedron", "");
    CHECK(fixtures.registry.converter_for(tetrahedron)->id() == "org.elvis.test.good");
}

TEST_CASE("a file that no plugin reads is answered with what broken probes said, and no list of the others") {
    const Fixtures fixtures;
    const std::string with_text = fixtures.home.write("probe-with-text", "");
    CHECK_THAT(error_of([&] { fixtures.registry.runtime_for(with_text); }),
               Contains("no runtime plugin") && !Contains("org.elvis.test.good") &&
                   Contains("org.elvis.test.troubled: " + with_text + ": byte 0: the probe broke"));
    const std::string without_text = fixtures.home.write("probe-without-text", "");
    CHECK_THAT(error_of([&] { fixtures.registry.runtime_for(without_text); }),
               Contains("org.elvis.test.troubled: ") && Contains("out of memory"));
    CHECK_THAT(error_of([&] { fixtures.registry.converter_for(with_text); }), Contains("no conversion plugin"));
    CHECK_THAT(error_of([&] { fixtures.registry.runtime_for("/does/not/exist"); }), Contains("there is no such file"));
}
