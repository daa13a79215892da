#include <elvis/native/array_volume.hpp>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace elvis::native {

namespace {

/** Copies elements of an array that holds `size` numbers each. */
void copy_elements(std::span<const double> from, std::size_t size, std::uint64_t first, std::uint64_t count,
                   std::span<double> to) {
    assert(to.size() == count * size);
    std::ranges::copy(from.subspan(first * size, count * size), to.begin());
}

} // namespace

ArrayVolume::ArrayVolume(Description description, std::vector<Face> faces)
    : m_description(std::move(description)), m_faces(std::move(faces)) {
    assert(m_faces.size() == m_description.n_faces);
    for (const ElementClass& element_class : m_description.classes) {
        check(element_class.geometry);
        m_geometry.emplace_back(3 * n_modes(element_class.geometry) * element_class.n_elements);
    }
    for (std::size_t field = 0; field < m_description.fields.size(); ++field) {
        const std::size_t n_components = m_description.fields[field].n_components;
        for (std::size_t step = 0; step < m_description.times.size(); ++step) {
            for (const ElementClass& element_class : m_description.classes) {
                check(element_class.fields[field]);
                m_fields.emplace_back(n_components * n_modes(element_class.fields[field]) * element_class.n_elements);
            }
        }
    }
}

std::shared_ptr<ArrayVolume> ArrayVolume::copy() const {
    auto other = std::make_shared<ArrayVolume>(m_description, m_faces);
    other->m_geometry = m_geometry;
    other->m_fields = m_fields;
    return other;
}

void ArrayVolume::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                                std::span<double> coefficients) const {
    copy_elements(m_geometry[element_class], 3 * n_modes(m_description.classes[element_class].geometry), first, count,
                  coefficients);
}

void ArrayVolume::read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                             std::uint64_t count, std::span<double> coefficients) const {
    const std::size_t size =
        m_description.fields[field].n_components * n_modes(m_description.classes[element_class].fields[field]);
    copy_elements(m_fields[place(field, time_step, element_class)], size, first, count, coefficients);
}

void ArrayVolume::read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                               std::span<std::int64_t> numbers) const {
    assert(numbers.size() == count);
    std::uint64_t before = first;
    for (std::size_t earlier = 0; earlier < element_class; ++earlier) {
        before += m_description.classes[earlier].n_elements;
    }
    std::iota(numbers.begin(), numbers.end(), static_cast<std::int64_t>(before));
    static_cast<void>(count);
}

void ArrayVolume::read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const {
    std::ranges::copy(std::span(m_faces).subspan(first, count), faces.begin());
}

} // namespace elvis::native
