#include "fixture.hpp"

#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>

using namespace elvis;

namespace {

/** Makes a device with some environment variables set. */
class Environment {
public:
    Environment(std::initializer_list<std::pair<const char*, const char*>> variables) {
        for (const auto& [name, value] : variables) {
            ::setenv(name, value, 1);
            m_names.push_back(name);
        }
    }
    ~Environment() {
        for (const char* name : m_names) {
            ::unsetenv(name);
        }
    }

private:
    std::vector<const char*> m_names;
};

Snippet scaled_snippet() {
    return {0,
            "scaled",
            {{"scaled.glsl",
              "#include \"helper.glsl\"\n"
              "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return xi; }\n"
              "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) { return elvis_mat3(1); }\n"
              "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {\n"
              "    return scaled_factor() * elvis_fetch_numbers(element, 5u) + elvis_fetch4_numbers(element, 0u).z;\n"
              "}\n"},
             {"helper.glsl", "#define SCALED_TWICE(x) (2 * (x))\nelvis_real scaled_factor() { return "
                             "elvis_real(SCALED_TWICE(SCALED_FACTOR)); }\n"}}};
}

} // namespace

TEST_CASE("Two instances of a snippet read their own buffers on every kind of binding") {
    const bool texel = GENERATE(true, false);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const bool split = GENERATE(false, true);
    CAPTURE(texel, static_cast<int>(precision), split);
    const Environment environment{{"ELVIS_DATA_BUFFERS", texel ? "texel" : "storage"},
                                  {"ELVIS_MAX_BINDING_BYTES", split ? "4096" : "134217728"}};
    const Device device({}, true);

    constexpr std::uint32_t n = 256;
    std::vector<double> first(6 * n);
    std::vector<double> second(6 * n);
    for (std::size_t i = 0; i < first.size(); ++i) {
        first[i] = static_cast<double>(i) + 0.25;
        second[i] = -static_cast<double>(i);
    }
    const RecordBuffer first_records(device, RecordKind::real, precision, n, 6);
    const RecordBuffer second_records(device, RecordKind::real, precision, n, 6);
    const RecordBuffer counts(device, RecordKind::uint, precision, n, 1);
    first_records.write_reals(0, first);
    second_records.write_reals(0, second);
    std::vector<std::uint32_t> ones(n, 3);
    counts.write_uints(0, ones);
    REQUIRE((first_records.n_parts() > 1) == split);

    KernelRequest request;
    request.name = "test";
    request.kernel = "conformance/compose_check.comp";
    request.precision = precision;
    request.buffers = {{"counts", &counts}};
    request.bindings = {{0, BindingType::storage_buffer}};
    SnippetInstance instance;
    instance.snippet = scaled_snippet();
    instance.constants = {{"SCALED_FACTOR", 1}};
    instance.buffers = {{"numbers", &first_records}};
    request.instances.push_back(instance);
    instance.constants = {{"SCALED_FACTOR", 5}};
    instance.buffers = {{"numbers", &second_records}};
    request.instances.push_back(instance);

    const ComposedKernel kernel(device, request);
    const Buffer output(device, n * 2 * sizeof(float));
    const std::array<const Buffer*, 1> bindings{&output};
    kernel.dispatch(bindings, {}, n / 8);
    const std::vector<float> result = output.read_items<float>(2 * n);
    for (std::uint32_t i = 0; i < n; ++i) {
        REQUIRE(result[2 * i] == static_cast<float>(2 * first[6 * i + 5] + first[6 * i + 2] + 3));
        REQUIRE(result[2 * i + 1] == static_cast<float>(10 * second[6 * i + 5] + second[6 * i + 2] + 3));
    }
    REQUIRE(device.validation_messages().empty());
}

TEST_CASE("A snippet's errors name its own file and line") {
    const Device device;
    KernelRequest request;
    request.name = "test";
    request.kernel = "conformance/compose_check.comp";
    request.bindings = {{0, BindingType::storage_buffer}};
    SnippetInstance instance;
    instance.snippet = scaled_snippet();
    instance.constants = {{"SCALED_FACTOR", 1}};

    SECTION("unknown name") {
        instance.snippet.sources[1].text = "\nelvis_real scaled_factor() { return nonsense; }\n";
        request.instances = {instance};
        REQUIRE_THROWS_WITH(ComposedKernel(device, request).build(),
                            Catch::Contains("helper.glsl:2:") && Catch::Contains("nonsense"));
    }
    SECTION("missing function") {
        instance.snippet.sources[0].text = "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return xi; }\n";
        request.instances = {instance};
        REQUIRE_THROWS_WITH(ComposedKernel(device, request).build(),
                            Catch::Contains("scaled.glsl") &&
                                Catch::Contains("elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi)"));
    }
    SECTION("missing include") {
        instance.snippet.sources.pop_back();
        request.instances = {instance};
        REQUIRE_THROWS_WITH(ComposedKernel(device, request).build(),
                            Catch::Contains("scaled.glsl:1") && Catch::Contains("helper.glsl"));
    }
}

namespace {

/** What composing a kernel of this snippet complains about; empty if nothing. */
std::string complaint(const Device& device, const Snippet& snippet) {
    KernelRequest request;
    request.name = "test";
    request.kernel = "test.comp";
    request.kernel_text = "layout(local_size_x = 8) in;\nvoid main() {}\n";
    SnippetInstance instance;
    instance.snippet = snippet;
    request.instances = {instance};
    try {
        ComposedKernel(device, request).build();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("A snippet that breaks the rules is refused with its own file and line") {
    const test::CacheFolder cache;
    const Device device;
    Snippet snippet = test::simple_snippet();
    std::string& text = snippet.sources[0].text;
    REQUIRE(complaint(device, snippet) == "");
    const std::string gradient =
        "\nvoid elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value,\n"
        "    out elvis_vec3 gradient) { value = elvis_real(0); gradient = elvis_vec3(0); }\n";
    SECTION("a name outside the prefix") {
        text += "elvis_real helper() { return elvis_real(1); }\n";
        CHECK_THAT(complaint(device, snippet), Catch::Contains("simple.glsl:6") && Catch::Contains("'helper'"));
    }
    SECTION("a macro outside the prefix") {
        text = "#define FACTOR 2\n" + text;
        CHECK_THAT(complaint(device, snippet), Catch::Contains("simple.glsl:1") && Catch::Contains("SIMPLE_"));
    }
    SECTION("a function that is not announced") {
        text += gradient;
        CHECK_THAT(complaint(device, snippet), Catch::Contains("simple.glsl:7") && Catch::Contains("does not announce"));
    }
    SECTION("a function that is announced and missing") {
        snippet.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT;
        CHECK_THAT(complaint(device, snippet), Catch::Contains("void elvis_field_gradient(uint element"));
        text += gradient;
        CHECK(complaint(device, snippet) == "");
    }
    SECTION("an extension") {
        text += "#extension GL_EXT_anything : require\n";
        CHECK_THAT(complaint(device, snippet), Catch::Contains("simple.glsl:6") && Catch::Contains("#extension"));
    }
    SECTION("a wrong signature") {
        text.replace(text.find("uint element"), 4, "int ");
        CHECK_THAT(complaint(device, snippet), Catch::Contains("elvis_mapping"));
    }
    SECTION("the core's own prefix") {
        snippet.prefix = "core";
        CHECK_THAT(complaint(device, snippet), Catch::Contains("prefix"));
    }
}

TEST_CASE("Instances of different shapes keep their library functions and macros apart") {
    const test::CacheFolder cache;
    DeviceOptions options;
    options.validation = true;
    const Device device(options);
    KernelRequest request;
    request.name = "two shapes";
    request.kernel = "test.comp";
    // Face 2 of the hexahedron is xi1 <= 1, that of the prism xi1 + xi3 <= 0; the kernel finds the first instance's macros.
    request.kernel_text = "layout(local_size_x = 8) in;\n"
                          "layout(std430, binding = 0) writeonly buffer result_block { float result[]; };\n"
                          "void main() {\n"
                          "    uint i = gl_GlobalInvocationID.x;\n"
                          "    elvis_vec4 at = elvis_vec4(0.5, 0, 0.5, CORE_N_FACES == 6 ? 1 : 0);\n"
                          "    result[8u * i] = float(dot(core_face_constraint(2), at));\n"
                          "    result[8u * i + 1u] = float(dot(core_face_constraint_1(2), at));\n"
                          "    result[8u * i + 2u] = float(ELVIS_SHAPE * 10 + ELVIS_SHAPE_1);\n"
                          "    result[8u * i + 3u] = float(ELVIS_HAS_LOCAL_ORIGIN * 10 + ELVIS_HAS_LOCAL_ORIGIN_1);\n"
                          "    result[8u * i + 4u] = float(elvis_origin(i).y);\n"
                          "    result[8u * i + 5u] = float(elvis_origin_1(i).y);\n"
                          "    elvis_real value;\n"
                          "    elvis_vec3 gradient;\n"
                          "    elvis_field_gradient_1(i, elvis_vec3(-0.5), 2u, value, gradient);\n"
                          "    result[8u * i + 6u] = float(value);\n"
                          "    result[8u * i + 7u] = float(gradient.x);\n"
                          "}\n";
    request.bindings = {{0, BindingType::storage_buffer}};
    const RecordBuffer origins(device, RecordKind::real, Precision::float32, 8, 3);
    std::vector<double> numbers(24);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = static_cast<double>(i);
    }
    origins.write_reals(0, numbers);
    SnippetInstance instance;
    instance.snippet = test::simple_snippet();
    instance.n_components = 3;
    request.instances.push_back(instance);
    instance.shape = ELVIS_SHAPE_PRISM;
    instance.snippet.capabilities = ELVIS_SNIPPET_LOCAL_ORIGIN;
    instance.origins = &origins;
    request.instances.push_back(instance);

    const ComposedKernel kernel(device, request);
    const Buffer output(device, 64 * sizeof(float));
    const std::array<const Buffer*, 1> bindings{&output};
    kernel.dispatch(bindings, {}, 1);
    const auto result = output.read_items<float>(64);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(result[8 * i] == -0.5f);
        CHECK(result[8 * i + 1] == 1.0f);
        CHECK(result[8 * i + 2] == 1.0f);
        CHECK(result[8 * i + 3] == 1.0f);
        CHECK(result[8 * i + 4] == 0.0f);
        CHECK(result[8 * i + 5] == static_cast<float>(3 * i + 1));
        CHECK(result[8 * i + 6] == 1.0f);
        CHECK(result[8 * i + 7] == Approx(2.0f).epsilon(1e-4));
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("A kernel in single precision needs no double precision of the device") {
    const test::CacheFolder cache;
    const Device device;
    KernelRequest request;
    request.name = "float only";
    request.kernel = "test.comp";
    request.kernel_text = "layout(local_size_x = 8) in;\n"
                          "layout(std430, binding = 0) writeonly buffer result_block { elvis_real result; };\n"
                          "void main() { result = elvis_field_value(0u, elvis_vec3(elvis_pow(elvis_atan(elvis_real(0.1LF)), \n"
                          "    elvis_asin(elvis_sin(elvis_exp(elvis_log(elvis_acos(elvis_real(0.2LF)))))))), 0u); }\n";
    SnippetInstance instance;
    instance.snippet = test::simple_snippet();
    request.instances = {instance};
    const auto has_float64 = [&] {
        const auto words = compile_shader(compose_text(device, request), request.name);
        constexpr std::uint32_t capability_instruction = 2u << 16u | 17u, float64 = 10;
        for (std::size_t i = 5; i + 1 < words.size() && words[i] == capability_instruction; i += 2) {
            if (words[i + 1] == float64) {
                return true;
            }
        }
        return false;
    };
    CHECK_FALSE(has_float64());
    request.precision = Precision::float64;
    CHECK(has_float64());
}

TEST_CASE("A constant that GLSL cannot hold is an error that names it") {
    const Device device;
    KernelRequest request;
    request.kernel = "conformance/compose_check.comp";
    SnippetInstance instance;
    instance.snippet = test::simple_snippet();
    instance.constants = {{"SIMPLE_BIG", std::int64_t{1} << 40}};
    request.instances = {instance};
    REQUIRE_THROWS_WITH(compose_text(device, request), Catch::Contains("SIMPLE_BIG"));
    request.instances[0].constants = {{"SIMPLE_LOW", -5}, {"SIMPLE_HIGH", 4294967295}};
    const std::string text = compose_text(device, request);
    CHECK_THAT(text, Catch::Contains("#define SIMPLE_LOW (-5)\n") && Catch::Contains("#define SIMPLE_HIGH 4294967295u\n"));
}
