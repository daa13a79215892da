/**
 * @file runtime_volume.hpp
 * A volume opened by a runtime plugin, seen from the core: values and exceptions instead of tables and result codes.
 *
 * Everything a plugin returns is checked here once (sizes, names, finite bounds, sums of counts), so that no other part of the
 * core needs to distrust it. A violation is an Error that names plugin and function.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/field_info.hpp>
#include <core/plugin_host/fields_by_place.hpp>
#include <elvis/runtime.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

class Plugin;

struct ClassInfo {
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    std::uint64_t n_elements = 0;
    /** Number of the class's first element in the whole volume. */
    std::uint64_t first_element = 0;
    std::uint32_t geometry_order[3]{};
    bool is_affine = false;
};

struct ClassFieldInfo {
    /** -1 where the field is not polynomial. */
    std::int32_t order[3]{};
    std::vector<std::pair<std::string, std::int64_t>> constants;
};

struct BufferInfo {
    std::string name;
    elvis_buffer_kind kind = ELVIS_BUFFER_REAL;
    std::uint32_t element_class = ELVIS_ALL_CLASSES;
    std::uint32_t depends = 0;
    std::uint64_t n_records = 0;
    std::uint32_t record_size = 0;
};

struct SnippetText {
    std::string name;
    std::string text;
};

struct Snippet {
    std::uint32_t capabilities = 0;
    std::string prefix;
    std::vector<SnippetText> sources;
};

struct FieldRange {
    double lower = 0;
    double upper = 0;
};

/** A smallest or largest value of a field and where it is taken. NaN if there is no finite value. */
struct FieldExtremum {
    double value = 0;
    /** Certified: the field takes no value beyond. Else the value. */
    double bound = 0;
    std::uint64_t element = 0;
    Vector3 xi{};
};

/** Without any finite value the minimum is infinity, the maximum -infinity. */
struct FieldExtrema {
    FieldExtremum minimum, maximum;
    elvis_certainty certainty = ELVIS_ESTIMATED;

    FieldRange range() const { return {minimum.value, maximum.value}; }
};

/** See elvis_runtime.get_field_derivative_bounds and elvis_apex_bounds; NaN where the plugin cannot tell. */
struct DerivativeBounds {
    double first = 0;  ///< L
    double second = 0; ///< H, or B
};

/** See elvis_jacobian_check. */
struct JacobianCheck {
    elvis_jacobian_sign sign = ELVIS_JACOBIAN_UNDECIDED;
    Vector3 xi{};
    double determinant = 0;
    double lower = 0;
};

class RuntimeVolume {
public:
    /** Opens with a given plugin. `options`: JSON text, or empty. */
    RuntimeVolume(std::shared_ptr<const Plugin> plugin, const std::string& path, const std::string& options = {},
                  const TaskControl* control = nullptr);
    /** One that is open already, and that its owner closes, with a plugin's table that serves it. `name` stands for the path.
     */
    RuntimeVolume(std::shared_ptr<const Plugin> plugin, elvis_volume* volume, const std::string& name);
    /** One that `open` makes with the host's services; it is closed by the plugin's table. */
    RuntimeVolume(std::shared_ptr<const Plugin> plugin, const std::string& name,
                  const std::function<elvis_volume*(const elvis_host*)>& open, const TaskControl* control = nullptr);
    ~RuntimeVolume();
    RuntimeVolume(RuntimeVolume&&) noexcept;
    RuntimeVolume& operator=(RuntimeVolume&&) noexcept;

    const std::string& path() const;
    const Plugin& plugin() const;

    std::uint32_t dimension() const;
    std::uint64_t n_elements() const;
    std::uint64_t n_faces() const;
    const std::vector<ClassInfo>& classes() const;
    /** Its own, then those that are found by place. */
    const std::vector<FieldInfo>& fields() const;
    const std::vector<double>& times() const;
    const std::vector<std::string>& boundary_groups() const;
    const std::vector<std::pair<std::string, std::string>>& notes() const;
    std::uint32_t n_buffers() const;

    /** Index of a field by name; an Error that lists the fields if there is none. */
    std::uint32_t field_index(const std::string& name) const;

    ClassFieldInfo class_field(std::uint32_t element_class, std::uint32_t field) const;
    BufferInfo buffer(std::uint32_t buffer, std::uint32_t field) const;
    Snippet snippet(std::uint32_t element_class) const;
    /** Whether elements are only parts of their reference shape: where elvis_inside says so (ELVIS_SNIPPET_INSIDE). Of a class;
     * of any. */
    bool is_cut(std::uint32_t element_class) const;
    bool is_cut() const;

    /** Six numbers an element; returns the certainty. Checked: finite, min <= max. */
    elvis_certainty bounds(std::uint64_t first, std::uint64_t count, std::span<double> out) const;
    /** Numbers under which people know the elements. */
    void element_numbers(std::uint64_t first, std::uint64_t count, std::span<std::int64_t> out) const;
    /** True if element_numbers is the identity because the plugin gives none. */
    bool numbers_are_positions() const;
    void faces(std::uint64_t first, std::uint64_t count, std::span<elvis_face> out) const;

    bool has_field_ranges() const;
    /** n_components ranges an element. Needs has_field_ranges(). */
    elvis_certainty field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                 std::span<FieldRange> out) const;

    /**
     * Extrema of a component, or of the magnitude (component -1) of a field with several, from a plugin that offers
     * elvis_extrema and has an answer. Checked: a minimum that is no larger than the maximum, bounds beyond both, places in the
     * volume.
     */
    std::optional<FieldExtrema> extrema(std::uint32_t field, int component, std::uint32_t time_step) const;

    bool has_derivative_bounds() const;
    /** n_components entries an element. Needs has_derivative_bounds(). Checked: each finite and >= 0, or NaN. */
    elvis_certainty derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                      std::span<DerivativeBounds> out) const;

    /** Whether the plugin offers elvis_apex_bounds. */
    bool has_apex_bounds() const;
    /** As derivative_bounds, of pyramids alone. Needs has_apex_bounds(). */
    elvis_certainty apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                std::span<DerivativeBounds> out) const;

    /** See elvis_runtime.fill_buffer; `destination` holds count * record_size doubles or uint32_t. */
    void fill_buffer(const elvis_fill_request& request, void* destination) const;

    /** Whether both CPU evaluations are there. */
    bool has_evaluation() const;
    /**
     * Shapes as in elvis_runtime.evaluate_mapping; an empty span means "not wanted". In two dimensions the Jacobian's third
     * column is the unit normal, or zero where there is none, and gradients have no third part.
     */
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                          std::span<double> jacobians) const;
    void evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element, std::span<const double> xi,
                        std::span<double> values, std::span<double> gradients) const;

    /** Of a volume whose geometry is displaced: the same elements, in the same order, where they were. Null of others. Opened
     * when first asked for. */
    const RuntimeVolume* undeformed() const;
    void set_undeformed(std::function<RuntimeVolume()> open);

    /**
     * Adds fields of another volume, of which evaluate_field() finds values by place: NaN where that volume is not. All else
     * that is asked about them throws an Error that says what they are good for. Needs has_evaluation().
     */
    void add_by_place(std::shared_ptr<const FieldsByPlace> others);
    /** Of a field that is found by place, at a point of this volume (FieldsByPlace::jump). */
    double jump_by_place(std::uint32_t field, std::uint32_t time_step, std::uint64_t element, const std::array<double, 3>& xi,
                         double reach) const;
    /** Throws that Error for a field that is found by place. */
    void need_own(std::uint32_t field) const;

    bool has_jacobian_checks() const;
    /** Checked: known signs, witnesses in the shape. Needs has_jacobian_checks(); core/volume/element/jacobian_check.hpp does
     * not. */
    elvis_certainty check_jacobians(std::uint64_t first, double tolerance, std::span<JacobianCheck> out) const;

private:
    void evaluate_by_place(std::uint32_t field, std::uint32_t time_step, std::uint64_t element, std::span<const double> xi,
                           std::span<double> values, std::span<double> gradients) const;

    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
