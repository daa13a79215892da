#include <core/base/error.hpp>
#include <core/volume/face_set.hpp>

#include <algorithm>
#include <cstring>

namespace elvis {

namespace {

/** Faces, and elements, that are asked of the plugin at once. */
constexpr std::uint64_t block = 65536;

struct Place {
    std::uint64_t element = 0;
    std::uint32_t local_face = 0;
};

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
                                           (list.empty() ? "there are none" : "its groups are: " + list));
        }
        is_chosen[static_cast<std::size_t>(found - known.begin())] = true;
    }
    return is_chosen;
}

/** In the order of elements. */
std::vector<Place> boundary(const RuntimeVolume& volume, const std::vector<std::string>& groups, const TaskControl* control) {
    if (volume.n_faces() == 0) {
        throw Error(volume.path(), "does not tell its faces, so that its boundary cannot be drawn");
    }
    const std::vector<bool> is_chosen = chosen_groups(volume, groups);
    std::vector<Place> places;
    std::vector<elvis_face> faces;
    for (std::uint64_t first = 0; first < volume.n_faces(); first += block) {
        if (control) {
            control->check();
        }
        faces.resize(std::min(block, volume.n_faces() - first));
        volume.faces(first, faces.size(), faces);
        for (const elvis_face& face : faces) {
            const bool is_wanted = groups.empty() || (face.group >= 0 && is_chosen[static_cast<std::size_t>(face.group)]);
            if (face.neighbour == ELVIS_NEIGHBOUR_NONE && is_wanted) {
                places.push_back({static_cast<std::uint64_t>(face.element), static_cast<std::uint32_t>(face.local_face)});
            }
        }
    }
    std::ranges::sort(places, [](const Place& a, const Place& b) {
        return a.element != b.element ? a.element < b.element : a.local_face < b.local_face;
    });
    return places;
}

/** Six numbers a face: the bounds of its element. */
std::vector<double> boxes_of(const RuntimeVolume& volume, const std::vector<Place>& places, const TaskControl* control) {
    std::vector<double> boxes;
    boxes.reserve(6 * places.size());
    std::vector<double> of_block;
    std::uint64_t first = 0, end = 0;
    for (const Place& place : places) {
        if (place.element >= end) {
            if (control) {
                control->check();
            }
            first = place.element;
            end = std::min(first + block, volume.n_elements());
            of_block.resize(6 * (end - first));
            volume.bounds(first, end - first, of_block);
        }
        const auto box = of_block.begin() + static_cast<std::ptrdiff_t>(6 * (place.element - first));
        boxes.insert(boxes.end(), box, box + 6);
    }
    return boxes;
}

} // namespace

FaceSet::FaceSet(const Device& device, const RuntimeVolume& volume, Precision precision, const std::array<double, 3>& centre,
                 const std::vector<std::string>& groups, const TaskControl* control)
    : m_classes(volume.classes().size()) {
    const std::vector<Place> places = boundary(volume, groups, control);
    const std::vector<double> boxes = boxes_of(volume, places, control);
    m_n_faces = places.size();
    std::size_t first = 0;
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        std::size_t end = first;
        std::vector<std::uint32_t> records;
        for (; end < places.size() && places[end].element < info.first_element + info.n_elements; ++end) {
            records.insert(records.end(), {static_cast<std::uint32_t>(places[end].element - info.first_element),
                                           places[end].local_face, 0u, 0u});
        }
        const std::size_t n = end - first;
        if (n > 0) {
            const Hierarchy hierarchy(std::span<const double>(boxes).subspan(6 * first, 6 * n), centre);
            const std::span<const HierarchyNode> nodes = hierarchy.nodes();
            std::vector<std::uint32_t> words(8 * nodes.size());
            std::memcpy(words.data(), nodes.data(), nodes.size_bytes());
            m_classes[index].nodes = std::make_unique<RecordBuffer>(device, RecordKind::uint, precision, nodes.size(), 8);
            m_classes[index].nodes->write_uints(0, words);
            m_classes[index].faces = std::make_unique<RecordBuffer>(device, RecordKind::uint, precision, n, 4);
            m_classes[index].faces->write_uints(0, records);
        }
        first = end;
    }
}

} // namespace elvis
