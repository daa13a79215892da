/**
 * @file arrays.hpp
 * Volumes from a program's arrays.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <elvis/elvis.h>
#include <elvis/native/array_volume.hpp>

#include <Eigen/LU>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::library {

/** From the caller's numbers of a space to coefficients of its modes. */
class ToModes {
public:
    /** Throws InvalidArgument, about `what`, for a space that does not exist or nodes that do not determine its functions. */
    ToModes(const elvis_space& space, elvis_shape shape, const std::string& what);

    const native::Space& space() const { return m_space; }
    std::size_t n_modes() const { return m_n_modes; }
    /** Rows of n_modes numbers each. */
    void apply(std::span<const double> numbers, std::span<double> coefficients) const;

private:
    native::Space m_space;
    std::size_t m_n_modes = 0;
    /** From values at nodes; absent for coefficients. */
    std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> m_from_nodes;
};

/** What a program's arrays hold: all but fields' values and faces. */
struct ArrayContents {
    /** Throws InvalidArgument. Classes without elements are an error unless they may be there. */
    explicit ArrayContents(const elvis_arrays& arrays, bool may_be_empty = false);

    /** Without faces. */
    native::Description description;
    /** As the caller has them. */
    std::vector<elvis_array_class> classes;
    std::vector<elvis_array_field> fields;
    /** Coefficients, by class. */
    std::vector<std::vector<double>> geometry;
    /** How values of fields become coefficients, by field and class. */
    std::vector<std::vector<ToModes>> to_modes;
};

/** A volume in arrays, and how values become coefficients. */
class Arrays {
public:
    /** Copies the caller's arrays. Throws InvalidArgument. */
    Arrays(const elvis_arrays& arrays, const std::string& name, const TaskControl& control);

    RuntimeVolume open(const std::string& name, const TaskControl* control);
    /** As they are now: updates do not change it. */
    std::shared_ptr<const native::VolumeSource> copy() const { return m_volume->copy(); }
    /** Throws InvalidArgument for a field, step or class that is not there. */
    void update(std::uint32_t field, std::uint32_t time_step, std::uint32_t element_class, const double* values);

private:
    std::shared_ptr<native::ArrayVolume> m_volume;
    /** By field and class. */
    std::vector<std::vector<ToModes>> m_fields;
    /** What serves m_volume. */
    elvis_volume* m_served = nullptr;
};

} // namespace elvis::library
