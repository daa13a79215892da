#include "shared_volume.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace elvis::library {

SharedVolume::SharedVolume(native::Description description)
    : m_description(std::move(description)), m_held(m_description.classes.size()), m_geometry(m_held.size()),
      m_fields(m_description.fields.size(), std::vector<std::vector<double>>(m_held.size())) {
    std::uint64_t n = 0;
    for (const native::ElementClass& element_class : m_description.classes) {
        m_first_elements.push_back(n);
        n += element_class.n_elements;
    }
}

ElementPlace SharedVolume::place(std::uint64_t element) const {
    // The last class that starts at or before the element: empty classes start where the next one does.
    const auto after = std::ranges::upper_bound(m_first_elements, element);
    const auto element_class = static_cast<std::size_t>(after - m_first_elements.begin()) - 1;
    return {element_class, element - m_first_elements[element_class]};
}

std::size_t SharedVolume::geometry_size(std::size_t element_class) const {
    return 3 * native::n_modes(m_description.classes[element_class].geometry);
}

std::size_t SharedVolume::field_size(std::size_t field, std::size_t element_class) const {
    return m_description.fields[field].n_components * native::n_modes(m_description.classes[element_class].fields[field]);
}

void SharedVolume::hold(std::span<const std::uint64_t> elements) {
    for (std::vector<std::uint64_t>& held : m_held) {
        held.clear();
    }
    for (const std::uint64_t element : elements) {
        const ElementPlace where = place(element);
        m_held[where.element_class].push_back(where.local);
    }
    for (std::size_t index = 0; index < m_held.size(); ++index) {
        m_geometry[index].assign(m_held[index].size() * geometry_size(index), 0.0);
        for (std::size_t field = 0; field < m_fields.size(); ++field) {
            m_fields[field][index].assign(m_held[index].size() * field_size(field, index), 0.0);
        }
    }
}

std::uint64_t SharedVolume::slot(const ElementPlace& element) const {
    const std::vector<std::uint64_t>& held = m_held[element.element_class];
    const auto found = std::ranges::lower_bound(held, element.local);
    assert(found != held.end() && *found == element.local);
    return static_cast<std::uint64_t>(found - held.begin());
}

std::span<double> SharedVolume::geometry(std::size_t element_class, std::uint64_t slot) {
    const std::size_t size = geometry_size(element_class);
    return std::span(m_geometry[element_class]).subspan(slot * size, size);
}

std::span<double> SharedVolume::field(std::size_t field, std::size_t element_class, std::uint64_t slot) {
    const std::size_t size = field_size(field, element_class);
    return std::span(m_fields[field][element_class]).subspan(slot * size, size);
}

void SharedVolume::set_faces(std::vector<native::Face> faces) {
    m_faces = std::move(faces);
    m_description.n_faces = m_faces.size();
}

void SharedVolume::read(const std::vector<double>& kept, std::size_t size, std::size_t element_class, std::uint64_t first,
                        std::uint64_t count, std::span<double> numbers) const {
    std::ranges::fill(numbers, std::numeric_limits<double>::quiet_NaN());
    const std::vector<std::uint64_t>& held = m_held[element_class];
    for (auto next = std::ranges::lower_bound(held, first); next != held.end() && *next < first + count; ++next) {
        const auto slot = static_cast<std::size_t>(next - held.begin());
        std::ranges::copy(std::span(kept).subspan(slot * size, size), numbers.subspan((*next - first) * size).begin());
    }
}

void SharedVolume::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                 std::span<double> coefficients) const {
    read(m_geometry[element_class], geometry_size(element_class), element_class, first, count, coefficients);
}

void SharedVolume::read_field(std::size_t field, std::size_t, std::size_t element_class, std::uint64_t first,
                              std::uint64_t count, std::span<double> coefficients) const {
    read(m_fields[field][element_class], field_size(field, element_class), element_class, first, count, coefficients);
}

void SharedVolume::read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                std::span<std::int64_t> numbers) const {
    for (std::uint64_t at = 0; at < count; ++at) {
        numbers[at] = static_cast<std::int64_t>(m_first_elements[element_class] + first + at);
    }
}

void SharedVolume::read_faces(std::uint64_t first, std::uint64_t count, std::span<native::Face> faces) const {
    std::ranges::copy(std::span(m_faces).subspan(first, count), faces.begin());
}

} // namespace elvis::library
