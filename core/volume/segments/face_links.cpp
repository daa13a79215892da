#include <core/volume/segments/face_links.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <span>

namespace elvis {

namespace {

constexpr std::uint64_t faces_a_block = 1u << 16;

} // namespace

std::vector<std::vector<std::uint32_t>> read_face_links(const RuntimeVolume& volume) {
    std::vector<std::vector<std::uint32_t>> links;
    for (const ClassInfo& info : volume.classes()) {
        links.emplace_back(links_an_element * info.n_elements, no_link);
    }
    const auto place_of = [&](std::int64_t element) -> std::uint32_t* {
        for (std::size_t index = 0; index < links.size(); ++index) {
            const ClassInfo& info = volume.classes()[index];
            const std::int64_t local = element - static_cast<std::int64_t>(info.first_element);
            if (local >= 0 && static_cast<std::uint64_t>(local) < info.n_elements) {
                return links[index].data() + links_an_element * static_cast<std::uint64_t>(local);
            }
        }
        return nullptr;
    };
    std::vector<elvis_face> faces;
    const std::uint64_t n_faces = volume.n_faces();
    for (std::uint64_t first = 0; first < n_faces; first += faces_a_block) {
        const std::uint64_t count = std::min(faces_a_block, n_faces - first);
        faces.assign(count, elvis_face{});
        volume.faces(first, count, faces);
        for (const elvis_face& face : faces) {
            std::uint32_t* const one = place_of(face.element);
            std::uint32_t* const other = place_of(face.neighbour);
            if (one && other && face.local_face >= 0 && face.neighbour_local_face >= 0) {
                one[face.local_face] = static_cast<std::uint32_t>(face.neighbour);
                other[face.neighbour_local_face] = static_cast<std::uint32_t>(face.element);
            }
        }
    }
    return links;
}

bool has_open_face(const std::vector<std::uint32_t>& links, const ClassInfo& info, std::uint64_t local_element) {
    const auto own = std::span(links).subspan(links_an_element * local_element,
                                              static_cast<std::size_t>(native::n_faces(native::Shape{info.shape})));
    return std::ranges::find(own, no_link) != own.end();
}

} // namespace elvis
