#include <core/shader/compiler.hpp>
#include <core/vulkan/device.hpp>
#include <core/vulkan/kernel/pipeline_pool.hpp>

#include <catch2/catch.hpp>

#include <string>

using namespace elvis;

TEST_CASE("A pipeline is made once for its code, also if nobody had it meanwhile, and those asked for last are kept") {
    const Device device{DeviceOptions{}};
    const auto spirv = compile_shader("#version 460\nlayout(local_size_x = 8) in;\nvoid main() {}\n", "nothing");
    PipelinePool pool;
    std::size_t n_made = 0;
    const auto asked = [&](const std::string& key) {
        return pool.find_or_make(key, [&] {
            ++n_made;
            return std::make_shared<const KernelPipeline>(device.handle(), spirv, std::span<const BindingLayout>(), 0,
                                                          KernelPipeline::Options{}, "test");
        });
    };
    const KernelPipeline* const first = asked("first").get();
    CHECK(asked("first").get() == first);
    CHECK(n_made == 1);
    for (std::size_t i = 1; i < PipelinePool::most; ++i) {
        asked(std::to_string(i));
    }
    CHECK(asked("first").get() == first);
    CHECK(n_made == PipelinePool::most);
    // One more takes the place of the one that was asked for the longest time ago.
    const PipelinePool::Pipeline held = asked("2");
    asked("more");
    CHECK(n_made == PipelinePool::most + 1);
    asked("first");
    CHECK(n_made == PipelinePool::most + 1);
    asked("1");
    CHECK(n_made == PipelinePool::most + 2);
    CHECK(held != nullptr);
}
