/**
 * @file light_runs.hpp
 * Takes runs of light from rays on their way (shaders/volume/volume_runs.comp).
 */
#pragma once

#include <core/render/volume/light_run.hpp>
#include <core/shader/composer.hpp>
#include <core/vulkan/buffer.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace elvis {

class LightRuns {
public:
    LightRuns(const Device& device, Precision precision);

    /** For a picture of so many pixels; what was taken before is gone. */
    void begin(std::uint32_t width, std::uint32_t height);
    /** `view`, `states`: of the rays. Between two searches for walks; and when rays go no farther. */
    void take(const Buffer& view, const Buffer& states, bool is_end);
    /** By pixel, and along each ray. */
    std::vector<LightRun> sorted();

private:
    const Device& m_device;
    Precision m_precision;
    ComposedKernel m_kernel;
    std::uint32_t m_width = 0, m_n_pixels = 0;
    std::optional<Buffer> m_firsts, m_runs;
    Buffer m_count;
    std::vector<LightRun> m_taken;
};

} // namespace elvis
