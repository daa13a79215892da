/**
 * @file mode_table.hpp
 * Values of a space's modes at points that are asked for again and again, in one element after the other.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <Eigen/Core>

#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace elvis::native_plugin {

/** All functions may be called from several threads. */
class ModeTables {
public:
    /** A row a point, a column a mode. */
    using Table = std::shared_ptr<const Eigen::MatrixXd>;

    /** Fewer points are evaluated as fast as a table is found. */
    static constexpr std::size_t least_points = 8;

    /** At points of three numbers each. */
    Table get(const native::Space& space, std::span<const double> xi);

private:
    struct Entry {
        native::Space space;
        std::vector<double> xi;
        Table table;
    };

    template <class IsWanted>
    Table get_from_all(const native::Space& space, std::span<const double> xi, const IsWanted& is_wanted);

    std::mutex m_mutex;
    /** The last used comes first. */
    std::list<Entry> m_entries;
};

} // namespace elvis::native_plugin
