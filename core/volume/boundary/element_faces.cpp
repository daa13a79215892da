#include <core/base/error.hpp>
#include <core/volume/boundary/element_faces.hpp>

#include <algorithm>

namespace elvis {

namespace {

/** Faces that are asked of the plugin at once. */
constexpr std::uint64_t element_face_block = 65536;

std::vector<bool> chosen_groups(const RuntimeVolume& volume, const std::vector<std::string>& names) {
    const std::vector<std::string>& known = volume.boundary_groups();
    std::vector<bool> is_chosen(known.size(), false);
    for (const std::string& name : names) {
        const auto found = std::ranges::find(known, name);
        if (found == known.end()) {
            std::string list;
            for (const std::string& one : known) {
                list += (list.empty() ? "" : ", ") + one;
            }
            throw Error(volume.path(), "has no boundary group '" + name + "'; " +
                                           (list.empty() ? "there are none" : "its groups are: " + list) +
                                           ". Without a name, the whole boundary is drawn");
        }
        is_chosen[static_cast<std::size_t>(found - known.begin())] = true;
    }
    return is_chosen;
}

} // namespace

std::vector<ElementFace> boundary_faces(const RuntimeVolume& volume, const std::vector<std::string>& groups,
                                        const TaskControl* control) {
    if (volume.n_faces() == 0) {
        throw Error(volume.path(), "does not tell its faces, so that its boundary cannot be drawn");
    }
    const std::vector<bool> is_chosen = chosen_groups(volume, groups);
    std::vector<ElementFace> places;
    std::vector<elvis_face> faces;
    for (std::uint64_t first = 0; first < volume.n_faces(); first += element_face_block) {
        if (control) {
            control->check();
        }
        faces.resize(std::min(element_face_block, volume.n_faces() - first));
        volume.faces(first, faces.size(), faces);
        for (const elvis_face& face : faces) {
            const bool is_wanted = groups.empty() || (face.group >= 0 && is_chosen[static_cast<std::size_t>(face.group)]);
            if (face.neighbour == ELVIS_NEIGHBOUR_NONE && is_wanted) {
                places.push_back(
                    {static_cast<std::uint64_t>(face.element), static_cast<std::uint32_t>(face.local_face), false});
            }
        }
    }
    std::ranges::sort(places, [](const ElementFace& a, const ElementFace& b) {
        return a.element != b.element ? a.element < b.element : a.local_face < b.local_face;
    });
    return places;
}

std::vector<ElementFace> surface_elements(const RuntimeVolume& volume) {
    std::vector<ElementFace> places(volume.n_elements());
    for (std::uint64_t element = 0; element < places.size(); ++element) {
        places[element].element = element;
    }
    return places;
}

} // namespace elvis
