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
    /** When it is taken: between two searches for walks; when all rays wait at a stop, or end; when none goes any farther. */
    enum class When : std::uint32_t { between_walks, at_stop, at_end };
    /** `view`, `states`: of the rays, which go on after a stop. */
    void take(const Buffer& view, const Buffer& states, When when);
    /** By pixel, and along each ray. */
    std::vector<LightRun> sorted();

private:
    const Device& m_device;
    Precision m_precision;
    ComposedKernel m_kernel;
    std::uint32_t m_width = 0, m_n_pixels = 0;
    std::uint16_t m_n_stops = 0;
    std::optional<Buffer> m_firsts, m_runs;
    Buffer m_count;
    std::vector<LightRun> m_taken;
};

} // namespace elvis
