/**
 * @file isovalue_set.hpp
 * The elements in which a field takes given values: where its isosurfaces are looked for.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/kernel_results.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/isosurface/linear_models.hpp>
#include <core/volume/isosurface/octants_ahead.hpp>
#include <core/volume/isosurface/told_ranges.hpp>
#include <core/vulkan/buffer.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/**
 * Octants into which elements are divided, at most: all eighths of them and, of `n_bent` that are bent, parts of those, up to a
 * number that is enough for any picture; and the elements themselves, however many. What is divided is then a matter of these
 * elements alone, whatever others there are.
 */
std::uint64_t most_isosurface_octants(std::uint64_t n_elements, std::uint64_t n_bent);

/**
 * For the field or expression that `data` has selected, with its derivative bounds: a linear model of it in every element
 * (shaders/field/linear_model.glsl), and hierarchies over the elements that can hold an isovalue, one for each class, and
 * over the octants of these, or octants of octants, that can (shaders/isosurface/octant.glsl), up to most_isosurface_octants().
 * Elements of which the range is only estimated are kept, so that rays past them can be flagged, unless all are: see
 * rests_on_estimates(). What the plugin proves to hold no isovalue is left out in any case.
 */
class IsovalueSet {
public:
    IsovalueSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /**
     * Values ascending, less the field's offset. Without `skips_by_range` every element is chosen. `told`: the field, if a
     * plugin may tell its ranges.
     */
    void choose(std::span<const double> isovalues, const ScalarComponent& component, bool skips_by_range,
                const std::optional<ToldField>& told);

    /** `core_nodes`, in which leaves are local elements, and `core_models`. Valid as long as this. Of classes with elements. */
    std::vector<FetchBuffer> element_buffers(std::uint32_t element_class) const;
    /** `core_nodes`, in which leaves are octants, and `core_octants`. Valid until there is room for more octants. */
    std::vector<FetchBuffer> octant_buffers(std::uint32_t element_class) const;
    /** Octants for which there is room; it never gets less. */
    std::uint64_t room(std::uint32_t element_class) const { return m_classes[element_class].room; }
    /** Before the nodes of element_buffers() are used. */
    void provide_element_nodes(std::uint32_t element_class);
    /** Elements have been left out, or rays pass them by, on the word of estimates: that is so everywhere, and not flagged by
     * kernels. */
    bool rests_on_estimates() const { return m_models.is_all_estimated(); }
    std::uint64_t n_octants(std::uint32_t element_class) const { return m_classes[element_class].n_octants; }
    /** Chosen ones. */
    std::uint64_t n_elements(std::uint32_t element_class) const { return m_classes[element_class].chosen.size(); }

private:
    struct ClassOctants {
        std::unique_ptr<RecordBuffer> nodes, octant_nodes, octants;
        std::unique_ptr<ComposedKernel> octant_kernel;
        /** Of all local elements. */
        std::vector<ModelRange> ranges;
        /** The same, as the plugin proves them; empty if it does not. */
        std::vector<FieldRange> told;
        /** Local elements, and their boxes. */
        std::vector<std::uint32_t> chosen;
        std::vector<double> boxes;
        bool has_element_nodes = false;
        /** Octants, those for which there is room, and those that there may be of what is chosen. */
        std::uint64_t n_octants = 0, room = 0, most = 0;
    };
    struct Octants;
    struct Choice {
        std::vector<double> isovalues;
        bool skips_by_range = true;

        bool operator==(const Choice&) const = default;
    };
    bool may_skip(const ModelRange& range) const;
    /** Whether the element of the class may hold an isovalue. */
    bool is_wanted(const ClassOctants& of_class, std::uint64_t element) const;
    void provide_ranges(const ScalarComponent& component, const std::optional<ToldField>& told);
    void make_room(ClassOctants& of_class, std::uint64_t n_octants) const;
    void make_octants();
    void make_octants(ClassOctants& of_class, elvis_shape shape, OctantsAhead& ahead);
    bool is_divided(const Octants& octants, std::size_t octant, std::uint32_t level) const;
    /** `place`: of local elements in what is chosen. */
    void write_octants(ClassOctants& of_class, std::span<const std::uint32_t> place, const Octants& octants);
    /** In place of a linearization, the element's box. */
    void write_box(std::uint32_t* record, const double* box) const;
    /** Models of octants, and their boxes and ranges. */
    std::vector<std::uint32_t> evaluate(const ClassOctants& of_class, std::span<const std::uint32_t> elements_and_codes);
    /** Of no more than one dispatch has; `buffers` live until the results are read. */
    void dispatch(const ClassOctants& of_class, std::span<const std::uint32_t> elements_and_codes,
                  std::vector<std::unique_ptr<const Buffer>>& buffers, KernelResults& results) const;

    const Device& m_device;
    const RuntimeVolume& m_volume;
    const DeviceVolume& m_data;
    Precision m_precision;
    Vector3 m_centre;
    LinearModels m_models;
    std::vector<ClassOctants> m_classes;
    ScalarComponent m_component{0, 0};
    Choice m_choice;
    /** Whether all that the choice needs is there: making it may have been cancelled. */
    bool m_is_chosen = false;
};

} // namespace elvis
