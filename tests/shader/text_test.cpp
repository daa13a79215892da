#include <core/base/error.hpp>
#include <core/shader/include.hpp>
#include <core/shader/tokens.hpp>

#include <catch2/catch.hpp>

using namespace elvis;

TEST_CASE("Identifiers are found outside comments and numbers") {
    const auto names = identifiers("int a_1 = 0x1fu; // hidden\n/* also\nhidden2 */ float b=1.0LF+c2;");
    REQUIRE(names == std::set<std::string>{"int", "a_1", "float", "b", "c2"});
    REQUIRE(defined_macros("#define ONE 1\n # define TWO(x) x\n// #define THREE\n") == std::set<std::string>{"ONE", "TWO"});
}

TEST_CASE("Includes are expanded with the line of every file kept") {
    const auto resolve = [](std::string_view name) -> std::string_view {
        if (name == "inner") {
            return "inner line\n";
        }
        throw Error("there is no '" + std::string(name) + "'");
    };
    REQUIRE(expand_includes("first\n#include \"inner\"\nthird\n", "outer", resolve) ==
            "first\n#line 1 \"inner\"\ninner line\n#line 3 \"outer\"\nthird\n");
    REQUIRE_THROWS_WITH(expand_includes("\n#include \"nothing\"\n", "outer", resolve), "outer:2: there is no 'nothing'");
    const auto cyclic = [](std::string_view) -> std::string_view { return "#include \"a\"\n"; };
    REQUIRE_THROWS_AS(expand_includes("#include \"a\"\n", "b", cyclic), Error);
}
