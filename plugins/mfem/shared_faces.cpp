#include "shared_faces.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace elvis_mfem {

namespace {

using Corner = std::array<double, 3>;
/** A cube of space. */
using Cell = std::array<std::int64_t, 3>;

/** Points of the same place have the same numbers in both files; what is computed from them is rounded. */
constexpr double tolerance = 1e-9;

struct Middle {
    Corner at{};
    std::size_t part = 0, element = 0;
};

/** By vertex. */
std::vector<Corner> vertex_positions(const Part& part) {
    std::vector<Corner> positions(part.mesh().n_vertices);
    for (std::size_t element = 0; element < part.mesh().elements.size(); ++element) {
        const MeshElement& source = part.mesh().elements[element];
        const auto native_shape = static_cast<elvis::native::Shape>(shape(source.geometry));
        const auto corners = corner_vertices(source.geometry);
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
            const elvis::native::Point xi = elvis::native::corner(native_shape, static_cast<int>(corner));
            const std::int32_t vertex = source.vertices[static_cast<std::size_t>(corners[corner])];
            part.mapping().evaluate(element, xi, positions[static_cast<std::size_t>(vertex)].data(), 3);
        }
    }
    return positions;
}

Corner middle_of(const BoundaryElement& element, const std::vector<Corner>& positions) {
    Corner middle{};
    double n = 0;
    for (const std::int32_t vertex : element.vertices) {
        for (std::size_t axis = 0; vertex >= 0 && axis < 3; ++axis) {
            middle[axis] += positions[static_cast<std::size_t>(vertex)][axis];
        }
        n += vertex >= 0 ? 1 : 0;
    }
    for (double& coordinate : middle) {
        coordinate /= n;
    }
    return middle;
}

double extent_of(const std::vector<Middle>& middles) {
    double largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [least, most] =
            std::ranges::minmax_element(middles, {}, [axis](const Middle& middle) { return middle.at[axis]; });
        largest = std::max(largest, most->at[axis] - least->at[axis]);
    }
    return largest;
}

/** Middles by the cells that they are in, which are as large as the tolerance. */
class Places {
public:
    explicit Places(double size) : m_size(size) {}

    void add(const Middle& middle) { m_middles.emplace(cell(middle.at), middle); }
    /** One of another part at the same place; null if there is none. */
    const Middle* other(const Middle& middle) const {
        const Cell own = cell(middle.at);
        for (int neighbour = 0; neighbour < 27; ++neighbour) {
            const Cell near{own[0] + neighbour % 3 - 1, own[1] + neighbour / 3 % 3 - 1, own[2] + neighbour / 9 - 1};
            const auto [first, last] = m_middles.equal_range(near);
            const auto found = std::find_if(first, last, [&](const auto& entry) { return entry.second.part != middle.part; });
            if (found != last) {
                return &found->second;
            }
        }
        return nullptr;
    }

private:
    Cell cell(const Corner& at) const {
        const auto index = [this](double x) {
            constexpr double most = 9e18; // What an integer holds.
            return static_cast<std::int64_t>(std::clamp(std::floor(x / m_size), -most, most));
        };
        return {index(at[0]), index(at[1]), index(at[2])};
    }

    double m_size;
    std::multimap<Cell, Middle> m_middles;
};

} // namespace

std::vector<std::vector<bool>> shared_faces(const std::vector<std::unique_ptr<const Part>>& parts) {
    std::vector<std::vector<bool>> shared;
    std::vector<Middle> middles;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const std::vector<BoundaryElement>& boundary = parts[part]->mesh().boundary;
        shared.emplace_back(boundary.size(), false);
        const std::vector<Corner> positions = parts.size() > 1 ? vertex_positions(*parts[part]) : std::vector<Corner>();
        for (std::size_t element = 0; parts.size() > 1 && element < boundary.size(); ++element) {
            middles.push_back({middle_of(boundary[element], positions), part, element});
        }
    }
    if (middles.empty()) {
        return shared;
    }
    Places places(std::max(tolerance * extent_of(middles), std::numeric_limits<double>::min()));
    for (const Middle& middle : middles) {
        if (const Middle* const other = places.other(middle)) {
            shared[middle.part][middle.element] = shared[other->part][other->element] = true;
        }
        places.add(middle);
    }
    return shared;
}

} // namespace elvis_mfem
