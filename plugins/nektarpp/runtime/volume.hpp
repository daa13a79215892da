/**
 * @file volume.hpp
 * An open mesh with its fields, as the runtime interface sees it (elvis/runtime.h). Elements are counted class by class.
 */
#pragma once

#include "../reader/field/field_series.hpp"
#include "../reader/text/paths.hpp"
#include "element_classes.hpp"

#include <elvis/native/derivative_bounds.hpp>
#include <elvis/native/extrema.hpp>
#include <elvis/native/jacobian.hpp>
#include <elvis/plugin.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace nektarpp {

/** Functions may run at the same time as elvis/runtime.h allows. */
class Volume {
public:
    Volume(const elvis::api::Host& host, Input input);

    const Mesh& mesh() const { return m_mesh; }
    const FieldSeries& series() const { return m_series; }
    const std::vector<ElementClass>& classes() const { return m_classes.classes; }
    const std::vector<std::uint64_t>& numbers() const { return m_classes.number_of; }
    /** Counted class by class. */
    const std::vector<elvis_face>& faces() const { return m_faces; }

    /** Certified: six numbers an element. */
    void bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) const;
    /** Certified: two numbers an element. */
    void field_ranges(std::size_t field, std::size_t step, std::uint64_t first, std::uint64_t count, std::span<double> ranges);
    /** Certified. */
    elvis::native::Extrema extrema(std::size_t field, std::size_t step);
    /** Certified, or NaN: two numbers an element, of first and second derivatives. */
    void derivative_bounds(std::size_t field, std::size_t step, elvis::native::SecondDerivatives second, std::uint64_t first,
                           std::uint64_t count, std::span<double> bounds);
    void check_jacobians(std::uint64_t first, double tolerance, std::span<elvis::native::JacobianCheck> checks) const;

    /** Records of elements from position `first` on; `origins` and `offset` as in elvis_fill_request, or null. */
    void fill_geometry(std::uint64_t first, std::uint64_t count, const double* origins, double* records) const;
    void fill_field(std::size_t field, std::size_t step, std::uint64_t first, std::uint64_t count, double offset,
                    double* records);

    /** Either output may be null. */
    void evaluate_mapping(std::uint64_t position, std::span<const double> xi, double* positions, double* jacobians) const;
    void evaluate_field(std::size_t field, std::size_t step, std::uint64_t position, std::span<const double> xi, double* values,
                        double* gradients);

private:
    class FieldReader;
    const MeshElement& element(std::uint64_t position) const { return m_mesh.elements()[m_classes.number_of[position]]; }

    /** Calls visit(class, position) for positions first .. first+count-1, and asks now and then whether to go on. */
    template <class Visit> void for_each_element(std::uint64_t first, std::uint64_t count, Visit visit) const;

    /** What is known of one space; kept for the life of the volume. */
    struct Derivatives {
        elvis::native::DerivativeBounder bounder;
        /** Bounds of each mode. */
        std::vector<elvis::native::DerivativeBound> of_modes;
        Derivatives(const Space& space, elvis::native::SecondDerivatives second);
    };
    const Derivatives& derivatives(const Space& space, elvis::native::SecondDerivatives second) const;
    /** Largest magnitude of a field's coefficients at one step. */
    double largest_coefficient(std::size_t field, std::size_t step);

    elvis::api::Host m_host;
    Mesh m_mesh;
    FieldSeries m_series;
    ElementClasses m_classes;
    std::vector<elvis_face> m_faces;
    mutable std::mutex m_mutex;
    struct KnownDerivatives {
        Space space;
        elvis::native::SecondDerivatives second;
        std::unique_ptr<const Derivatives> derivatives;
    };
    mutable std::vector<KnownDerivatives> m_derivatives;
    std::map<std::pair<std::size_t, std::size_t>, double> m_largest;
};

} // namespace nektarpp
