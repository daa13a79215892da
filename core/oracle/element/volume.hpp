/**
 * @file volume.hpp
 * A native volume with one of its fields in memory, evaluated in double precision in the file's own basis.
 */
#pragma once

#include "reference_shape.hpp"

#include <elvis/native/volume_file.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elvis::oracle {

/** Elements of the same shape and spaces; coefficients as native::Reader gives them. */
struct ClassData {
    native::Space geometry;
    native::Space field;
    std::vector<double> geometry_coefficients;
    std::vector<double> field_coefficients;
    /** Element numbers as people know them; their count is the number of elements. */
    std::vector<std::int64_t> numbers;
};

struct VolumeData {
    std::vector<ClassData> classes;
    std::uint32_t n_components = 1;
    native::Transform transform = native::Transform::none;
};

VolumeData read_volume(const std::string& path, std::size_t field = 0, std::size_t time_step = 0);

/** Elements are counted class by class. All functions may be called from several threads at once. */
class Volume {
public:
    explicit Volume(VolumeData data);

    std::size_t n_elements() const { return m_elements.size(); }
    std::uint32_t n_components() const { return m_data.n_components; }
    native::Shape shape(std::size_t element) const { return class_of(element).geometry.shape; }
    const native::Space& geometry(std::size_t element) const { return class_of(element).geometry; }
    std::int64_t number(std::size_t element) const;
    /** Coefficients of the mapping, one direction after the other. */
    std::span<const double> geometry_coefficients(std::size_t element) const;

    /** Position, and jacobian(i, j) = dx_i/dxi_j if wanted. */
    Vector position(std::size_t element, const Vector& xi, Matrix* jacobian = nullptr) const;

    /** All components of the field, in world directions. */
    std::vector<double> field(std::size_t element, const Vector& xi) const;

    /** One component as it is stored, before any transform, and its gradient with respect to xi if wanted. */
    double component(std::size_t element, const Vector& xi, std::size_t component, Vector* gradient = nullptr) const;
    native::Transform transform() const { return m_data.transform; }

private:
    struct Place {
        std::uint32_t element_class;
        std::size_t index;
    };
    const ClassData& class_of(std::size_t element) const { return m_data.classes[m_elements[element].element_class]; }

    VolumeData m_data;
    std::vector<Place> m_elements;
};

} // namespace elvis::oracle
