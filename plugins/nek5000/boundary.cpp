#include "boundary.hpp"

#include <filesystem>
#include <limits>
#include <map>

namespace elvis_nek5000 {

namespace {

constexpr std::size_t max_groups = std::numeric_limits<std::int16_t>::max();

/** Between elements: nothing of the boundary. J and SP are sides of nonconforming elements. */
bool is_interior(const std::string& kind) { return kind == "E" || kind == "J" || kind == "SP"; }

/** The mesh's faces: s = -1, r = 1, s = 1, r = -1, t = -1, t = 1. In two dimensions the first four. */
std::size_t local_face(std::uint32_t face, std::uint32_t dimension) {
    constexpr std::array<std::size_t, 6> in_space{1, 2, 3, 4, 0, 5};
    return dimension == 3 ? in_space[face - 1] : face - 1;
}

/** A condition and the number of its surface. */
using Key = std::pair<std::string, std::int64_t>;

std::vector<std::string> name_groups(const std::vector<Key>& keys) {
    std::map<std::string, int> n_surfaces;
    for (const Key& key : keys) {
        ++n_surfaces[key.first];
    }
    std::vector<std::string> names;
    for (const auto& [kind, tag] : keys) {
        names.push_back(n_surfaces[kind] > 1 ? kind + " " + std::to_string(tag) : kind);
    }
    return names;
}

} // namespace

Boundary::Boundary(const MeshFile& mesh) {
    constexpr std::int16_t unset = -2;
    std::array<std::int16_t, 6> none;
    none.fill(unset);
    m_groups.assign(mesh.n_elements(), none);
    std::vector<Key> keys;
    std::map<Key, std::int16_t> index_of;
    mesh.for_each_condition([&](const FaceCondition& condition) {
        const bool is_face = condition.face >= 1 && condition.face <= 2 * mesh.dimension();
        if (condition.element < 1 || condition.element > m_groups.size() || !is_face) {
            return;
        }
        std::int16_t& group = m_groups[condition.element - 1][local_face(condition.face, mesh.dimension())];
        // What the fluid has on a face comes before what temperature and scalars have.
        if (group != unset || condition.kind.empty()) {
            return;
        }
        group = ELVIS_GROUP_NONE;
        if (is_interior(condition.kind)) {
            return;
        }
        // In periodic faces the numbers name the partner.
        const Key key(condition.kind, condition.kind == "P" ? 0 : condition.tag);
        const auto [found, is_new] = index_of.try_emplace(key, static_cast<std::int16_t>(keys.size()));
        if (is_new && keys.size() == max_groups) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, {}, "more than 32767 kinds of conditions");
        }
        if (is_new) {
            keys.push_back(key);
        }
        group = found->second;
    });
    m_names = name_groups(keys);
}

std::int32_t Boundary::group(std::uint64_t element, int local_face) const {
    const std::int32_t group = m_groups.empty() ? ELVIS_GROUP_NONE : m_groups[element][static_cast<std::size_t>(local_face)];
    return std::max(group, ELVIS_GROUP_NONE);
}

Boundary find_boundary(const std::vector<std::string>& mesh_paths, std::uint64_t n_elements, std::uint32_t dimension,
                       const elvis::api::Host& host) {
    for (const std::string& path : mesh_paths) {
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) {
            continue;
        }
        std::string cause = "has another number of elements or dimensions than the fields";
        try {
            const MeshFile mesh(path);
            if (mesh.n_elements() == n_elements && mesh.dimension() == dimension) {
                return Boundary(mesh);
            }
        } catch (const elvis::api::Error& error) {
            cause = error.what();
        }
        host.log(ELVIS_LOG_WARNING, path + ": " + cause + "; its boundary conditions are not used");
    }
    return {};
}

} // namespace elvis_nek5000
