#include <core/hierarchy/hierarchy.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using elvis::Hierarchy;
using elvis::HierarchyNode;

namespace {

using Point = std::array<double, 3>;

std::vector<double> random_boxes(std::size_t n, const Point& centre, double largest, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> boxes;
    for (std::size_t i = 0; i < n; ++i) {
        Point lower{}, size{};
        for (std::size_t k = 0; k < 3; ++k) {
            lower[k] = centre[k] + 2 * unit(random) - 1;
            size[k] = largest * unit(random);
        }
        boxes.insert(boxes.end(), {lower[0], lower[1], lower[2], lower[0] + size[0], lower[1] + size[1], lower[2] + size[2]});
    }
    return boxes;
}

/** Items whose box, grown by `slack`, contains the point. */
std::vector<std::uint32_t> brute_force(const std::vector<double>& boxes, const Point& point, double slack) {
    std::vector<std::uint32_t> items;
    for (std::uint32_t i = 0; i < boxes.size() / 6; ++i) {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            inside = inside && point[k] >= boxes[6 * i + k] - slack && point[k] <= boxes[6 * i + 3 + k] + slack;
        }
        if (inside) {
            items.push_back(i);
        }
    }
    return items;
}

std::vector<std::uint32_t> found(const Hierarchy& hierarchy, const Point& point, double tolerance) {
    std::vector<std::uint32_t> items;
    hierarchy.find(point, tolerance, items);
    std::sort(items.begin(), items.end());
    return items;
}

bool contains_all(const std::vector<std::uint32_t>& outer, const std::vector<std::uint32_t>& inner) {
    return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
}

/** Every item in exactly one leaf, children inside their parents and after them. */
void check_structure(const Hierarchy& hierarchy) {
    const auto nodes = hierarchy.nodes();
    REQUIRE(nodes.size() == 2 * std::size_t{hierarchy.n_items()} - 1);
    REQUIRE(hierarchy.depth() <= Hierarchy::max_depth);
    std::vector<int> seen(hierarchy.n_items(), 0);
    bool nested = true;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const HierarchyNode& node = nodes[i];
        if (node.is_leaf()) {
            ++seen.at(node.child);
            continue;
        }
        nested = nested && node.child > i && node.child + 1 < nodes.size();
        for (const HierarchyNode& child : {nodes[node.child], nodes[node.child + 1]}) {
            for (std::size_t k = 0; k < 3; ++k) {
                nested = nested && child.lower[k] >= node.lower[k] && child.upper[k] <= node.upper[k];
            }
        }
    }
    CHECK(nested);
    CHECK(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
}

} // namespace

TEST_CASE("a query finds what brute force finds") {
    const Point centre{1000, -20, 3};
    const auto boxes = random_boxes(5000, centre, 0.2, 1);
    const Hierarchy hierarchy(boxes, centre);
    check_structure(hierarchy);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-1.1, 1.1);
    for (const double tolerance : {0.0, 0.05}) {
        std::size_t n_found = 0;
        for (int i = 0; i < 1000; ++i) {
            const Point point{centre[0] + unit(random), centre[1] + unit(random), centre[2] + unit(random)};
            const auto items = found(hierarchy, point, tolerance);
            // Rounding outward may add a box that misses by an ulp of 1, no more.
            CHECK(contains_all(items, brute_force(boxes, point, tolerance)));
            CHECK(contains_all(brute_force(boxes, point, tolerance + 3e-7), items));
            n_found += items.size();
        }
        CHECK(n_found > 300);
    }
}

TEST_CASE("corners of boxes are inside whatever the rounding") {
    const Point centre{0.1, 0.2, 0.3};
    const auto boxes = random_boxes(2000, centre, 0.01, 3);
    const Hierarchy hierarchy(boxes, centre);
    for (std::uint32_t i = 0; i < 2000; ++i) {
        for (const std::size_t corner : {0u, 3u}) {
            const Point point{boxes[6 * i + corner], boxes[6 * i + corner + 1], boxes[6 * i + corner + 2]};
            const auto items = found(hierarchy, point, 0);
            CHECK(std::binary_search(items.begin(), items.end(), i));
        }
    }
}

TEST_CASE("degenerate sets of boxes give valid trees") {
    SECTION("none") {
        const Hierarchy hierarchy(std::vector<double>{}, {0, 0, 0});
        CHECK(hierarchy.nodes().empty());
        CHECK(found(hierarchy, {0, 0, 0}, 1).empty());
    }
    SECTION("one, a point") {
        const Hierarchy hierarchy(std::vector<double>{1, 2, 3, 1, 2, 3}, {0, 0, 0});
        check_structure(hierarchy);
        CHECK(found(hierarchy, {1, 2, 3}, 0) == std::vector<std::uint32_t>{0});
        CHECK(found(hierarchy, {1, 2, 3.001}, 0).empty());
        CHECK(found(hierarchy, {1, 2, 3.001}, 0.01).size() == 1);
    }
    SECTION("identical boxes") {
        std::vector<double> boxes;
        for (int i = 0; i < 1000; ++i) {
            boxes.insert(boxes.end(), {-1, -1, -1, 1, 1, 1});
        }
        const Hierarchy hierarchy(boxes, {0, 0, 0});
        check_structure(hierarchy);
        CHECK(hierarchy.depth() <= 11);
        CHECK(found(hierarchy, {0, 0, 0}, 0).size() == 1000);
    }
    SECTION("flat boxes and lines") {
        for (const int n_flat : {1, 2, 3}) {
            auto boxes = random_boxes(1000, {0, 0, 0}, 0.3, 4);
            for (std::size_t i = 0; i < 1000; ++i) {
                for (int k = 0; k < n_flat; ++k) {
                    boxes[6 * i + static_cast<std::size_t>(k)] = boxes[6 * i + 3 + static_cast<std::size_t>(k)] = 0.5;
                }
            }
            const Hierarchy hierarchy(boxes, {0, 0, 0});
            check_structure(hierarchy);
            const Point point{0.5, 0.1, 0.2};
            CHECK(found(hierarchy, point, 0) == brute_force(boxes, point, 0));
        }
    }
    SECTION("sizes that double from box to box") {
        // The heuristic would cut off one box at a time: 2^-100 .. 2^59.
        std::vector<double> boxes;
        for (int i = -100; i < 60; ++i) {
            const double size = std::ldexp(1.0, i);
            boxes.insert(boxes.end(), {size, 0, 0, 1.5 * size, size, size});
        }
        check_structure(Hierarchy(boxes, {0, 0, 0}));
    }
}

TEST_CASE("a volume of many elements is built on two threads as on one") {
    // More items than the builder's threshold for threads.
    const auto boxes = random_boxes(100000, {0, 0, 0}, 0.02, 6);
    const Hierarchy hierarchy(boxes, {0, 0, 0});
    check_structure(hierarchy);
    const Hierarchy again(boxes, {0, 0, 0});
    CHECK(std::equal(
        hierarchy.nodes().begin(), hierarchy.nodes().end(), again.nodes().begin(),
        [](const HierarchyNode& a, const HierarchyNode& b) { return a.child == b.child && a.n_items == b.n_items; }));
}
