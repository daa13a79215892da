#include "rank_volume.hpp"
#include "ranks.hpp"

#include <core/api/array_mesh.hpp>
#include <core/api/call.hpp>
#include <core/parts/all_boxes.hpp>
#include <core/session/volume/warped.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <sstream>

namespace elvis::library {

namespace {

/** Numbers of any kind in a row of bytes, to be sent. */
class ByteRow {
public:
    template <class T> void put(std::span<const T> items) {
        const auto raw = std::as_bytes(items);
        m_bytes.insert(m_bytes.end(), raw.begin(), raw.end());
    }
    std::vector<std::byte> take() { return std::move(m_bytes); }

private:
    std::vector<std::byte> m_bytes;
};

class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : m_left(bytes) {}
    template <class T> void read(std::span<T> items) {
        assert(m_left.size() >= items.size_bytes());
        std::ranges::copy(m_left.first(items.size_bytes()), std::as_writable_bytes(items).begin());
        m_left = m_left.subspan(items.size_bytes());
    }

private:
    std::span<const std::byte> m_left;
};

std::size_t count_corners(const elvis_array_class& given) {
    return static_cast<std::size_t>(native::n_corners(static_cast<native::Shape>(given.shape)));
}

std::size_t count_faces(const elvis_array_class& given) {
    return static_cast<std::size_t>(native::n_faces(static_cast<native::Shape>(given.shape)));
}

/** All that has to be the same on all ranks. */
std::string as_text(const ArrayContents& contents) {
    std::ostringstream text;
    const auto add = [&](const native::Space& space) {
        text << static_cast<int>(space.basis) << ' ' << space.order[0] << ' ' << space.order[1] << ' ' << space.order[2] << ';';
    };
    for (std::size_t index = 0; index < contents.classes.size(); ++index) {
        const native::ElementClass& own = contents.description.classes[index];
        text << contents.classes[index].shape << ' ' << (contents.classes[index].corners != nullptr) << ';';
        add(own.geometry);
        std::ranges::for_each(own.fields, add);
    }
    for (const native::Field& field : contents.description.fields) {
        text << field.name << '\n' << field.n_components << ' ' << static_cast<int>(field.continuity) << ';';
    }
    for (const std::string& group : contents.description.boundary_groups) {
        text << group << '\n';
    }
    return text.str();
}

/** Where a face between two elements, or of one alone, stands in a list: at its lower side. */
std::pair<std::int64_t, std::int32_t> key_of_face(const native::Face& face) { return {face.element, face.local_face}; }

} // namespace

RankVolume::RankVolume(const elvis_arrays& arrays, std::string name, CommunicatorTeam& team, const TaskControl& control)
    : m_name(std::move(name)), m_team(team), m_control(control), m_contents(arrays, true),
      m_is_changed(m_contents.fields.size(), true) {
    if (arrays.n_time_steps > 1) {
        throw InvalidArgument("arrays", "have more than one time step");
    }
    m_contents.description.times = {0};
    need_same_on_all(as_text(m_contents), m_team, "arrays", "classes, fields or boundary groups are not those of rank 0");
    m_values.resize(m_contents.fields.size());
    for (std::size_t field = 0; field < m_values.size(); ++field) {
        need(m_contents.fields[field].values, "values");
        for (std::uint32_t index = 0; index < m_contents.classes.size(); ++index) {
            m_values[field].push_back(nullptr);
            set_values(static_cast<std::uint32_t>(field), index, m_contents.fields[field].values[index]);
        }
    }
    count_elements();
    find_surroundings();
    share_mesh();
    find_faces();
    serve_own();
}

void RankVolume::set_values(std::uint32_t field, std::uint32_t element_class, const double* values) {
    if (field >= m_values.size() || element_class >= m_contents.classes.size()) {
        throw InvalidArgument("field", "there is no such field or class of elements");
    }
    if (m_contents.classes[element_class].n_elements > 0) {
        need(values, "values");
    }
    m_values[field][element_class] = values;
}

void RankVolume::count_elements() {
    std::vector<std::uint64_t> own;
    for (const elvis_array_class& given : m_contents.classes) {
        own.push_back(given.n_elements);
    }
    ElementsOfRanks all = elements_of_ranks(own, m_team, "arrays");
    native::Description description = m_contents.description;
    for (std::size_t index = 0; index < own.size(); ++index) {
        description.classes[index].n_elements = all.n_elements[index];
    }
    m_partition.emplace(std::move(all.partition));
    m_own_elements = m_partition->elements(m_team.rank());
    m_source = std::make_shared<SharedVolume>(std::move(description));
}

/** Own elements are held first, for their bounds; then also those whose bounds are near. */
void RankVolume::find_surroundings() {
    const auto hold = [&](std::span<const std::uint64_t> elements) {
        m_source->hold(elements);
        std::vector<std::uint64_t> n_done(m_contents.classes.size());
        for (const std::uint64_t element : m_own_elements) {
            const ElementPlace where = m_source->place(element);
            const std::span<double> own = m_source->geometry(where.element_class, m_source->slot(where));
            std::copy_n(m_contents.geometry[where.element_class].begin() +
                            static_cast<std::ptrdiff_t>(n_done[where.element_class]++ * own.size()),
                        own.size(), own.begin());
        }
    };
    hold(m_own_elements);
    const RuntimeVolume bounded = serve_native(m_source, m_name, &m_control);
    const std::vector<double> boxes = all_boxes(bounded, *m_partition, m_team, &m_control);
    m_held = with_surroundings(boxes, m_own_elements);
    hold(m_held);
    // Each asks the others for theirs.
    m_taken.resize(m_team.size());
    m_given.resize(m_team.size());
    std::vector<std::vector<std::byte>> wishes(m_team.size());
    for (std::uint32_t rank = 0; rank < m_team.size(); ++rank) {
        if (rank != m_team.rank()) {
            std::ranges::set_intersection(m_held, m_partition->elements(rank), std::back_inserter(m_taken[rank]));
            ByteRow row;
            row.put(std::span<const std::uint64_t>(m_taken[rank]));
            wishes[rank] = row.take();
        }
    }
    const std::vector<std::vector<std::byte>> wanted = m_team.exchanged(std::move(wishes));
    for (std::uint32_t rank = 0; rank < m_team.size(); ++rank) {
        m_given[rank].resize(wanted[rank].size() / sizeof(std::uint64_t));
        ByteReader(wanted[rank]).read(std::span(m_given[rank]));
    }
}

template <class Give, class Take> void RankVolume::share(Give give, Take take) {
    std::vector<std::vector<std::byte>> sent(m_team.size());
    for (std::uint32_t rank = 0; rank < m_team.size(); ++rank) {
        ByteRow row;
        for (const std::uint64_t element : m_given[rank]) {
            const ElementPlace where = m_source->place(element);
            give(row, where.element_class, m_source->slot(where));
        }
        sent[rank] = row.take();
    }
    const std::vector<std::vector<std::byte>> received = m_team.exchanged(std::move(sent));
    for (std::uint32_t rank = 0; rank < m_team.size(); ++rank) {
        ByteReader reader(received[rank]);
        for (const std::uint64_t element : m_taken[rank]) {
            const ElementPlace where = m_source->place(element);
            take(reader, where.element_class, m_source->slot(where));
        }
    }
}

/** Geometry, corners and groups of elements around own ones. */
void RankVolume::share_mesh() {
    const auto& classes = m_contents.classes;
    for (std::size_t index = 0; index < classes.size(); ++index) {
        const std::size_t n_held = m_source->held(index).size();
        m_corners.emplace_back(n_held * count_corners(classes[index]));
        m_face_groups.emplace_back(n_held * count_faces(classes[index]), ELVIS_GROUP_NONE);
    }
    const auto corners_of = [&](std::size_t index, std::uint64_t slot) {
        const std::size_t n = count_corners(classes[index]);
        return std::span(m_corners[index]).subspan(slot * n, n);
    };
    const auto groups_of = [&](std::size_t index, std::uint64_t slot) {
        const std::size_t n = count_faces(classes[index]);
        return std::span(m_face_groups[index]).subspan(slot * n, n);
    };
    std::vector<std::uint64_t> n_done(classes.size());
    for (const std::uint64_t element : m_own_elements) {
        const ElementPlace where = m_source->place(element);
        const elvis_array_class& given = classes[where.element_class];
        const std::uint64_t slot = m_source->slot(where), at = n_done[where.element_class]++;
        if (given.corners != nullptr) {
            const auto corners = corners_of(where.element_class, slot);
            std::copy_n(given.corners + at * corners.size(), corners.size(), corners.begin());
        }
        if (given.face_groups != nullptr) {
            const auto groups = groups_of(where.element_class, slot);
            std::copy_n(given.face_groups + at * groups.size(), groups.size(), groups.begin());
        }
    }
    share(
        [&](ByteRow& row, std::size_t index, std::uint64_t slot) {
            row.put(std::span<const double>(m_source->geometry(index, slot)));
            row.put(std::span<const std::int64_t>(corners_of(index, slot)));
            row.put(std::span<const std::int32_t>(groups_of(index, slot)));
        },
        [&](ByteReader& reader, std::size_t index, std::uint64_t slot) {
            reader.read(m_source->geometry(index, slot));
            reader.read(corners_of(index, slot));
            reader.read(groups_of(index, slot));
        });
}

/**
 * What own elements meet is found among the elements that are held: there are all that touch them. Of those around them their
 * own ranks know it, and tell.
 */
void RankVolume::find_faces() {
    native::Description description = m_source->description();
    std::vector<std::vector<double>> geometry;
    std::vector<elvis_array_class> classes = m_contents.classes;
    for (std::size_t index = 0; index < classes.size(); ++index) {
        classes[index].n_elements = description.classes[index].n_elements = m_source->held(index).size();
        classes[index].corners = classes[index].corners != nullptr ? m_corners[index].data() : nullptr;
        classes[index].face_groups = m_face_groups[index].data();
        std::vector<double>& numbers = geometry.emplace_back();
        for (std::uint64_t slot = 0; slot < classes[index].n_elements; ++slot) {
            const std::span<const double> one = m_source->geometry(index, slot);
            numbers.insert(numbers.end(), one.begin(), one.end());
        }
    }
    // By element that is held and local face.
    constexpr std::size_t most_faces = 6;
    const native::Face none{-1, ELVIS_NEIGHBOUR_UNKNOWN, 0, -1, ELVIS_GROUP_NONE};
    std::vector<std::array<native::Face, most_faces>> sides(m_held.size());
    for (auto& of_element : sides) {
        of_element.fill(none);
    }
    const auto number_of = [&](std::int64_t held) {
        return held >= 0 ? static_cast<std::int64_t>(m_held[static_cast<std::size_t>(held)]) : held;
    };
    if (!m_held.empty()) {
        for (native::Face face : faces_of_mesh(description, geometry, classes, m_name, m_control)) {
            const std::int64_t element = face.element, neighbour = face.neighbour;
            face.element = number_of(element);
            face.neighbour = number_of(neighbour);
            sides[static_cast<std::size_t>(element)][static_cast<std::size_t>(face.local_face)] = face;
            if (neighbour >= 0) {
                sides[static_cast<std::size_t>(neighbour)][static_cast<std::size_t>(face.neighbour_local_face)] = face;
            }
        }
    }
    const auto sides_of = [&](std::size_t index, std::uint64_t slot) -> std::span<native::Face> {
        const std::uint64_t element = m_source->first_element(index) + m_source->held(index)[slot];
        return sides[static_cast<std::size_t>(std::ranges::lower_bound(m_held, element) - m_held.begin())];
    };
    share([&](ByteRow& row, std::size_t index,
              std::uint64_t slot) { row.put(std::span<const native::Face>(sides_of(index, slot))); },
          [&](ByteReader& reader, std::size_t index, std::uint64_t slot) { reader.read(sides_of(index, slot)); });
    std::vector<native::Face> faces;
    for (const auto& of_element : sides) {
        std::ranges::copy_if(of_element, std::back_inserter(faces), [](const native::Face& face) { return face.element >= 0; });
    }
    std::ranges::sort(faces, {}, key_of_face);
    const auto repeated = std::ranges::unique(faces, {}, key_of_face);
    faces.erase(repeated.begin(), repeated.end());
    m_source->set_faces(std::move(faces));
}

void RankVolume::serve_own() {
    m_whole.emplace(serve_native(m_source, m_name, &m_control));
    m_parted = parted_native({.source = m_source, .shared_mapping = mapping_of_ranks(*m_whole, *m_partition, m_team)}, *m_whole,
                             &m_control);
    if (!m_own_elements.empty()) {
        m_own.emplace(m_parted->open(m_own_elements));
    }
}

std::uint64_t RankVolume::read_values() {
    std::uint64_t n_read = 0;
    bool is_any_changed = false;
    std::vector<double> coefficients;
    for (std::size_t field = 0; field < m_values.size(); ++field) {
        std::vector<std::uint64_t> n_done(m_contents.classes.size());
        std::vector<std::vector<double>> by_own_class(n_done.size());
        for (std::size_t index = 0; index < n_done.size(); ++index) {
            const std::uint64_t n_elements = m_contents.classes[index].n_elements;
            if (n_elements > 0) {
                const ToModes& to_modes = m_contents.to_modes[field][index];
                const std::size_t size = n_elements * m_contents.description.fields[field].n_components * to_modes.n_modes();
                by_own_class[index].resize(size);
                to_modes.apply({m_values[field][index], size}, by_own_class[index]);
                n_read += size;
            }
        }
        for (const std::uint64_t element : m_own_elements) {
            const ElementPlace where = m_source->place(element);
            const std::span<double> own = m_source->field(field, where.element_class, m_source->slot(where));
            const auto now = std::span<const double>(by_own_class[where.element_class])
                                 .subspan(n_done[where.element_class]++ * own.size(), own.size());
            if (std::memcmp(own.data(), now.data(), own.size_bytes()) != 0) {
                std::ranges::copy(now, own.begin());
                m_is_changed[field] = true;
                is_any_changed = true;
            }
        }
    }
    if (is_any_changed && m_own) {
        m_own->forget_fields();
    }
    return n_read;
}

std::vector<std::uint32_t> RankVolume::share_values() {
    std::vector<double> is_same;
    for (const bool is_changed : m_is_changed) {
        is_same.push_back(is_changed ? 0 : 1);
    }
    m_team.minimum(is_same);
    std::vector<std::uint32_t> changed;
    for (std::uint32_t field = 0; field < is_same.size(); ++field) {
        if (is_same[field] == 0) {
            changed.push_back(field);
        }
    }
    share(
        [&](ByteRow& row, std::size_t index, std::uint64_t slot) {
            for (const std::uint32_t field : changed) {
                row.put(std::span<const double>(m_source->field(field, index, slot)));
            }
        },
        [&](ByteReader& reader, std::size_t index, std::uint64_t slot) {
            for (const std::uint32_t field : changed) {
                reader.read(m_source->field(field, index, slot));
            }
        });
    m_is_changed.assign(m_is_changed.size(), false);
    return changed;
}

} // namespace elvis::library
