#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>
#include <core/vulkan/kernel.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

using namespace elvis;
using Catch::Contains;

namespace {

// output[i] = a[i] + scale * b[i]
constexpr const char* axpy = R"(#version 460
layout(local_size_x = 8) in;
layout(std430, binding = 0) readonly buffer a_block { float a[]; };
layout(std140, binding = 1) uniform b_block { vec4 b[16]; };
layout(std430, binding = 2) writeonly buffer output_block { float result[]; };
layout(push_constant) uniform push_block { float scale; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    result[i] = a[i] + scale * b[i / 4u][i % 4u];
}
)";

const std::vector<BindingLayout> axpy_layout{
    {0, BindingType::storage_buffer}, {1, BindingType::uniform_buffer}, {2, BindingType::storage_buffer}};

struct Axpy {
    explicit Axpy(const Device& device)
        : a(device, 256), b(device, 256, Buffer::Use::uniform), result(device, 256),
          kernel(device, compile_shader(axpy, "axpy"), axpy_layout, 4, "axpy") {
        std::vector<float> numbers(64);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i] = static_cast<float>(i);
        }
        a.write_items<float>(numbers);
        b.write_items<float>(numbers);
    }
    void run(float scale) const {
        const std::array<BoundBuffer, 3> bound{BoundBuffer{2, &result}, {0, &a}, {1, &b}};
        kernel.dispatch(bound, std::as_bytes(std::span(&scale, 1)), 8);
    }
    Buffer a, b, result;
    Kernel kernel;
};

} // namespace

TEST_CASE("A kernel reads its bindings and push constants, and validation has nothing to say") {
    DeviceOptions options;
    options.validation = true;
    options.always_stage = GENERATE(false, true);
    const Device device(options);
    {
        const Axpy test(device);
        for (const float scale : {2.0f, 3.0f}) {
            test.run(scale);
            const auto result = test.result.read_items<float>(64);
            for (std::size_t i = 0; i < result.size(); ++i) {
                REQUIRE(result[i] == static_cast<float>(i) * (1 + scale));
            }
        }
        // Results of one dispatch are what the next one reads.
        const std::array<BoundBuffer, 3> chained{BoundBuffer{0, &test.result}, {1, &test.b}, {2, &test.a}};
        const float scale = -4;
        test.kernel.dispatch(chained, std::as_bytes(std::span(&scale, 1)), 8);
        for (const float number : test.a.read_items<float>(64)) {
            REQUIRE(number == 0);
        }
        test.kernel.dispatch(chained, std::as_bytes(std::span(&scale, 1)), 0);
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("Pipelines are cached on disk for the device, and a damaged cache is ignored") {
    namespace fs = std::filesystem;
    std::string folder = (fs::temp_directory_path() / "elvis-pipelines-XXXXXX").string();
    REQUIRE(mkdtemp(folder.data()) != nullptr);
    setenv("ELVIS_CACHE_PATH", folder.c_str(), 1);
    const auto use = [] {
        DeviceOptions options;
        options.validation = true;
        const Device device(options);
        Axpy(device).run(1);
        return device.validation_messages();
    };
    const auto entry = [&] {
        for (const auto& file : fs::directory_iterator(folder)) {
            if (file.path().extension() == ".pipelines") {
                return file.path();
            }
        }
        return fs::path();
    };
    CHECK(use().empty());
    REQUIRE_FALSE(entry().empty());
    const auto bytes = fs::file_size(entry());
    CHECK(use().empty());
    std::fstream(entry(), std::ios::in | std::ios::out | std::ios::binary).seekp(30).put('\x55');
    CHECK(use().empty());
    fs::resize_file(entry(), 10);
    CHECK(use().empty());
    CHECK(fs::file_size(entry()) == bytes); // Written anew.
    unsetenv("ELVIS_CACHE_PATH");
    fs::remove_all(folder);
}

TEST_CASE("A kernel that exceeds the device's limits says which") {
    const Device device;
    const auto spirv = compile_shader(axpy, "axpy");
    const std::uint32_t too_many = device.limits().maxPushConstantsSize + 4;
    CHECK_THROWS_WITH(Kernel(device, spirv, axpy_layout, too_many, "greedy"),
                      Contains("greedy") && Contains("bytes of push constants"));
    const Axpy test(device);
    const std::array<BoundBuffer, 3> bound{BoundBuffer{2, &test.result}, {0, &test.a}, {1, &test.b}};
    const float scale = 1;
    const std::uint32_t most = device.limits().maxComputeWorkGroupCount[0];
    if (most < UINT32_MAX) {
        CHECK_THROWS_WITH(test.kernel.dispatch(bound, std::as_bytes(std::span(&scale, 1)), most + 1), Contains("work groups"));
    }
}

TEST_CASE("Threads may dispatch and copy at the same time") {
    DeviceOptions options;
    options.validation = true;
    options.always_stage = true;
    const Device device(options);
    std::array<int, 4> n_wrong{};
    {
        const Axpy shared(device);
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < n_wrong.size(); ++t) {
            threads.emplace_back([&, t] {
                const Axpy own(device);
                for (int repeat = 0; repeat < 10; ++repeat) {
                    own.run(static_cast<float>(t));
                    shared.run(1);
                    n_wrong[t] += own.result.read_items<float>(64)[5] != 5 * static_cast<float>(1 + t) ? 1 : 0;
                }
            });
        }
    }
    CHECK(n_wrong == std::array<int, 4>{});
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("A dispatch costs little beside its work") {
    const Device device;
    const Axpy test(device);
    test.run(1);
    constexpr int n = 500;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < n; ++i) {
        test.run(1);
    }
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    std::cout << "one small dispatch: " << time.count() / n << " microseconds\n";
    // Typically 20 to 60; the limit leaves room for machines that do other work.
    CHECK(time.count() / n < 1000);
}
