#include <core/parts/part_volume.hpp>

#include <elvis/element.h>

#include <algorithm>
#include <utility>

namespace elvis {

namespace {

/** Faces that are read at once. */
constexpr std::uint64_t faces_at_once = 65536;

/**
 * Calls read(first element of the whole's class, count, first of the numbers that are asked for) for elements that follow each
 * other there, too.
 */
template <class Read>
void for_each_run_of(std::span<const std::uint64_t> elements, std::uint64_t first, std::uint64_t count, Read read) {
    for (std::uint64_t done = 0; done < count;) {
        std::uint64_t n = 1;
        while (done + n < count && elements[first + done + n] == elements[first + done] + n) {
            ++n;
        }
        read(elements[first + done], n, done);
        done += n;
    }
}

} // namespace

PartVolume::PartVolume(std::shared_ptr<const native::VolumeSource> whole, std::vector<std::vector<std::uint64_t>> elements)
    : m_whole(std::move(whole)), m_elements(std::move(elements)), m_description(m_whole->description()) {
    for (std::size_t index = 0; index < m_elements.size(); ++index) {
        m_description.classes[index].n_elements = m_elements[index].size();
    }
    read_own_faces();
    m_description.n_faces = m_faces.size();
}

void PartVolume::read_own_faces() {
    std::vector<bool> is_there(m_whole->description().n_elements(), false);
    for (std::size_t index = 0; index < m_elements.size(); ++index) {
        std::vector<std::int64_t> numbers(m_elements[index].size());
        read_numbers(index, 0, numbers.size(), numbers);
        for (const std::int64_t number : numbers) {
            is_there[static_cast<std::size_t>(number)] = true;
        }
    }
    const auto holds = [&](std::int64_t number) { return number >= 0 && is_there[static_cast<std::size_t>(number)]; };
    std::vector<native::Face> faces;
    const std::uint64_t n_faces = m_whole->description().n_faces;
    for (std::uint64_t first = 0; first < n_faces; first += faces_at_once) {
        faces.resize(std::min(faces_at_once, n_faces - first));
        m_whole->read_faces(first, faces.size(), faces);
        for (native::Face face : faces) {
            if (!holds(face.element) && holds(face.neighbour)) {
                std::swap(face.element, face.neighbour);
                std::swap(face.local_face, face.neighbour_local_face);
            }
            if (!holds(face.element)) {
                continue;
            }
            if (face.neighbour >= 0 && !holds(face.neighbour)) {
                face.neighbour = ELVIS_NEIGHBOUR_UNKNOWN;
                face.neighbour_local_face = -1;
            }
            m_faces.push_back(face);
        }
    }
}

void PartVolume::read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                               std::span<double> coefficients) const {
    const std::size_t size = 3 * n_modes(m_description.classes[element_class].geometry);
    for_each_run_of(m_elements[element_class], first, count, [&](std::uint64_t from, std::uint64_t n, std::uint64_t at) {
        m_whole->read_geometry(element_class, from, n, coefficients.subspan(at * size, n * size));
    });
}

void PartVolume::read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                            std::uint64_t count, std::span<double> coefficients) const {
    const std::size_t size =
        m_description.fields[field].n_components * n_modes(m_description.classes[element_class].fields[field]);
    for_each_run_of(m_elements[element_class], first, count, [&](std::uint64_t from, std::uint64_t n, std::uint64_t at) {
        m_whole->read_field(field, time_step, element_class, from, n, coefficients.subspan(at * size, n * size));
    });
}

void PartVolume::read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                              std::span<std::int64_t> numbers) const {
    for_each_run_of(m_elements[element_class], first, count, [&](std::uint64_t from, std::uint64_t n, std::uint64_t at) {
        m_whole->read_numbers(element_class, from, n, numbers.subspan(at, n));
    });
}

void PartVolume::read_faces(std::uint64_t first, std::uint64_t count, std::span<native::Face> faces) const {
    std::ranges::copy(std::span(m_faces).subspan(first, count), faces.begin());
}

} // namespace elvis
