#include "box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace elvis::oracle {
namespace {

bool is_near(const Vector& lower, const Vector& upper, const Vector& x, double tolerance) {
    return ((x - lower).array() >= -tolerance).all() && ((upper - x).array() >= -tolerance).all();
}

} // namespace

BoxTree::BoxTree(const std::vector<Enclosure>& enclosures) : m_enclosures(&enclosures), m_items(enclosures.size()) {
    if (enclosures.empty())
        throw std::invalid_argument("a volume without elements");
    std::iota(m_items.begin(), m_items.end(), std::size_t{0});
    build(enclosures, 0, m_items.size());
}

void BoxTree::build(const std::vector<Enclosure>& enclosures, std::size_t first, std::size_t last) {
    const std::size_t node = m_nodes.size();
    m_nodes.push_back({enclosures[m_items[first]].lower, enclosures[m_items[first]].upper, first, last, 0});
    for (std::size_t i = first; i < last; ++i) {
        m_nodes[node].lower = m_nodes[node].lower.cwiseMin(enclosures[m_items[i]].lower);
        m_nodes[node].upper = m_nodes[node].upper.cwiseMax(enclosures[m_items[i]].upper);
    }
    if (last - first <= 4)
        return;
    Eigen::Index direction = 0;
    (m_nodes[node].upper - m_nodes[node].lower).maxCoeff(&direction);
    const std::size_t middle = (first + last) / 2;
    const auto at = [&](std::size_t i) { return m_items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
        return enclosures[a].lower[direction] + enclosures[a].upper[direction] <
               enclosures[b].lower[direction] + enclosures[b].upper[direction];
    });
    build(enclosures, first, middle);
    m_nodes[node].second_child = m_nodes.size();
    build(enclosures, middle, last);
}

std::vector<std::size_t> BoxTree::find(const Vector& x, double tolerance) const {
    std::vector<std::size_t> found;
    find(0, x, tolerance, found);
    std::sort(found.begin(), found.end());
    return found;
}

void BoxTree::find(std::size_t node, const Vector& x, double tolerance, std::vector<std::size_t>& found) const {
    const Node& n = m_nodes[node];
    if (!is_near(n.lower, n.upper, x, tolerance))
        return;
    if (n.second_child != 0) {
        find(node + 1, x, tolerance, found);
        find(n.second_child, x, tolerance, found);
        return;
    }
    for (std::size_t i = n.first; i < n.last; ++i) {
        const Enclosure& e = (*m_enclosures)[m_items[i]];
        if (is_near(e.lower, e.upper, x, tolerance))
            found.push_back(m_items[i]);
    }
}

} // namespace elvis::oracle
