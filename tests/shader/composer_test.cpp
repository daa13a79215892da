#include <core/base/error.hpp>
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
    request.kernel = "kernels/compose_check.comp";
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
    request.kernel = "kernels/compose_check.comp";
    request.bindings = {{0, BindingType::storage_buffer}};
    SnippetInstance instance;
    instance.snippet = scaled_snippet();
    instance.constants = {{"SCALED_FACTOR", 1}};

    SECTION("unknown name") {
        instance.snippet.sources[1].text = "\nelvis_real scaled_factor() { return nonsense; }\n";
        request.instances = {instance};
        REQUIRE_THROWS_WITH(ComposedKernel(device, request), Catch::Contains("helper.glsl:2:") && Catch::Contains("nonsense"));
    }
    SECTION("missing function") {
        instance.snippet.sources[0].text = "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return xi; }\n";
        request.instances = {instance};
        REQUIRE_THROWS_WITH(ComposedKernel(device, request),
                            Catch::Contains("scaled.glsl") &&
                                Catch::Contains("elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi)"));
    }
    SECTION("missing include") {
        instance.snippet.sources.pop_back();
        request.instances = {instance};
        REQUIRE_THROWS_WITH(ComposedKernel(device, request),
                            Catch::Contains("scaled.glsl:1") && Catch::Contains("helper.glsl"));
    }
}
