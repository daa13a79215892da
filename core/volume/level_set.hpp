/**
 * @file level_set.hpp
 * The elements in which a field takes given values: where its level sets are looked for.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis {

/** The number that has the level sets: of the components from `first` to before `end` the only one, or the vector's length. */
struct LevelComponent {
    std::uint32_t first = 0, end = 1;

    bool operator==(const LevelComponent&) const = default;
};

/**
 * For the field or expression that `data` has selected, with its derivative bounds: a linear model of it in every element
 * (shaders/library/level_model.glsl), and hierarchies over the elements that can hold an isovalue, one for each class. Elements
 * of which the range is only estimated are kept, so that rays past them can be flagged, unless all are: see rests_on_estimates().
 */
class LevelSet {
public:
    LevelSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** Values ascending, less the field's offset. Without `skips_by_range` every element is chosen. */
    void choose(std::span<const double> isovalues, const LevelComponent& component, bool skips_by_range);

    /** `core_nodes`, in which leaves are local elements, and `core_models`. Valid as long as this. Of classes with elements. */
    std::vector<FetchBuffer> host_buffers(std::uint32_t element_class) const;
    /** Elements have been left out, or rays pass them by, on the word of estimates: that is so everywhere, and not flagged by kernels. */
    bool rests_on_estimates() const { return m_is_all_estimated; }
    /** Chosen ones. */
    std::uint64_t n_elements(std::uint32_t element_class) const { return m_classes[element_class].n_chosen; }

private:
    struct ClassLevels {
        std::unique_ptr<RecordBuffer> nodes, models;
        std::unique_ptr<ComposedKernel> kernel;
        std::vector<FieldRange> ranges;
        std::vector<bool> is_estimated;
        std::uint64_t n_chosen = 0;
    };
    struct Choice {
        std::vector<double> isovalues;
        bool skips_by_range = true;

        bool operator==(const Choice&) const = default;
    };
    void make_models(const LevelComponent& component);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    std::array<double, 3> m_centre;
    std::vector<ClassLevels> m_classes;
    LevelComponent m_component{0, 0};
    bool m_is_all_estimated = false;
    Choice m_choice;
};

} // namespace elvis
