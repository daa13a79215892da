/**
 * @file linear_models.hpp
 * What is known of a field in each element before anything is evaluated along a ray.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace elvis {

/** The number whose isosurfaces are drawn: of the components from `first` to before `end` the only one, or the vector's length.
 */
struct ScalarComponent {
    std::uint32_t first = 0, end = 1;

    bool operator==(const ScalarComponent&) const = default;
};

/** Of the field, in one element. */
struct ModelRange {
    float lower = 0, upper = 0;
    /** The bounds are. */
    bool is_estimated = false;
};

/**
 * For the field or expression that `data` has selected, with its derivative bounds: a linear model of it in every element with
 * a bound of the remainder (shaders/field/linear_model.glsl). No element is marked as estimated if all are.
 */
class LinearModels {
public:
    LinearModels(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** Makes the models of the component, if they are not there yet; `ranges`, if not null, then gets those of all
     *  elements, by class. */
    void provide(const ScalarComponent& component, std::vector<std::vector<ModelRange>>* ranges = nullptr);
    /** Of the component that was provided last. */
    bool is_all_estimated() const { return m_is_all_estimated; }

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
    ScalarComponent m_component{0, 0};
    bool m_is_all_estimated = false;
};

} // namespace elvis
