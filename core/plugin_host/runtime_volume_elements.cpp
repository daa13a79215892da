// What is asked about elements: bounds, faces, ranges and derivatives of fields, values, signs of Jacobians.
#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume_impl.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace elvis {

elvis_certainty RuntimeVolume::bounds(std::uint64_t first, std::uint64_t count, std::span<double> out) const {
    assert(out.size() == 6 * count && first + count <= n_elements());
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->call("get_bounds", m_impl->table->get_bounds, first, count, out.data(), &certainty);
    m_impl->check_certainty(certainty, "get_bounds");
    for (std::uint64_t element = 0; element < count; ++element) {
        for (std::uint64_t axis = 0; axis < 3; ++axis) {
            const double lower = out[6 * element + axis];
            const double upper = out[6 * element + 3 + axis];
            if (!std::isfinite(lower) || !std::isfinite(upper) || lower > upper) {
                m_impl->refuse("get_bounds", "bounds [" + std::to_string(lower) + ", " + std::to_string(upper) +
                                                 "] for element " + std::to_string(first + element));
            }
        }
    }
    return certainty;
}

bool RuntimeVolume::numbers_are_positions() const { return !m_impl->table->get_element_numbers; }

void RuntimeVolume::element_numbers(std::uint64_t first, std::uint64_t count, std::span<std::int64_t> out) const {
    assert(out.size() == count && first + count <= n_elements());
    if (numbers_are_positions()) {
        for (std::uint64_t index = 0; index < count; ++index) {
            out[index] = static_cast<std::int64_t>(first + index);
        }
        return;
    }
    m_impl->call("get_element_numbers", m_impl->table->get_element_numbers, first, count, out.data());
    for (const std::int64_t number : out) {
        if (number < 0 || number >= 0xffffffffll) {
            m_impl->refuse("get_element_numbers", "the number " + std::to_string(number));
        }
    }
}

void RuntimeVolume::faces(std::uint64_t first, std::uint64_t count, std::span<elvis_face> out) const {
    assert(out.size() == count && first + count <= n_faces());
    for (elvis_face& face : out) {
        face = sized<elvis_face>();
    }
    m_impl->call("get_faces", m_impl->table->get_faces, first, count, out.data());
    const auto n = static_cast<std::int64_t>(n_elements());
    const auto n_local_faces = [this](std::int64_t element) {
        const auto next =
            std::ranges::upper_bound(classes(), static_cast<std::uint64_t>(element), {}, &ClassInfo::first_element);
        return native::n_faces(native::Shape{std::prev(next)->shape});
    };
    for (const elvis_face& face : out) {
        if (face.element < 0 || face.element >= n || face.neighbour >= n || face.neighbour < ELVIS_NEIGHBOUR_UNKNOWN ||
            face.local_face < 0 || face.local_face >= n_local_faces(face.element) || face.neighbour_local_face < -1 ||
            (face.neighbour >= 0 && face.neighbour_local_face >= n_local_faces(face.neighbour)) ||
            face.group < ELVIS_GROUP_NONE || face.group >= static_cast<std::int32_t>(m_impl->info.n_boundary_groups)) {
            m_impl->refuse("get_faces", "a face of element " + std::to_string(face.element) + " with numbers out of range");
        }
    }
}

bool RuntimeVolume::has_field_ranges() const { return m_impl->table->get_field_ranges != nullptr; }

elvis_certainty RuntimeVolume::field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                            std::uint64_t count, std::span<FieldRange> out) const {
    static_assert(sizeof(FieldRange) == 2 * sizeof(double));
    assert(has_field_ranges() && out.size() == count * m_impl->fields[field].n_components);
    m_impl->need_own(field);
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->call("get_field_ranges", m_impl->table->get_field_ranges, field, time_step, first, count,
                 reinterpret_cast<double*>(out.data()), &certainty);
    m_impl->check_certainty(certainty, "get_field_ranges");
    for (const FieldRange& range : out) {
        if (!(range.lower <= range.upper)) {
            m_impl->refuse("get_field_ranges", "a range whose ends are in the wrong order or NaN");
        }
    }
    return certainty;
}

std::optional<FieldExtrema> RuntimeVolume::extrema(std::uint32_t field, int component, std::uint32_t time_step) const {
    m_impl->need_own(field);
    const elvis_extrema* table = m_impl->plugin->extrema();
    if (!table) {
        return {};
    }
    constexpr const char* function = "get_field_extrema";
    auto minimum = sized<elvis_extremum>(), maximum = sized<elvis_extremum>();
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->call(function, table->get_field_extrema, field,
                 component < 0 ? ELVIS_MAGNITUDE : static_cast<std::uint32_t>(component), time_step, &minimum, &maximum,
                 &certainty);
    m_impl->check_certainty(certainty, function);
    if (certainty != ELVIS_CERTIFIED) {
        return {};
    }
    const bool has_values = !std::isnan(minimum.value) || !std::isnan(maximum.value);
    if (has_values && !(minimum.bound <= minimum.value && minimum.value <= maximum.value && maximum.value <= maximum.bound)) {
        m_impl->refuse(function, "values and bounds in the wrong order, or NaN");
    }
    if (minimum.element >= n_elements() || maximum.element >= n_elements()) {
        m_impl->refuse(function, "an element that is not there");
    }
    const auto read = [](const elvis_extremum& from) {
        return FieldExtremum{from.value, from.bound, from.element, {from.xi[0], from.xi[1], from.xi[2]}};
    };
    return FieldExtrema{read(minimum), read(maximum), certainty};
}

elvis_certainty RuntimeVolume::Impl::bound_derivatives(const char* name,
                                                       decltype(elvis_runtime::get_field_derivative_bounds) function,
                                                       std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                       std::uint64_t count, std::span<DerivativeBounds> out) const {
    static_assert(sizeof(DerivativeBounds) == 2 * sizeof(double));
    assert(out.size() == count * fields[field].n_components);
    elvis_certainty certainty = ELVIS_ESTIMATED;
    call(name, function, field, time_step, first, count, reinterpret_cast<double*>(out.data()), &certainty);
    check_certainty(certainty, name);
    for (std::size_t index = 0; index < out.size(); ++index) {
        for (const double bound : {out[index].first, out[index].second}) {
            if (bound < 0 || std::isinf(bound)) {
                refuse(name, "the bound " + std::to_string(bound) + " for element " +
                                 std::to_string(first + index / fields[field].n_components));
            }
        }
    }
    return certainty;
}

bool RuntimeVolume::has_derivative_bounds() const { return m_impl->table->get_field_derivative_bounds != nullptr; }

elvis_certainty RuntimeVolume::derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                 std::uint64_t count, std::span<DerivativeBounds> out) const {
    assert(has_derivative_bounds());
    m_impl->need_own(field);
    return m_impl->bound_derivatives("get_field_derivative_bounds", m_impl->table->get_field_derivative_bounds, field,
                                     time_step, first, count, out);
}

bool RuntimeVolume::has_apex_bounds() const { return m_impl->plugin->apex_bounds() != nullptr; }

elvis_certainty RuntimeVolume::apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                           std::uint64_t count, std::span<DerivativeBounds> out) const {
    assert(has_apex_bounds());
    m_impl->need_own(field);
    return m_impl->bound_derivatives("get_field_apex_bounds", m_impl->plugin->apex_bounds()->get_field_apex_bounds, field,
                                     time_step, first, count, out);
}

bool RuntimeVolume::has_evaluation() const { return m_impl->table->evaluate_mapping && m_impl->table->evaluate_field; }

namespace {

/** The third column of a Jacobian in two dimensions, of which plugins say nothing. */
void set_normal(std::span<double> jacobian) {
    const Vector3 first{jacobian[0], jacobian[3], jacobian[6]}, second{jacobian[1], jacobian[4], jacobian[7]};
    const Vector3 normal = cross(first, second);
    const double size = length(normal);
    for (std::size_t row = 0; row < 3; ++row) {
        jacobian[3 * row + 2] = size > 0 ? normal[row] / size : 0;
    }
}

} // namespace

void RuntimeVolume::evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                                     std::span<double> jacobians) const {
    const std::size_t n_points = xi.size() / 3;
    assert(positions.empty() || positions.size() == 3 * n_points);
    assert(jacobians.empty() || jacobians.size() == 9 * n_points);
    m_impl->call("evaluate_mapping", m_impl->table->evaluate_mapping, element, n_points, xi.data(),
                 positions.empty() ? nullptr : positions.data(), jacobians.empty() ? nullptr : jacobians.data());
    if (dimension() == 2) {
        for (std::size_t at = 0; at < jacobians.size(); at += 9) {
            set_normal(jacobians.subspan(at, 9));
        }
    }
}

void RuntimeVolume::evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                                   std::span<const double> xi, std::span<double> values, std::span<double> gradients) const {
    [[maybe_unused]] const std::size_t n_numbers = xi.size() / 3 * m_impl->fields[field].n_components;
    assert(values.empty() || values.size() == n_numbers);
    assert(gradients.empty() || gradients.size() == 3 * n_numbers);
    if (m_impl->fields[field].is_by_place) {
        evaluate_by_place(field, time_step, element, xi, values, gradients);
        return;
    }
    m_impl->call("evaluate_field", m_impl->table->evaluate_field, field, time_step, element, xi.size() / 3, xi.data(),
                 values.empty() ? nullptr : values.data(), gradients.empty() ? nullptr : gradients.data());
    if (dimension() == 2) {
        for (std::size_t at = 2; at < gradients.size(); at += 3) {
            gradients[at] = 0;
        }
    }
}

bool RuntimeVolume::has_jacobian_checks() const { return m_impl->table->check_jacobians != nullptr; }

elvis_certainty RuntimeVolume::check_jacobians(std::uint64_t first, double tolerance, std::span<JacobianCheck> out) const {
    assert(has_jacobian_checks() && dimension() == 3 && first + out.size() <= n_elements());
    auto unknown = sized<elvis_jacobian_check>();
    unknown.sign = ELVIS_JACOBIAN_UNDECIDED;
    unknown.lower = -std::numeric_limits<double>::infinity();
    std::vector<elvis_jacobian_check> theirs(out.size(), unknown);
    elvis_certainty certainty = ELVIS_ESTIMATED;
    m_impl->call("check_jacobians", m_impl->table->check_jacobians, first, out.size(), tolerance, theirs.data(), &certainty);
    m_impl->check_certainty(certainty, "check_jacobians");
    for (std::size_t index = 0; index < out.size(); ++index) {
        const elvis_jacobian_check& check = theirs[index];
        const auto element = [&] { return " for element " + std::to_string(first + index); };
        if (check.sign > ELVIS_JACOBIAN_UNDECIDED) {
            m_impl->refuse("check_jacobians", "the unknown sign " + std::to_string(check.sign) + element());
        }
        if (check.sign == ELVIS_JACOBIAN_NEGATIVE) {
            for (const double x : check.xi) {
                // All shapes lie in this cube.
                if (!(x >= -1 && x <= 1)) {
                    m_impl->refuse("check_jacobians", "a point outside the reference shape" + element());
                }
            }
            if (!(check.determinant <= 0)) {
                m_impl->refuse("check_jacobians", "a negative sign and a determinant that is not" + element());
            }
        } else if (std::isnan(check.lower) || (check.sign == ELVIS_JACOBIAN_POSITIVE && check.lower < 0)) {
            m_impl->refuse("check_jacobians", "a lower bound of " + std::to_string(check.lower) + element());
        }
        out[index] = {check.sign, {check.xi[0], check.xi[1], check.xi[2]}, check.determinant, check.lower};
    }
    return certainty;
}

} // namespace elvis
