#include <core/volume/segments/walk_data.hpp>

#include <core/volume/segments/face_cones.hpp>
#include <core/volume/segments/face_links.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace elvis {

namespace {

constexpr std::uint32_t place_of_curvature = 7;
/** Elements asked for at once. */
constexpr std::uint64_t walk_block = 1u << 16;

/** Whether a ray can start in the box. */
bool can_start_in(std::span<const double> box, const ViewStart& start) {
    if (!start.direction) {
        bool is_in = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double slack = 1e-5 * (std::abs(start.eye[axis]) + std::abs(box[axis]) + std::abs(box[axis + 3]));
            is_in = is_in && start.eye[axis] >= box[axis] - slack && start.eye[axis] <= box[axis + 3] + slack;
        }
        return is_in;
    }
    double middle = 0, reach = 0, size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = (*start.direction)[axis];
        middle += along * (0.5 * (box[axis] + box[axis + 3]) - start.eye[axis]);
        reach += std::abs(along) * 0.5 * (box[axis + 3] - box[axis]);
        size += std::abs(along) * (std::abs(box[axis]) + std::abs(box[axis + 3]) + std::abs(start.eye[axis]));
    }
    return std::abs(middle) <= reach + 1e-5 * size;
}

} // namespace

WalkData::WalkData(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_volume(volume), m_data(data), m_centre(data.centre()), m_classes(volume.classes().size()) {
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        if (info.n_elements == 0) {
            continue;
        }
        ClassWalk& walk = m_classes[index];
        walk.links =
            std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), info.n_elements, links_an_element);
        // Room for all elements, so that kernels composed with it stay valid.
        walk.nodes =
            std::make_unique<RecordBuffer>(device, RecordKind::uint, data.precision(), 2 * info.n_elements - 1, node_size);
        if (has_curved(index)) {
            walk.cones = measure_face_cones(device, volume, data, index);
        }
        walk.boxes.resize(6 * info.n_elements);
        for (std::uint64_t first = 0; first < info.n_elements; first += walk_block) {
            const std::uint64_t count = std::min(walk_block, info.n_elements - first);
            std::vector<double> boxes(6 * count);
            volume.bounds(info.first_element + first, count, boxes);
            std::ranges::copy(boxes, walk.boxes.begin() + static_cast<std::ptrdiff_t>(6 * first));
        }
    }
    keep_only({});
}

bool WalkData::is_kept(std::uint32_t element) const {
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = m_volume.classes()[index];
        if (element >= info.first_element && element - info.first_element < info.n_elements) {
            return m_classes[index].is_kept[element - info.first_element];
        }
    }
    return false;
}

void WalkData::keep_only(std::vector<std::vector<bool>> kept) {
    const bool is_all = kept.empty();
    for (std::size_t index = 0; index < m_classes.size(); ++index) {
        m_classes[index].is_kept =
            is_all ? std::vector<bool>(m_volume.classes()[index].n_elements, true) : std::move(kept[index]);
    }
    std::vector<std::vector<std::uint32_t>> links = read_face_links(m_volume);
    for (std::uint32_t index = 0; index < m_classes.size(); ++index) {
        const ClassInfo& info = m_volume.classes()[index];
        if (info.n_elements == 0) {
            continue;
        }
        ClassWalk& walk = m_classes[index];
        walk.is_open.resize(info.n_elements);
        const std::span<const float> curvatures = m_data.curvatures(index);
        const bool is_cut = m_volume.is_cut(index);
        const auto n_faces = static_cast<std::size_t>(native::n_faces(native::Shape{info.shape}));
        for (std::uint64_t element = 0; element < info.n_elements; ++element) {
            const auto own = std::span(links[index]).subspan(links_an_element * element, links_an_element);
            for (std::uint32_t& link : own.first(is_all ? 0 : n_faces)) {
                link = link != no_link && is_kept(link) ? link : no_link;
            }
            walk.is_open[element] = is_cut || has_open_face(links[index], info, element);
            own[place_of_curvature] = std::bit_cast<std::uint32_t>(curvatures[element]);
        }
        walk.links->write_uints(0, links[index]);
    }
    m_start.reset();
    m_is_anywhere = false;
}

void WalkData::look_from(const ViewStart& start) {
    if (m_start == start) {
        return;
    }
    choose_starts([&](std::span<const double> box) { return can_start_in(box, start); });
    m_start = start;
    m_is_anywhere = false;
}

void WalkData::look_from_anywhere() {
    if (m_is_anywhere) {
        return;
    }
    choose_starts([](std::span<const double>) { return true; });
    m_start.reset();
    m_is_anywhere = true;
}

template <class CanStart> void WalkData::choose_starts(const CanStart& can_start) {
    std::vector<double> boxes;
    std::vector<std::uint32_t> chosen;
    for (ClassWalk& walk : m_classes) {
        boxes.clear();
        chosen.clear();
        walk.may_hold_eye = false;
        for (std::size_t element = 0; element < walk.is_open.size(); ++element) {
            const auto box = std::span<const double>(walk.boxes).subspan(6 * element, 6);
            if (!walk.is_kept[element]) {
                continue;
            }
            const bool may_hold_eye = can_start(box);
            walk.may_hold_eye = walk.may_hold_eye || may_hold_eye;
            if (walk.is_open[element] || may_hold_eye) {
                chosen.push_back(static_cast<std::uint32_t>(element));
                boxes.insert(boxes.end(), box.begin(), box.end());
            }
        }
        walk.n_starts = chosen.size();
        if (chosen.empty()) {
            continue;
        }
        const Hierarchy hierarchy(boxes, m_centre);
        std::vector<HierarchyNode> nodes(hierarchy.nodes().begin(), hierarchy.nodes().end());
        for (HierarchyNode& node : nodes) {
            node.child = node.is_leaf() ? chosen[node.child] : node.child;
        }
        walk.nodes->write_uints(0, node_words(nodes));
    }
}

bool WalkData::has_curved(std::uint32_t element_class) const {
    return std::ranges::any_of(m_data.curvatures(element_class),
                               [](float curvature) { return curvature > followed_curvature; });
}

std::pair<std::string, std::string> WalkData::curved_define(std::uint32_t element_class) const {
    return {"CORE_HAS_CURVED", m_classes[element_class].cones ? "1" : "0"};
}

std::vector<FetchBuffer> WalkData::host_buffers(std::uint32_t element_class) const {
    const ClassWalk& walk = m_classes[element_class];
    std::vector<FetchBuffer> buffers = {{"core_nodes", walk.nodes.get()}, {"core_links", walk.links.get()}};
    if (walk.cones) {
        buffers.push_back({"core_cones", walk.cones.get()});
    }
    std::ranges::copy(m_data.curvature_records(element_class).bends(), std::back_inserter(buffers));
    return buffers;
}

} // namespace elvis
