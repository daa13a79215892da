#include <core/base/error.hpp>
#include <core/shader/glsl_scan.hpp>
#include <core/shader/includes.hpp>

#include <catch2/catch.hpp>

using namespace elvis;

namespace {

/** Definitions as "name kind line", in order. */
std::vector<std::string> definitions(const char* text) {
    constexpr const char* kinds[] = {"function", "prototype", "type", "constant", "macro"};
    std::vector<std::string> result;
    for (const GlslDefinition& definition : scan_glsl(text).definitions) {
        result.push_back(definition.name + " " + kinds[static_cast<int>(definition.kind)] + " " +
                         std::to_string(definition.line));
    }
    return result;
}

using Texts = std::vector<std::string>;

} // namespace

TEST_CASE("Identifiers are found outside comments and numbers") {
    const auto names =
        scan_glsl("int a_1 = 0x1fu; // hidden\n/* also\nhidden2 */ float b=1.0LF+c2;\n#if D\n#endif\n").identifiers;
    CHECK(names == std::set<std::string, std::less<>>{"int", "a_1", "float", "b", "c2", "if", "D", "endif"});
}

TEST_CASE("Definitions are found outside functions, with kind and line") {
    CHECK(definitions("const float a = b(1), c[2] = float[2](d, e);\n\nfloat[2] f(in float g) { float h = 1; return k(h); }") ==
          Texts{"a constant 1", "c constant 1", "f function 3"});
    CHECK(definitions("struct s { float member; };\ns f(s x);\nshared uint counter;\n") ==
          Texts{"s type 1", "f prototype 2", "counter constant 3"});
    CHECK(definitions("#define ONE 1\n # define TWO(x) \\\n  x + f(1)\n// #define THREE\n#define FOUR\nvoid f() {}") ==
          Texts{"ONE macro 1", "TWO macro 2", "FOUR macro 5", "f function 6"});
    // Branches of #if are alternatives, whose braces must not add up.
    CHECK(definitions("void f() {\n#if A\n  if (x) {\n#else\n  if (y) {\n#endif\n  }\n}\nvoid g() {}") ==
          Texts{"f function 1", "g function 9"});
}

TEST_CASE("What snippets may not contain is found") {
    CHECK(scan_glsl("\n#extension GL_EXT_x : enable\n").forbidden_line == 2);
    CHECK(scan_glsl("layout(local_size_x = 8) in;").forbidden == "layout");
    CHECK(scan_glsl("float layouts() { return 1; } // layout #version").forbidden_line == 0);
}

TEST_CASE("Includes are expanded with the line of every file kept") {
    const auto resolve = [](std::string_view name) -> std::string_view {
        if (name == "inner") {
            return "inner line\n";
        }
        throw Error("there is no '" + std::string(name) + "'");
    };
    CHECK(expand_includes("first\n#include \"inner\"\nthird\n", "outer", resolve) ==
          "#line 1 \"outer\"\nfirst\n#line 1 \"inner\"\ninner line\n#line 3 \"outer\"\nthird\n");
    CHECK(expand_includes("#version 460\n//#include \"a\"\n/*\n#include \"b\"\n*/ # include \"inner\"", "o", resolve) ==
          "#version 460\n#extension GL_GOOGLE_cpp_style_line_directive : require\n#line 2 \"o\"\n//#include \"a\"\n/*\n"
          "#include \"b\"\n*/ # include \"inner\"\n");
    CHECK_THROWS_WITH(expand_includes("\n#include \"nothing\"\n", "outer", resolve), "outer:2: there is no 'nothing'");
    CHECK_THROWS_WITH(expand_includes("\n#include nothing\n", "outer", resolve), Catch::Contains("outer:2:"));
    const auto cyclic = [](std::string_view) -> std::string_view { return "#include \"a\"\n"; };
    CHECK_THROWS_WITH(expand_includes("#include \"a\"\n", "b", cyclic), Catch::Contains("include itself"));
}
