#include <core/hierarchy/builder.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <future>
#include <limits>
#include <thread>
#include <utility>

namespace elvis {
namespace {

constexpr std::uint32_t n_bins = 16;
/** Below this many items a second thread costs more than it gains. */
constexpr std::size_t parallel_items = 1u << 15u;

/** Three coordinates, and one that nobody looks at: a processor handles four at once. */
using Corner [[gnu::vector_size(16)]] = float;

Corner corner(const float* numbers) {
    Corner result;
    std::memcpy(&result, numbers, sizeof result);
    return result;
}
Corner lower_of(const HierarchyItem& item) { return corner(item.lower.data()); }
Corner upper_of(const HierarchyItem& item) { return corner(item.upper.data()); }

struct Bounds {
    Corner lower = Corner{} + std::numeric_limits<float>::infinity();
    Corner upper = Corner{} - std::numeric_limits<float>::infinity();

    void include(const Corner& low, const Corner& high) {
        lower = low < lower ? low : lower;
        upper = upper < high ? high : upper;
    }
    void include(const Bounds& other) { include(other.lower, other.upper); }
    /** Half the surface; what the heuristic compares is the same for half and whole. */
    float area() const {
        const Corner size = upper - lower;
        return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
};

/** Twice the centre of the item's box: the factor does not matter for binning. */
float centroid(const HierarchyItem& item, std::size_t axis) { return item.lower[axis] + item.upper[axis]; }

/** Maps centroids of one node to bins along one axis. */
struct Binning {
    std::size_t axis = 0;
    float origin = 0;
    float scale = 0;

    std::uint32_t bin(const HierarchyItem& item) const {
        const float position = (centroid(item, axis) - origin) * scale;
        return std::min(static_cast<std::uint32_t>(position), n_bins - 1);
    }
};

struct Split {
    Binning binning;
    /** Items of bins below this one go left. */
    std::uint32_t first_right_bin = 0;
    float cost = std::numeric_limits<float>::infinity();
};

struct Bin {
    Bounds bounds;
    std::uint32_t n_items = 0;
};

void find_split_on_axis(const Binning& binning, const std::array<Bin, n_bins>& bins, Split& best) {
    std::array<float, n_bins> right_cost{};
    Bounds right;
    std::uint32_t n_right = 0;
    for (std::uint32_t i = n_bins - 1; i > 0; --i) {
        right.include(bins[i].bounds);
        n_right += bins[i].n_items;
        right_cost[i] = n_right == 0 ? 0 : right.area() * static_cast<float>(n_right);
    }
    Bounds left;
    std::uint32_t n_left = 0;
    for (std::uint32_t i = 1; i < n_bins; ++i) {
        left.include(bins[i - 1].bounds);
        n_left += bins[i - 1].n_items;
        if (n_left == 0 || right_cost[i] == 0) {
            // Either side empty (or flat to a line, where the heuristic has nothing to say): not a split.
            continue;
        }
        const float cost = left.area() * static_cast<float>(n_left) + right_cost[i];
        if (cost < best.cost) {
            best = Split{binning, i, cost};
        }
    }
}

class Builder {
public:
    Builder(std::span<HierarchyItem> items, std::span<HierarchyNode> nodes) : m_items(items), m_nodes(nodes) {}

    /**
     * Builds the subtree of items first .. first+count-1 at `node`. A subtree of n items has n-1 pairs of children, which it
     * takes from `pairs` on: the place of every node is known before any is built, and threads need no lock.
     */
    void build(std::uint32_t node, std::size_t first, std::size_t count, std::uint32_t pairs, std::uint32_t depth,
               std::uint32_t n_threads) {
        const auto items = m_items.subspan(first, count);
        Bounds bounds, centroids;
        for (const HierarchyItem& item : items) {
            const Corner lower = lower_of(item), upper = upper_of(item);
            bounds.include(lower, upper);
            centroids.include(lower + upper, lower + upper);
        }
        HierarchyNode& out = m_nodes[node];
        std::memcpy(out.lower.data(), &bounds.lower, sizeof out.lower);
        std::memcpy(out.upper.data(), &bounds.upper, sizeof out.upper);
        if (count == 1) {
            out.child = items[0].index;
            out.n_items = 1;
            return;
        }
        const std::size_t n_left = partition(items, centroids, depth);
        const std::uint32_t child = pairs;
        out.child = child;
        out.n_items = 0;
        const std::uint32_t left_pairs = child + 2;
        const std::uint32_t right_pairs = left_pairs + 2 * (static_cast<std::uint32_t>(n_left) - 1);
        const auto left = [&] { build(child, first, n_left, left_pairs, depth + 1, (n_threads + 1) / 2); };
        const auto right = [&] { build(child + 1, first + n_left, count - n_left, right_pairs, depth + 1, n_threads / 2); };
        if (n_threads > 1 && count >= parallel_items) {
            auto other = std::async(std::launch::async, right);
            left();
            other.get();
        } else {
            left();
            right();
        }
    }

private:
    /** Reorders so that the left child's items come first; returns how many, at least 1 and fewer than all. */
    static std::size_t partition(std::span<HierarchyItem> items, const Bounds& centroids, std::uint32_t depth) {
        // Halving needs ceil(log2 n) more levels: where the heuristic has used up the rest, halve.
        const auto levels = static_cast<std::uint32_t>(std::bit_width(items.size() - 1));
        Split split;
        if (depth + levels < Hierarchy::max_depth) {
            if (items.size() == 2) {
                return order(items, centroids);
            }
            split = find_split(items, centroids);
        }
        if (split.first_right_bin == 0) {
            return halve(items, centroids);
        }
        const auto middle = std::partition(items.begin(), items.end(), [&](const HierarchyItem& item) {
            return split.binning.bin(item) < split.first_right_bin;
        });
        return static_cast<std::size_t>(middle - items.begin());
    }

    /** Of two items, what find_split and halve come to: half of all nodes have two. */
    static std::size_t order(std::span<HierarchyItem> items, const Bounds& centroids) {
        const Corner size = centroids.upper - centroids.lower;
        std::size_t axis = 0;
        while (axis < 3 && !(size[axis] > 0)) {
            ++axis;
        }
        if (axis < 3 && centroid(items[1], axis) < centroid(items[0], axis)) {
            std::swap(items[0], items[1]);
        }
        return 1;
    }

    static Split find_split(std::span<const HierarchyItem> items, const Bounds& centroids) {
        std::array<std::array<Bin, n_bins>, 3> bins{};
        std::array<Binning, 3> binnings{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float extent = centroids.upper[axis] - centroids.lower[axis];
            const float scale = extent > 0 ? static_cast<float>(n_bins) / extent : 0;
            // An extent so small that its inverse overflows is as good as none.
            binnings[axis] = Binning{axis, centroids.lower[axis], scale < std::numeric_limits<float>::max() ? scale : 0};
        }
        for (const HierarchyItem& item : items) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (binnings[axis].scale == 0) {
                    continue;
                }
                Bin& bin = bins[axis][binnings[axis].bin(item)];
                bin.bounds.include(lower_of(item), upper_of(item));
                ++bin.n_items;
            }
        }
        Split best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (binnings[axis].scale > 0) {
                find_split_on_axis(binnings[axis], bins[axis], best);
            }
        }
        return best;
    }

    /** Half of the items each, along the axis where their centres are spread most. */
    static std::size_t halve(std::span<HierarchyItem> items, const Bounds& centroids) {
        std::size_t axis = 0;
        for (std::size_t other = 1; other < 3; ++other) {
            if (centroids.upper[other] - centroids.lower[other] > centroids.upper[axis] - centroids.lower[axis]) {
                axis = other;
            }
        }
        const std::size_t half = items.size() / 2;
        std::nth_element(
            items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
            [axis](const HierarchyItem& a, const HierarchyItem& b) { return centroid(a, axis) < centroid(b, axis); });
        return half;
    }

    std::span<HierarchyItem> m_items;
    std::span<HierarchyNode> m_nodes;
};

} // namespace

std::vector<HierarchyNode> build_hierarchy(std::vector<HierarchyItem>& items) {
    if (items.empty()) {
        return {};
    }
    std::vector<HierarchyNode> nodes(2 * items.size() - 1);
    Builder(items, nodes).build(0, 0, items.size(), 1, 0, std::max(4u, 2 * std::thread::hardware_concurrency()));
    return nodes;
}

} // namespace elvis
