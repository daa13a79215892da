#include <elvis/native/warped_volume.hpp>

#include "../basis/space_change.hpp"

#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace elvis::native {

namespace {

/** Throws std::invalid_argument unless the field moves points of the volume. */
void check_displacement(const Description& description, std::size_t field) {
    if (field >= description.fields.size())
        throw std::invalid_argument("the displacement is not a field of the volume");
    const Field& displacement = description.fields[field];
    const auto dimension = static_cast<std::uint32_t>(description.dimension);
    const bool is_possible = dimension == 2 ? displacement.n_components <= 3 : displacement.n_components == dimension;
    if (!is_possible)
        throw std::invalid_argument("the field '" + displacement.name + "' has " + std::to_string(displacement.n_components) +
                                    (displacement.n_components == 1 ? " component" : " components") + "; a displacement in " +
                                    std::to_string(dimension) + " dimensions has " +
                                    (dimension == 2 ? "one (a height), two or three" : "three"));
}

void check_warp(const Description& description, const Warp& warp) {
    for (const Field& field : description.fields)
        if (field.transform != Transform::none)
            throw std::invalid_argument("the field '" + field.name +
                                        "' is mapped with the geometry (Piola): in a displaced volume it would be another");
    if (!std::isfinite(warp.factor) || !std::isfinite(warp.phase))
        throw std::invalid_argument("factor and phase are finite numbers");
    if (warp.time_step >= description.times.size())
        throw std::invalid_argument("the displacement's time step does not exist");
    check_displacement(description, warp.field);
    if (warp.imaginary) {
        check_displacement(description, *warp.imaginary);
        if (description.fields[*warp.imaginary].n_components != description.fields[warp.field].n_components)
            throw std::invalid_argument("real and imaginary part have different numbers of components");
    }
}

} // namespace

/** From spaces of the source to those of the displaced geometry. */
struct WarpedVolume::Changes {
    struct OfClass {
        SpaceChange geometry;
        /** By field: those that displace. */
        std::map<std::size_t, SpaceChange> fields;
    };
    std::vector<OfClass> classes;
};

WarpedVolume::WarpedVolume(std::shared_ptr<const VolumeSource> source, const Warp& warp)
    : m_source(std::move(source)), m_warp(warp), m_description(m_source->description()) {
    check_warp(m_description, m_warp);
    auto changes = std::make_unique<Changes>();
    for (ElementClass& element_class : m_description.classes) {
        const Space before = element_class.geometry;
        Space space = common_space(before, element_class.fields[m_warp.field]);
        if (m_warp.imaginary)
            space = common_space(space, element_class.fields[*m_warp.imaginary]);
        Changes::OfClass own{SpaceChange(before, space), {}};
        own.fields.try_emplace(m_warp.field, element_class.fields[m_warp.field], space);
        if (m_warp.imaginary)
            own.fields.try_emplace(*m_warp.imaginary, element_class.fields[*m_warp.imaginary], space);
        changes->classes.push_back(std::move(own));
        element_class.geometry = space;
    }
    m_changes = std::move(changes);
}

WarpedVolume::~WarpedVolume() = default;

void WarpedVolume::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                 std::span<double> coefficients) const {
    const std::size_t n_before = n_modes(m_source->description().classes[element_class].geometry);
    const std::size_t n_after = n_modes(m_description.classes[element_class].geometry);
    assert(coefficients.size() == 3 * n_after * count);
    std::vector<double> before(3 * n_before * count);
    m_source->read_geometry(element_class, first, count, before);
    std::ranges::fill(coefficients, 0.0);
    const SpaceChange& change = m_changes->classes[element_class].geometry;
    for (std::size_t row = 0; row < 3 * count; ++row)
        change.add(std::span(before).subspan(row * n_before, n_before), 1, coefficients.subspan(row * n_after, n_after));
    displace(m_warp.field, m_warp.factor * std::cos(m_warp.phase), element_class, first, count, coefficients);
    if (m_warp.imaginary)
        displace(*m_warp.imaginary, -m_warp.factor * std::sin(m_warp.phase), element_class, first, count, coefficients);
}

void WarpedVolume::displace(std::size_t field, double scale, std::size_t element_class, std::uint64_t first,
                            std::uint64_t count, std::span<double> geometry) const {
    const std::size_t n_components = m_description.fields[field].n_components;
    const std::size_t n_before = n_modes(m_description.classes[element_class].fields[field]);
    const std::size_t n_after = n_modes(m_description.classes[element_class].geometry);
    std::vector<double> displacement(n_components * n_before * count);
    m_source->read_field(field, m_warp.time_step, element_class, first, count, displacement);
    const SpaceChange& change = m_changes->classes[element_class].fields.at(field);
    const std::size_t first_direction = n_components == 1 ? 2 : 0; // One component is a height.
    for (std::size_t element = 0; element < count; ++element)
        for (std::size_t component = 0; component < n_components; ++component)
            change.add(std::span(displacement).subspan((element * n_components + component) * n_before, n_before), scale,
                       geometry.subspan((element * 3 + first_direction + component) * n_after, n_after));
}

void WarpedVolume::read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                              std::uint64_t count, std::span<double> coefficients) const {
    m_source->read_field(field, time_step, element_class, first, count, coefficients);
}

void WarpedVolume::read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                std::span<std::int64_t> numbers) const {
    m_source->read_numbers(element_class, first, count, numbers);
}

void WarpedVolume::read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const {
    m_source->read_faces(first, count, faces);
}

std::vector<Extrema> WarpedVolume::read_extrema(std::size_t field, std::size_t time_step) const {
    return m_source->read_extrema(field, time_step);
}

void WarpedVolume::read_parts(std::uint64_t first, std::span<std::uint32_t> parts) const { m_source->read_parts(first, parts); }

} // namespace elvis::native
