#include "fixture.hpp"

#include <core/base/error.hpp>
#include <core/expression/expression.hpp>

#include <catch2/catch.hpp>

#include <string>

using namespace elvis;
using namespace elvis::test;

namespace {

/** The message, or what was wrongly accepted. */
std::string message_of(const std::string& text, std::uint32_t dimension = 3) {
    try {
        const Expression expression(text, test_fields(), dimension);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

double value_of(const std::string& text) {
    CurvedPoint point({0.1, 0.2, 0.3});
    return evaluate(Expression(text, test_fields()), point);
}

} // namespace

TEST_CASE("errors name the text, the column and the cause") {
    struct Case {
        const char* text;
        std::size_t column;
        const char* cause;
    };
    const Case cases[] = {
        {"", 1, "nothing to evaluate"},
        {"p +", 4, "the text ends where a value is expected"},
        {"p + * 2", 5, "expected a value, found '*'"},
        {"2 p", 3, "expected an operator, found 'p'"},
        {"(p + 1", 7, "expected ')' after the '(' at column 1, found the end"},
        {"p + 1)", 6, "')' closes nothing"},
        {"sqrt(q)", 6, "'q' is unknown; the nearest name is 'p'"},
        {"jacobain", 1, "the nearest name is 'jacobian'"},
        {"sqr(p)", 1, "'sqr' is no function; the nearest is 'sqrt'"},
        {"1 + sqrt", 5, "'sqrt' is a function"},
        {"'heat flow'", 1, "there is no field 'heat flow'; the fields are 'p', 'u', 'heat flux', 'jacobian', 'v'"},
        {"\"heat flux", 1, "this quotation does not end"},
        {"u[3]", 2, "there is no component 3; components are counted from 0 to 2"},
        {"u[x]", 3, "expected the number of a component"},
        {"(p + 1)[0]", 8, "a number has no components"},
        {"atan2(p)", 1, "'atan2' wants 2 arguments, not 1"},
        {"min(p)", 1, "'min' wants 2 or more arguments"},
        {"sin(p, p)", 1, "'sin' wants 1 argument, not 2"},
        {"dot(u, p)", 8, "is a number, where dot wants a vector"},
        {"dot(u, v)", 8, "is a vector of 2, which has no product with a vector of 3"},
        {"cross(v, u)", 7, "is a vector of 2, where cross wants a vector of 3"},
        {"u + v", 5, "is a vector of 2, which cannot be combined with a vector of 3"},
        {"curl(p)", 6, "is a number, where curl wants a vector of 2 or 3"},
        {"1 + grad(u)", 5, "is a matrix of 3 x 3, where a number is wanted"},
        {"d(p, t)", 6, "expected x, y or z"},
        {"d(p)", 4, "expected ','"},
        {"d(d(d(p, x), x), x)", 1, "third derivatives"},
        {"laplacian(d(p, x))", 1, "third derivatives"},
        {"order(p + 1)", 9, "expected ')'"},
        {"order(2)", 7, "'order' wants a field"},
        {"1e999", 1, "beyond double precision"},
        {"p < 1 < 2", 7, "do not chain"},
        {"p ? 1", 6, "expected ':' after the '?' at column 3"},
        {"@q", 1, "'q' is unknown"},
        {"p $ 2", 3, "expected an operator, found '$'"},
    };
    for (const Case& one : cases) {
        const std::string message = message_of(one.text);
        INFO(message);
        std::string place("'");
        place.append(one.text).append("', column ").append(std::to_string(one.column)).append(": ");
        CHECK(message.find(place) != std::string::npos);
        CHECK(message.find(one.cause) != std::string::npos);
    }
    CHECK(message_of("@jacobian", 2).find("two-dimensional") != std::string::npos);
    CHECK(message_of("laplacian(p)", 2).find("for volumes") != std::string::npos);
    CHECK(message_of(std::string(100000, '(')).find("nested too deeply") != std::string::npos);
    CHECK(message_of(std::string(100000, '-') + "1").find("nested too deeply") != std::string::npos);
}

TEST_CASE("operators bind as in mathematics") {
    CHECK(value_of("1 + 2 * 3 ^ 2") == 19);
    CHECK(value_of("-2 ^ 2") == -4);
    CHECK(value_of("2 ^ -1") == 0.5);
    CHECK(value_of("2 ^ 3 ^ 2") == 512);
    CHECK(value_of("8 / 4 / 2 - 1 - 1") == -1);
    CHECK(value_of("1 < 2 && 2 <= 2 || 1 / 0 < 0") == 1);
    CHECK(value_of("!(1 == 2) + 1") == 2);
    CHECK(value_of("1 != 2 ? 5 : 2 > 1 ? 6 : 7") == 5);
    CHECK(value_of("3 > 4 ? 5 : 2 >= 3 ? 6 : 7") == 7);
    CHECK(value_of("  1.5e1\n+ .5 ") == 15.5);
    CHECK(value_of("min(3, 2, 5) + max(1, 4)") == 6);
    CHECK(value_of("2 * pi") == Approx(6.283185307179586));
    CHECK(value_of("log10(1000) + pow(2, 10)") == Approx(1027));
}

TEST_CASE("a vector is its magnitude where a number is wanted") {
    const double magnitude =
        std::sqrt(std::pow(value_of("u[0]"), 2) + std::pow(value_of("u[1]"), 2) + std::pow(value_of("u[2]"), 2));
    CHECK(value_of("u") == Approx(magnitude));
    CHECK(value_of("u + 1") == Approx(magnitude + 1));
    CHECK(value_of("u * u") == Approx(magnitude * magnitude));
    CHECK(value_of("u ^ 2") == Approx(magnitude * magnitude));
    CHECK(value_of("dot(u, u)") == Approx(magnitude * magnitude));
    CHECK(value_of("(2 * u / 4 - u)[1]") == Approx(-0.5 * value_of("u[1]")));
    CHECK(value_of("norm(-u)") == Approx(magnitude));
    CHECK(value_of("cross(u, 2 * u)") == Approx(0).margin(1e-14));
    CHECK(value_of("v") == Approx(std::hypot(value_of("v[0]"), value_of("v[1]"))));
    CHECK(value_of("grad(u)[1][2]") == value_of("d(u[1], z)"));
    CHECK(value_of("grad(p)[0]") == value_of("d(p, x)"));
    CHECK(value_of("curl(u)[2]") == Approx(value_of("d(u[1], x) - d(u[0], y)")));
    CHECK(value_of("vorticity(v)[2]") == Approx(value_of("d(v[1], x) - d(v[0], y)")));
    CHECK(value_of("div(u)") == Approx(value_of("d(u,x)[0] + d(u,y)[1] + d(u,z)[2]")));
    CHECK(value_of("q_criterion(u)") ==
          Approx(value_of("0.25 * (dot(curl(u), curl(u))) - 0.5 * (d(u[0],x)^2 + d(u[1],y)^2 + d(u[2],z)^2) - "
                          "0.25 * ((d(u[0],y) + d(u[1],x))^2 + (d(u[0],z) + d(u[2],x))^2 + (d(u[1],z) + d(u[2],y))^2)")));
}

TEST_CASE("fields go before built-in names, which have a spelling of their own") {
    CurvedPoint point({0.1, 0.2, 0.3});
    CHECK(value_of("jacobian") == point.value(3, 0));
    CHECK(value_of("'jacobian'[0]") == point.value(3, 0));
    const std::array<double, 9> j = point.jacobian();
    const double determinant =
        j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) + j[2] * (j[3] * j[7] - j[4] * j[6]);
    CHECK(value_of("@jacobian") == Approx(determinant));
    CHECK(value_of("scaled_jacobian") < 1);
    CHECK(value_of("scaled_jacobian") > 0.9);
    CHECK(value_of("order") == 7);
    CHECK(value_of("order(u[1])") == 1);
    CHECK(value_of("element") == 42);
    CHECK(value_of("\"heat flux\" + 'heat flux'") == Approx(2 * point.value(2, 0)));
}

TEST_CASE("expressions know what they rest on") {
    const auto parsed = [](const char* text) { return Expression(text, test_fields()); };
    CHECK(parsed("p + u[1] + u[2] + p").fields() == std::vector<std::uint32_t>{0, 1});
    CHECK(parsed("x + y * 0 * p").fields().empty());
    CHECK_FALSE(parsed("p + x").needs_gradients());
    CHECK(parsed("div(u)").needs_gradients());
    CHECK_FALSE(parsed("div(u)").needs_second_derivatives());
    CHECK(parsed("div(u)").gradient_needs_second_derivatives());
    CHECK(parsed("laplacian(p)").needs_second_derivatives());
    CHECK_FALSE(parsed("laplacian(p)").gradient());
    CHECK_FALSE(parsed("p * x").gradient_needs_second_derivatives());

    REQUIRE(parsed("(p)").plain());
    CHECK(parsed("p").plain()->component == 0);
    CHECK(parsed("u").plain()->component == -1);
    CHECK(parsed("u[2]").plain()->component == 2);
    CHECK(parsed("u[2]").plain()->field == 1);
    CHECK_FALSE(parsed("-u").plain());
    CHECK_FALSE(parsed("x").plain());
    CHECK_FALSE(parsed("grad(u)[1]").plain());
}

TEST_CASE("equal parts of an expression are one") {
    const Expression once("sin(p * u[0]) + 1", test_fields());
    const Expression twice("(sin(u[0] * p) + 1) * (sin(p * u[0]) + 1)", test_fields());
    const auto n = [](const Expression& expression) { return expression.graph().needed({expression.value()}).size(); };
    CHECK(n(twice) == n(once) + 1);
}

TEST_CASE(
    "fields of joined volumes are named with a dot, and differences of two are fields of their own where there are such") {
    const auto number = [](const char* name, std::uint32_t n_components) {
        FieldInfo info;
        info.name = name;
        info.n_components = n_components;
        return info;
    };
    const std::vector<FieldInfo> fields = {number("p", 1),   number("u", 3),       number("b.p", 1),    number("b.u", 3),
                                           number("b.q", 1), number("p - b.p", 1), number("u - b.u", 3)};
    const auto plain = [&](const char* text) { return Expression(text, fields).plain(); };
    CHECK(plain("b.q")->field == 4);
    CHECK(plain(" p-b.p ")->field == 5);
    CHECK(plain("u[1] - b.u[1]")->field == 6);
    CHECK(plain("u[1] - b.u[1]")->component == 1);
    CHECK(plain("(u - b.u)[2]")->component == 2);
    CHECK(!plain("b.p - p"));
    CHECK(!plain("p - b.q"));
    CHECK(!plain("u[0] - b.u[1]"));
    CHECK_THROWS_WITH(Expression("b.r", fields), Catch::Contains("'b' is unknown"));
    CHECK_THROWS_WITH(Expression("p.b", fields), Catch::Contains("expected an operator"));
}
