#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/shader/compiler.hpp>
#include <core/vulkan/kernel/kernel.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <bit>
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
    void run(float scale, std::uint32_t n_groups = 8) const {
        const std::array<BoundBuffer, 3> bound{BoundBuffer{2, &result}, {0, &a}, {1, &b}};
        kernel.dispatch(bound, std::as_bytes(std::span(&scale, 1)), n_groups);
    }
    Buffer a, b, result;
    Kernel kernel;
};

} // namespace

TEST_CASE("A kernel reads its bindings and push constants, and validation has nothing to say") {
    DeviceOptions options;
    options.validation = true;
    options.always_stage = GENERATE(false, true);
    options.submissions = GENERATE(Submissions::single, Submissions::collected);
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

TEST_CASE("A dispatch has the size that an earlier kernel wrote, and small buffers are read together") {
    DeviceOptions options;
    options.validation = true;
    options.always_stage = GENERATE(false, true);
    options.submissions = GENERATE(Submissions::single, Submissions::collected);
    const Device device(options);
    {
        const Axpy test(device);
        const Buffer size(device, 3 * sizeof(std::uint32_t)), empty(device, 0);
        const std::array<BoundBuffer, 3> bound{BoundBuffer{2, &test.result}, {0, &test.a}, {1, &test.b}};
        const float scale = 1;
        test.result.fill(0);
        for (const std::uint32_t n_groups : {0u, 3u}) {
            size.write_items<std::uint32_t>(std::array<std::uint32_t, 3>{n_groups, 1, 1});
            test.kernel.dispatch_indirect(bound, std::as_bytes(std::span(&scale, 1)), size);
            const auto words = Buffer::read_words({&size, &empty, &test.result});
            REQUIRE(words.size() == 3);
            CHECK(words[0] == std::vector<std::uint32_t>{n_groups, 1, 1});
            CHECK(words[1].empty());
            for (std::size_t i = 0; i < 64; ++i) {
                REQUIRE(std::bit_cast<float>(words[2][i]) == (i < 8 * n_groups ? 2 * static_cast<float>(i) : 0.0f));
            }
        }
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("What is collected keeps its order, its values and its buffers until a result is wanted") {
    DeviceOptions options;
    options.validation = true;
    options.always_stage = GENERATE(false, true);
    options.submissions = Submissions::collected;
    const Device device(options);
    {
        const Axpy test(device);
        device.finish();
        const DeviceWork before = device.work();
        const Buffer all(device, 5 * 256);
        for (std::uint32_t round = 0; round < 5; ++round) {
            // Each round has its own input, which is gone before anything was done, and its own push constant.
            const Buffer input(device, 256);
            input.write_items<float>(std::vector<float>(64, static_cast<float>(round)));
            const std::array<BoundBuffer, 3> bound{BoundBuffer{2, &test.result}, {0, &input}, {1, &test.b}};
            const float scale = 10.0f * static_cast<float>(round);
            test.kernel.dispatch(bound, std::as_bytes(std::span(&scale, 1)), 8);
            device.record([&](VkCommandBuffer commands) {
                const VkBufferCopy region{0, std::uint64_t{256} * round, 256};
                vkCmdCopyBuffer(commands, test.result.handle(), all.handle(), 1, &region);
            });
            test.b.write_items<float>(std::vector<float>(64, 1.0f)); // For the next rounds.
        }
        const auto result = all.read_items<float>(5 * 64);
        for (std::size_t i = 0; i < result.size(); ++i) {
            const auto round = static_cast<float>(i / 64);
            const float b = i < 64 ? static_cast<float>(i) : 1.0f;
            REQUIRE(result[i] == round + 10 * round * b);
        }
        CHECK(device.work().submissions - before.submissions == 1);
        // More than may be written among commands.
        const Buffer large(device, 1u << 20u);
        large.fill(3);
        large.write_items<std::uint32_t>(std::vector<std::uint32_t>(100000, 7), 1);
        CHECK(large.read_items<std::uint32_t>(2) == std::vector<std::uint32_t>{3, 7});
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("Pipelines are cached on disk for the device, and a damaged cache is ignored") {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    setenv("ELVIS_CACHE_PATH", folder.path().c_str(), 1);
    const auto use = [] {
        DeviceOptions options;
        options.validation = true;
        const Device device(options);
        Axpy(device).run(1);
        return device.validation_messages();
    };
    const auto entry = [&] {
        for (const auto& file : fs::directory_iterator(folder.path())) {
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

TEST_CASE("A small dispatch is handed over once, and waited for once") {
    const Device device;
    const Axpy test(device);
    test.run(1);
    const DeviceWork before = device.work();
    constexpr int n = 500;
    // One work group: more are handed over in parts where a busy machine has been slow.
    for (int i = 0; i < n; ++i) {
        test.run(1, 1);
    }
    const DeviceWork after = device.work();
    CHECK(after.submissions - before.submissions <= n);
    CHECK(after.host_waits - before.host_waits <= n);
}

namespace {

// Each invocation adds up many numbers, more where its work group's place says so, and writes the place; counts[0] is how many
// did.
constexpr const char* slow_places = R"(#version 460
layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer result_block { uint result[]; };
layout(push_constant) uniform push_block { uvec3 groups; uint turns; };
void main() {
    const uint group = gl_WorkGroupID.x + groups.x * (gl_WorkGroupID.y + groups.y * gl_WorkGroupID.z);
    uint sum = group;
    const uint n_turns = group % 7u == 0u ? turns : 1u;
    for (uint turn = 0u; turn < n_turns; ++turn) {
        sum = sum * 1664525u + 1013904223u;
    }
    const uint i = gl_LocalInvocationID.x + 8u * group;
    result[i] = result[i] + (sum == 7u ? 2u : 1u) * (1u + gl_GlobalInvocationID.x);
}
)";

struct SlowPlaces {
    explicit SlowPlaces(const Device& device, std::array<std::uint32_t, 3> of)
        : groups(of), n(8 * of[0] * of[1] * of[2]), result(device, n * sizeof(std::uint32_t)),
          kernel(device, compile_shader(slow_places, "slow_places"), {{0, BindingType::storage_buffer}}, 16, "slow_places") {
        result.fill(0);
    }
    void run(std::uint32_t turns) const {
        const std::array<std::uint32_t, 4> constants{groups[0], groups[1], groups[2], turns};
        const std::array<BoundBuffer, 1> bound{BoundBuffer{0, &result}};
        kernel.dispatch(bound, std::as_bytes(std::span(constants)), groups[0], groups[1], groups[2]);
    }
    std::array<std::uint32_t, 3> groups;
    std::uint32_t n;
    Buffer result;
    Kernel kernel;
};

} // namespace

TEST_CASE("A dispatch in parts runs every work group once, whatever their number in each direction") {
    DeviceOptions options;
    options.validation = true;
    const Device device(options);
    for (const std::array<std::uint32_t, 3>& groups :
         {std::array<std::uint32_t, 3>{5000, 1, 1}, {3, 700, 2}, {130, 40, 1}, {1, 1, 900}}) {
        const SlowPlaces test(device, groups);
        for (int round = 0; round < 3; ++round) {
            test.run(20000);
        }
        const auto result = test.result.read_items<std::uint32_t>(test.n);
        std::uint32_t n_wrong = 0;
        for (std::uint32_t i = 0; i < test.n; ++i) {
            const std::uint32_t x = i % 8 + 8 * (i / 8 % groups[0]);
            n_wrong += result[i] != 3 * (1 + x) && result[i] != 6 * (1 + x) ? 1 : 0;
        }
        CAPTURE(groups[0], groups[1], groups[2]);
        CHECK(n_wrong == 0);
    }
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("A cancelled task stops its kernels between parts, and not those of others") {
    const Device device;
    const SlowPlaces test(device, {20000, 1, 1});
    test.run(60000);
    TaskControl control;
    std::chrono::steady_clock::time_point asked, stopped;
    const auto run_cancelled = [&](int after_milliseconds) {
        control.cancelled = false;
        const DeviceTask task(device, &control);
        std::jthread owner([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(after_milliseconds));
            asked = std::chrono::steady_clock::now();
            control.cancelled = true;
        });
        for (int i = 0; i < 1000; ++i) {
            test.run(60000);
        }
    };
    for (const int after : {0, 30, 100}) {
        CHECK_THROWS_AS(run_cancelled(after), Cancelled);
        stopped = std::chrono::steady_clock::now();
        const std::chrono::duration<double, std::milli> latency = stopped - asked;
        std::cout << "cancelled after " << after << " ms: stopped " << latency.count() << " ms later\n";
        // Parts take some 20 ms; the limit leaves room for machines that do other work.
        CHECK(latency.count() < 5000);
    }
    // The control still says so, but it is nobody's task any more.
    test.run(1);
    control.cancelled = true;
    const DeviceTask task(device, &control);
    std::jthread([&] { test.run(1); });
    CHECK_THROWS_AS(test.run(1), Cancelled);
    const DeviceTask none(device, nullptr);
    CHECK_THROWS_AS(test.run(1), Cancelled);
}
