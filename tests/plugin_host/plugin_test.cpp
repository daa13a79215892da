/*
 * Which libraries are plugins: the others are refused with the reason.
 */
#include "fixtures.hpp"

#include <core/plugin_host/runtime_volume.hpp>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::fixture;

namespace {

std::string refusal(const std::string& name) {
    const std::string text = error_of([&] { Plugin::load(fixture(name)); });
    CHECK_THAT(text, Contains(fixture(name).string()));
    return text;
}

/** Whether the library is in memory. */
bool is_loaded(const std::string& name) {
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        if (line.find(fixture(name).string()) != std::string::npos) {
            return true;
        }
    }
    return false;
}

} // namespace

TEST_CASE("a plugin in C is loaded, and tells who it is") {
    const auto plugin = Plugin::load(fixture("good"));
    CHECK(plugin->id() == "org.elvis.test.good");
    CHECK(plugin->name() == "Fixture");
    CHECK(plugin->version() == "1.2.3");
    CHECK(plugin->vendor().empty());
    CHECK(plugin->description().empty());
    CHECK(plugin->library() == fixture("good"));
    CHECK(plugin->abi_version() == ELVIS_ABI_VERSION);
    REQUIRE(plugin->runtime());
    REQUIRE(plugin->converter());
    CHECK(plugin->runtime()->get_faces == nullptr);
    CHECK(plugin->converter()->sample_world == nullptr);
}

TEST_CASE("a library that is no plugin is refused with the reason") {
    CHECK_THAT(refusal("does_not_exist"), Contains("cannot be loaded"));
    CHECK_THAT(refusal("not_a_library"), Contains("cannot be loaded"));
    CHECK_THAT(refusal("no_symbol"), Contains("does not export elvis_plugin_get_descriptor"));
    CHECK_THAT(refusal("null_descriptor"), Contains("cannot work on this machine"));
    CHECK_THAT(refusal("tiny_descriptor"), Contains("impossible size"));
    CHECK_THAT(refusal("other_major"),
               Contains("version " + std::to_string(ELVIS_ABI_VERSION_MAJOR + 1) + ".0") && Contains("a later ElVis"));
    CHECK_THAT(refusal("draft"), Contains("version 0.9") && Contains("compiled with the headers"));
    CHECK_THAT(refusal("no_name"), Contains("no name"));
    CHECK_THAT(refusal("bad_id"), Contains("My Plugin") && Contains("reverse-domain"));
    CHECK_THAT(refusal("no_interface"), Contains(ELVIS_RUNTIME_INTERFACE) && Contains(ELVIS_CONVERTER_INTERFACE));
    CHECK_THAT(refusal("no_function"), Contains("fill_buffer"));
}

TEST_CASE("a table may end before the host's, and what it does not have is absent") {
    const auto plugin = Plugin::load(fixture("shorter_table"));
    CHECK(plugin->abi_version() == ELVIS_ABI_VERSION_MAJOR << 16);
    CHECK(plugin->runtime()->get_element_numbers == nullptr);
    CHECK(plugin->runtime()->get_field_ranges == nullptr);
    const RuntimeVolume volume(plugin, "a.cube");
    CHECK(volume.n_elements() == 1);
    CHECK(volume.numbers_are_positions());
    CHECK_FALSE(volume.has_field_ranges());
    CHECK_FALSE(volume.has_jacobian_checks());
    std::int64_t number = -1;
    volume.element_numbers(0, 1, std::span(&number, 1));
    CHECK(number == 0);
}

TEST_CASE("a newer minor version works, and what this host does not know is passed over") {
    const auto plugin = Plugin::load(fixture("newer_minor"));
    CHECK(plugin->abi_version() > ELVIS_ABI_VERSION);
    CHECK(plugin->runtime()->struct_size == sizeof(elvis_runtime));
    const RuntimeVolume volume(plugin, "a.cube");
    const auto constants = volume.class_field(0, 0).constants;
    REQUIRE(constants.size() == 2);
    CHECK(constants[0] == std::pair<std::string, std::int64_t>("CUBE_FIRST", 11));
    CHECK(constants[1] == std::pair<std::string, std::int64_t>("CUBE_SECOND", 22));
    const Snippet snippet = volume.snippet(0);
    REQUIRE(snippet.sources.size() == 2);
    CHECK(snippet.sources[1].name == "second.glsl");
    CHECK(snippet.sources[1].text == "// second");
}

TEST_CASE("a library stays loaded as long as someone uses it, and no longer") {
    REQUIRE_FALSE(is_loaded("shorter_table"));
    {
        auto plugin = Plugin::load(fixture("shorter_table"));
        CHECK(is_loaded("shorter_table"));
        std::optional<RuntimeVolume> volume(std::in_place, std::move(plugin), "a.cube");
        CHECK(is_loaded("shorter_table"));
        CHECK(volume->plugin().id() == "org.elvis.test.shorter-table");
        volume.reset();
    }
    CHECK_FALSE(is_loaded("shorter_table"));
    error_of([] { Plugin::load(fixture("other_major")); });
    CHECK_FALSE(is_loaded("other_major"));
}
