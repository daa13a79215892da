/**
 * @file level_models.hpp
 * What is known of a field in each element before anything is evaluated along a ray.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/level_set.hpp>

#include <memory>
#include <vector>

namespace elvis {

/**
 * For the field or expression that `data` has selected, with its derivative bounds: a linear model of it in every element with a bound
 * of the remainder (shaders/library/level_model.glsl).
 */
class LevelModels {
public:
    LevelModels(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** Makes the models of the component, if they are not there yet. */
    void provide(const LevelComponent& component);

    /** `core_models`; valid as long as this. Of classes with elements. */
    FetchBuffer host_buffer(std::uint32_t element_class) const;

private:
    struct ClassModels {
        std::unique_ptr<RecordBuffer> models;
        std::unique_ptr<ComposedKernel> kernel;
    };

    const Device& m_device;
    const RuntimeVolume& m_volume;
    std::vector<ClassModels> m_classes;
    LevelComponent m_component{0, 0};
};

} // namespace elvis
