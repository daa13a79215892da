/**
 * @file device_sampler.hpp
 * What a plugin's snippets give at reference points, on the device.
 */
#pragma once

#include <core/conformance/reference_points.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/device.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace elvis::conformance {

struct SamplePoint {
    std::uint64_t element = 0;
    Point xi{};
    std::uint32_t component = 0;
};

/** Columns of dx/dxi: entry 3j + i is dx_i / dxi_j. */
using Matrix = std::array<double, 9>;

/** In the order of shaders/conformance/conformance.comp. Positions are relative to the element's origin. */
struct Sample {
    double value;
    double gradient_value;
    Point gradient;
    Point position;
    Matrix jacobian;
    /** elvis_mapping_jacobian. */
    Point pair_position;
    Matrix pair_jacobian;
    /** elvis_inverse_mapping at `position`: 1 or 0; 0 where the snippet has none. */
    double inverse_found;
    Point inverse;
    /** elvis_field_hessian, elvis_mapping_hessian; of meaning if asked for. */
    double hessian_value;
    Point hessian_gradient;
    Matrix hessian;
    Point hessian_position;
    Matrix hessian_jacobian;
    std::array<Matrix, 3> mapping_hessians;
    /** 1 if a loop of the snippet went on beyond reason; found only with is_debug_build. */
    double is_endless;
    /** How many numbers elvis_debug was given by elvis_field_value and elvis_mapping, and the first of them; with
     * is_debug_build. */
    double n_debug;
    std::array<double, 15> debug;
    /** The first index out of range, with is_debug_build: line in its file, 0 if there is none; index; number of entries. */
    double bad_index_line;
    double bad_index;
    double bad_index_limit;
    /** elvis_inside and elvis_inside_bounds; 0 where the snippet has none. */
    double inside;
    Point inside_gradient;
    std::array<double, 2> inside_bounds;
};
static_assert(sizeof(Sample) == 111 * sizeof(double));

/** "index 7 in line 12 of the snippet, of 4 entries" */
std::string text_of_bad_index(const Sample& sample);

struct SampleOptions {
    bool with_hessians = false;
    /** The snippet is watched (KernelRequest::is_debug_build). */
    bool is_debug_build = false;
};

class DeviceSampler {
public:
    /** Skipped if there is no device with double precision. The volume must outlive it. */
    DeviceSampler(const RuntimeVolume& volume, const std::string& device, Precision precision);

    /** Fills the buffers. `offset`: one number for all components, subtracted where the snippets can. */
    void select(std::uint32_t field, std::uint32_t time_step, double offset = 0);

    std::vector<Sample> sample(const std::vector<SamplePoint>& points, const SampleOptions& options = {}) const;

    /** These texts from now on in place of the snippets' sources of their names. */
    void replace_sources(std::vector<SnippetText> sources) { m_replacements = std::move(sources); }

    /** What positions in the element are relative to. */
    Point origin(std::uint64_t element) const { return m_on_device.origin(element); }
    double field_offset(std::uint32_t component) const { return m_on_device.field_offset(component); }
    Precision precision() const { return m_precision; }

private:
    const ComposedKernel& kernel(std::uint32_t element_class, const SampleOptions& options) const;

    Device m_device;
    const RuntimeVolume& m_volume;
    Precision m_precision;
    DeviceVolume m_on_device;
    std::vector<SnippetText> m_replacements;
    /** By class and options; for what is selected. */
    mutable std::map<std::tuple<std::uint32_t, bool, bool>, std::unique_ptr<ComposedKernel>> m_kernels;
};

} // namespace elvis::conformance
