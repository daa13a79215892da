// What helps people who write snippets: signatures, hints, and the debug build that finds outputs never written and endless
// loops.
#include "fixture.hpp"

#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>
#include <core/shader/glsl_scan.hpp>
#include <core/shader/index_checks.hpp>
#include <core/shader/poison.hpp>
#include <core/shader/snippet_check.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace elvis;

namespace {

std::string complaint(const Snippet& snippet) {
    try {
        check_snippet(snippet);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/** The snippet with a part of its first source replaced. */
Snippet changed(Snippet snippet, const std::string& what, const std::string& by) {
    std::string& text = snippet.sources.front().text;
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    text.replace(at, what.size(), by);
    return snippet;
}

} // namespace

TEST_CASE("Functions with other parameters or another type than the interface's are refused with its signature") {
    const Snippet good = test::simple_snippet();
    REQUIRE(complaint(good).empty());
    for (const char* signature : {"elvis_real elvis_field_value(uint element, elvis_vec3 xi)",
                                  "elvis_real elvis_field_value(uint element, uint component, elvis_vec3 xi)",
                                  "elvis_vec3 elvis_field_value(uint element, elvis_vec3 xi, uint component)",
                                  "elvis_real elvis_field_value(uint element, out elvis_vec3 xi, uint component)"}) {
        INFO(signature);
        const Snippet bad =
            changed(good, "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component)", signature);
        CHECK(contains(complaint(bad), "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component)"));
        CHECK(contains(complaint(bad), good.sources.front().name + ":"));
    }
    // Qualifiers that change nothing are fine.
    CHECK(complaint(changed(good, "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component)",
                            "elvis_real elvis_field_value(in uint element, const in elvis_vec3 xi, const uint component)"))
              .empty());
}

TEST_CASE("Messages about the interface say what it has") {
    CHECK(contains(explain_errors("a.glsl:3: 'elvis_sinn' : no matching overloaded function found"), "nearest is elvis_sin"));
    CHECK(contains(explain_errors("a.glsl:3: 'elvis_mapping' : no matching overloaded function found"),
                   "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi)"));
    CHECK(contains(explain_errors("a.glsl:3: 'elvis_fetch_mods' : no matching overloaded function found"), "no buffer"));
    CHECK(contains(explain_errors("a.glsl:3: 'sin' : no matching overloaded function found"), "take elvis_sin"));
    CHECK(explain_errors("a.glsl:3: '' : syntax error\nb.glsl:4: other") == "a.glsl:3: '' : syntax error\nb.glsl:4: other");
}

TEST_CASE("The debug build poisons every output and counts every loop with braces, and keeps lines") {
    const std::string text = "void elvis_field_gradient(uint element, elvis_vec3 xi, uint component,\n"
                             "                          out elvis_real value, out elvis_vec3 gradient) {\n"
                             "    for (int i = 0; i < 3; ++i) { value = 1; }\n"
                             "    while (value > 3) { value -= 1; }\n"
                             "    do { value += 1; } while (value < 0);\n"
                             "    // for (;;) { a comment }\n"
                             "    for (int i = 0; i < 3; ++i) value += 1;\n"
                             "    if (value > 0) { value = 0; }\n"
                             "}\n";
    const std::string poisoned = poison_outputs(text, scan_glsl(text));
    CHECK(contains(poisoned, " value = elvis_real("));
    CHECK(contains(poisoned, " gradient = elvis_vec3("));
    CHECK(std::count(poisoned.begin(), poisoned.end(), '\n') == std::count(text.begin(), text.end(), '\n'));
    std::size_t n_counts = 0;
    for (std::size_t at = poisoned.find("++core_loop_iterations"); at != std::string::npos;
         at = poisoned.find("++core_loop_iterations", at + 1)) {
        ++n_counts;
    }
    CHECK(n_counts == 3);
}

TEST_CASE("The debug build checks indices of what is declared by name, and keeps lines") {
    const std::string text = "const elvis_real table[4] = elvis_real[4](1, 2, 3, 4);\n"
                             "elvis_real value(int i, elvis_mat3 m, elvis_real given[2]) {\n"
                             "    uvec3 word = uvec3(0);\n"
                             "    elvis_real first[2] = elvis_real[2](1, 2), local[SIZE]; // local[i] in a comment\n"
                             "    local[3] = s.local[i] + m[i][1] + m[0][i + 1];\n"
                             "    return table[word[i]] + first[i] + given[unknown[i]];\n"
                             "}\n";
    const std::string checked = check_indices(text);
    CHECK(contains(checked, "table[4] = elvis_real[4](1"));
    CHECK(contains(checked, "local[SIZE]; // local[i] in"));
    CHECK(contains(checked, "local[3] = s.local[i] + m[core_index(i, m.length(), __LINE__)][1] + "
                            "m[0][core_index(i + 1, m[0].length(), __LINE__)];"));
    CHECK(contains(checked, "table[core_index(word[core_index(i, word.length(), __LINE__)], table.length(), __LINE__)]"));
    CHECK(contains(checked, "first[2] = elvis_real[2](1, 2), local[SIZE];"));
    CHECK(contains(checked, "first[core_index(i, first.length(), __LINE__)]"));
    CHECK(contains(checked, "given[core_index(unknown[i], given.length(), __LINE__)]"));
    CHECK(std::count(checked.begin(), checked.end(), '\n') == std::count(text.begin(), text.end(), '\n'));
}

namespace {

/** The simple snippet in a kernel, without a device. */
KernelRequest request_without_device(const char* title) {
    KernelRequest request;
    request.name = title;
    request.kernel = "conformance/conformance.comp";
    SnippetInstance instance;
    instance.snippet = test::simple_snippet();
    instance.constants = {};
    // Stand-ins for its buffers.
    for (const std::string& name : scan_glsl(instance.snippet.sources.front().text).identifiers) {
        if (name.rfind("elvis_fetch4_", 0) == 0) {
            request.defines.emplace_back(name + "(record, index)", "elvis_vec4(0)");
        } else if (name.rfind("elvis_fetch_", 0) == 0) {
            request.defines.emplace_back(name + "(record, index)", "elvis_real(0)");
        }
    }
    request.instances = {instance};
    return request;
}

} // namespace

TEST_CASE("A snippet's debug build compiles without a device") {
    KernelRequest request = request_without_device("debug build");
    request.is_debug_build = true;
    CHECK_FALSE(compile_shader(compose_text(request), request.name).empty());
}

TEST_CASE("A snippet can ask for the version of the interface") {
    KernelRequest request = request_without_device("version");
    std::string& text = request.instances[0].snippet.sources[0].text;
    const std::string version =
        std::to_string(ELVIS_ABI_VERSION_MAJOR) + " * 65536 + " + std::to_string(ELVIS_ABI_VERSION_MINOR);
    const std::string plain = text;
    text = "#if ELVIS_GLSL_VERSION < " + version + "\n#error too old\n#endif\n" + plain;
    CHECK_FALSE(compile_shader(compose_text(request), request.name).empty());
    text = "#if ELVIS_GLSL_VERSION >= " + version + "\n#error as new as this\n#endif\n" + plain;
    CHECK_THROWS_WITH(compile_shader(compose_text(request), request.name), Catch::Contains("as new as this"));
}
