#include <core/plugin_host/selection_table.hpp>

#include <algorithm>
#include <utility>

namespace elvis {

namespace {

[[noreturn]] const elvis::RuntimeVolume& no_file(const std::string& path) {
    throw api::Error(ELVIS_ERROR_UNSUPPORTED, path, "a selection of elements is no file");
}

/** By class. */
std::vector<std::uint64_t> counts(const elvis::RuntimeVolume& whole, const std::vector<std::uint64_t>& elements) {
    std::vector<std::uint64_t> n;
    for (const ClassInfo& info : whole.classes()) {
        const auto first = std::ranges::lower_bound(elements, info.first_element);
        const auto end = std::ranges::lower_bound(elements, info.first_element + info.n_elements);
        n.push_back(static_cast<std::uint64_t>(end - first));
    }
    return n;
}

} // namespace

SelectionTable::SelectionTable(const api::Host& host, const std::string& path, const std::string&)
    : SelectionTable(host, no_file(path), {}, SelectedFaces::none) {}

SelectionTable::SelectionTable(const api::Host& host, const elvis::RuntimeVolume& whole, std::vector<std::uint64_t> elements,
                               SelectedFaces faces)
    : HandedOnTable(host, whole, counts(whole, elements)), m_elements(std::move(elements)) {
    if (faces == SelectedFaces::of_elements) {
        select_faces();
    }
}

void SelectionTable::for_each_run(std::uint64_t first, std::uint64_t count, const Read& read) const {
    for (std::uint64_t done = 0; done < count;) {
        std::uint64_t n = 1;
        while (done + n < count && m_elements[first + done + n] == m_elements[first + done] + n) {
            ++n;
        }
        read(m_elements[first + done], n, done);
        done += n;
    }
}

std::int64_t SelectionTable::position(std::int64_t element) const {
    if (element < 0) {
        return element;
    }
    const auto found = std::ranges::lower_bound(m_elements, static_cast<std::uint64_t>(element));
    const bool is_there = found != m_elements.end() && *found == static_cast<std::uint64_t>(element);
    return is_there ? found - m_elements.begin() : std::int64_t{ELVIS_NEIGHBOUR_UNKNOWN};
}

void SelectionTable::select_faces() {
    std::vector<elvis_face> faces;
    read_faces([&](elvis_face face) {
        const bool has_neighbour = face.neighbour >= 0;
        face.element = position(face.element);
        face.neighbour = position(face.neighbour);
        if (face.element < 0 && has_neighbour && face.neighbour >= 0) {
            std::swap(face.element, face.neighbour);
            std::swap(face.local_face, face.neighbour_local_face);
        }
        if (face.element >= 0) {
            face.neighbour_local_face = face.neighbour < 0 ? -1 : face.neighbour_local_face;
            faces.push_back(face);
        }
    });
    set_faces(std::move(faces));
}

} // namespace elvis
