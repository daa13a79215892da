#include <core/base/float_rounding.hpp>
#include <core/base/vector3.hpp>
#include <core/hierarchy/builder.hpp>
#include <core/hierarchy/hierarchy.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>

namespace elvis {
namespace {

/** The next larger number than x, which is finite: std::nextafter is called, and takes several times as long. */
template <class Bits, class Real> Real next_above(Real x) {
    return x == 0 ? std::numeric_limits<Real>::denorm_min() : std::bit_cast<Real>(std::bit_cast<Bits>(x) + (x > 0 ? 1 : -1));
}

/** Smallest float not below x, and one ulp of double more. */
float round_up(double x) {
    const double above = next_above<std::int64_t>(x), rounded = exact_in_float(above);
    const auto result = static_cast<float>(rounded);
    return rounded < above ? next_above<std::int32_t>(result) : result;
}

} // namespace

Hierarchy::Hierarchy(std::span<const double> boxes, const Vector3& centre) : m_centre(centre) {
    assert(boxes.size() % 6 == 0 && boxes.size() / 6 < (1ull << 31u));
    m_n_items = static_cast<std::uint32_t>(boxes.size() / 6);
    std::vector<HierarchyItem> items(m_n_items);
    for (std::uint32_t item = 0; item < m_n_items; ++item) {
        const auto box = boxes.subspan(6 * std::size_t{item}, 6);
        for (std::size_t i = 0; i < 3; ++i) {
            assert(box[i] <= box[i + 3]);
            // The difference is rounded in double: one ulp of double outward makes it a bound again.
            items[item].lower[i] = -round_up(centre[i] - box[i]);
            items[item].upper[i] = round_up(box[i + 3] - centre[i]);
        }
        items[item].index = item;
    }
    m_nodes = build_hierarchy(items);
}

std::uint32_t Hierarchy::depth() const {
    std::vector<std::uint32_t> depths(m_nodes.size(), 0);
    std::uint32_t deepest = 0;
    for (std::size_t node = 0; node < m_nodes.size(); ++node) {
        deepest = std::max(deepest, depths[node]);
        if (!m_nodes[node].is_leaf()) {
            depths[m_nodes[node].child] = depths[m_nodes[node].child + 1] = depths[node] + 1;
        }
    }
    return deepest;
}

void Hierarchy::find(const Vector3& point, double tolerance, std::vector<std::uint32_t>& items) const {
    if (m_nodes.empty()) {
        return;
    }
    const auto contains = [&](const HierarchyNode& node) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = point[i] - m_centre[i];
            if (!(x >= static_cast<double>(node.lower[i]) - tolerance && x <= static_cast<double>(node.upper[i]) + tolerance)) {
                return false;
            }
        }
        return true;
    };
    std::array<std::uint32_t, max_depth + 1> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const HierarchyNode& node = m_nodes[stack[--size]];
        if (!contains(node)) {
            continue;
        }
        if (node.is_leaf()) {
            items.push_back(node.child);
        } else {
            stack[size++] = node.child + 1;
            stack[size++] = node.child;
        }
    }
}

std::vector<std::uint32_t> node_words(std::span<const HierarchyNode> nodes) {
    std::vector<std::uint32_t> words(node_size * nodes.size());
    std::memcpy(words.data(), nodes.data(), nodes.size_bytes());
    return words;
}

} // namespace elvis
