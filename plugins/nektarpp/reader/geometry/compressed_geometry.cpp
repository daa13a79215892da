#include "compressed_geometry.hpp"

#include "../text/packed_data.hpp"

#include <cmath>
#include <limits>

namespace nektarpp {

namespace {

/** Numbers of the library's list of point types, Nektar++ 5.3. */
PointSet point_set(const XmlFile& file, const pugi::xml_node& node, std::int64_t number) {
    switch (number) {
    case 4:
        return PointSet::gauss_lobatto;
    case 17:
        return PointSet::evenly_spaced;
    case 22:
        return PointSet::triangle_electrostatic;
    case 23:
        return PointSet::triangle_fekete;
    case 24:
        return PointSet::triangle_evenly_spaced;
    default:
        file.fail(node, "points of type number " + std::to_string(number) +
                            "; known are 4 (GaussLobattoLegendre), 17 (PolyEvenlySpaced), 22, 23 and 24 (NodalTriElec, "
                            "-Fekete, -EvenlySpaced)");
    }
}

/** Positions that curves pick theirs from. */
struct PointPool {
    std::vector<std::uint64_t> index;
    std::vector<Position> points;
};

PointPool read_pool(const XmlFile& file, const pugi::xml_node& node) {
    PointPool pool;
    if (const pugi::xml_node index = node.child("INDEX")) {
        pool.index = unpack(file, index, std::numeric_limits<std::uint32_t>::max());
    }
    if (const pugi::xml_node points = node.child("POINTS")) {
        for_each_record(file, points, 4,
                        [&](Record record) { pool.points.push_back(position_of(file, points, record.subspan(1))); });
    }
    return pool;
}

} // namespace

void for_each_record(const XmlFile& file, const pugi::xml_node& node, std::size_t n_words,
                     const std::function<void(Record)>& take) {
    const std::vector<std::uint64_t> words = unpack(file, node, std::numeric_limits<std::uint32_t>::max());
    if (words.size() % n_words != 0) {
        file.fail(node, "the content's " + std::to_string(words.size()) + " numbers are no whole number of records of " +
                            std::to_string(n_words));
    }
    for (std::size_t at = 0; at < words.size(); at += n_words) {
        take({words.data() + at, n_words});
    }
}

Position position_of(const XmlFile& file, const pugi::xml_node& node, Record words) {
    Position x{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        x[axis] = std::bit_cast<double>(words[axis]);
        if (!std::isfinite(x[axis])) {
            file.fail(node, "a position that is not finite");
        }
    }
    return x;
}

void read_compressed_curves(const XmlFile& file, const pugi::xml_node& curved,
                            const std::function<void(const pugi::xml_node&, CurveRecord&)>& take) {
    std::unordered_map<std::int64_t, PointPool> pools;
    for (const pugi::xml_node& node : curved.children("DATAPOINTS")) {
        pools.emplace(file.integer(node, "ID"), read_pool(file, node));
    }
    for (const pugi::xml_node& node : curved.children()) {
        const std::string_view tag = node.name();
        if (tag != "E" && tag != "F") {
            continue;
        }
        for_each_record(file, node, 6, [&](Record record) {
            // id, entity, number of points, points' id, first index, point type
            CurveRecord curve;
            curve.entity = integer_of(record[1]);
            curve.n_points = integer_of(record[2]);
            const auto pool = pools.find(integer_of(record[3]));
            const std::string which = " (curve " + std::to_string(integer_of(record[0])) + ")";
            if (pool == pools.end()) {
                file.fail(node, "there are no DATAPOINTS with ID " + std::to_string(integer_of(record[3])) + which);
            }
            curve.set = point_set(file, node, integer_of(record[5]));
            const std::vector<std::uint64_t>& index = pool->second.index;
            const std::uint64_t first = record[4];
            if (curve.n_points < 0 || first > index.size() ||
                static_cast<std::uint64_t>(curve.n_points) > index.size() - first) {
                file.fail(node, "indices beyond the end of INDEX" + which);
            }
            for (std::int64_t point = 0; point < curve.n_points; ++point) {
                const std::uint64_t at = index[first + static_cast<std::uint64_t>(point)];
                if (at >= pool->second.points.size()) {
                    file.fail(node, "point " + std::to_string(at) + " does not exist" + which);
                }
                curve.points.push_back(pool->second.points[at]);
            }
            take(node, curve);
        });
    }
}

} // namespace nektarpp
