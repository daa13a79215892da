#include "data_set.hpp"

#include "file_name.hpp"
#include "part_snapshot.hpp"
#include "step_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace elvis_nek5000 {

namespace {

/** Paths of time steps, by their first parts, each once. */
std::vector<std::string> expand(const std::vector<std::string>& paths, OpenFiles& files, const elvis::api::Host& host) {
    std::vector<std::string> steps;
    std::set<std::string> known;
    const auto add = [&](const std::string& path) {
        host.check_cancelled();
        const std::string first = is_part(*files.open(path)) ? PartSnapshot::first_part(path, files) : path;
        if (known.insert(first).second) {
            steps.push_back(first);
        }
    };
    for (const std::string& path : paths) {
        const auto file = files.open(path);
        if (probe_snapshot(*file) == 0 && is_step_list(*file)) {
            std::ranges::for_each(read_step_list(*file, host), add);
        } else {
            add(path);
        }
    }
    return steps;
}

/** Fields without the coordinates. */
std::vector<Block> fields_of(const Content& content) {
    std::vector<Block> fields = content.blocks;
    std::erase(fields, Block{Quantity::coordinates, 0});
    return fields;
}

/** The shortest edge between corners that are not the same point. */
double shortest_edge(const Content& content, const std::vector<double>& coordinates) {
    const std::size_t n_points = content.n_points();
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t corner = 0; corner < std::size_t{1} << content.dimension(); ++corner) {
        for (std::size_t direction = 0; direction < content.dimension(); ++direction) {
            const std::size_t a = content.corner_node(corner), b = content.corner_node(corner ^ (std::size_t{1} << direction));
            double square = 0;
            for (std::size_t axis = 0; axis < content.dimension(); ++axis) {
                const double step = coordinates[axis * n_points + a] - coordinates[axis * n_points + b];
                square += step * step;
            }
            shortest = square > 0 ? std::min(shortest, std::sqrt(square)) : shortest;
        }
    }
    return shortest;
}

std::array<std::uint32_t, 3> order_of(const NodeSet& nodes) { return {nodes.n[0] - 1, nodes.n[1] - 1, nodes.n[2] - 1}; }

} // namespace

DataSet::DataSet(const std::vector<std::string>& paths, const elvis::api::Host& host) : m_host(host) {
    for (const std::string& path : expand(paths, m_files, host)) {
        host.check_cancelled();
        m_steps.push_back(open_snapshot(path, m_files));
    }
    find_geometry();
    drop_steps_without_fields();
    check_steps();
    find_fields();
    check_coordinates();
    m_boundary =
        find_boundary(mesh_paths(m_steps.front()->path(), m_steps.front()->n_parts()), n_elements(), dimension(), host);
    make_tables();
}

void DataSet::find_geometry() {
    const std::shared_ptr<const Snapshot>& first = m_steps.front();
    if (first->content().coordinates()) {
        m_geometry = first;
        return;
    }
    for (const std::string& path : earlier_steps(first->path())) {
        std::shared_ptr<const Snapshot> step = open_snapshot(path, m_files);
        if (step->content().coordinates()) {
            m_geometry = std::move(step);
            return;
        }
    }
    throw elvis::api::Error(
        ELVIS_ERROR_FILE, first->path(),
        "has no coordinates, and no earlier file of its set in that folder has them; name one that has them "
        "before it");
}

/** A first file of coordinates alone is the mesh of the others. */
void DataSet::drop_steps_without_fields() {
    const bool has_fields = std::ranges::any_of(m_steps, [](const auto& step) { return !fields_of(step->content()).empty(); });
    if (has_fields && fields_of(m_steps.front()->content()).empty()) {
        m_steps.erase(m_steps.begin());
    }
}

void DataSet::check_steps() const {
    for (const auto& step : m_steps) {
        const Content& content = step->content();
        if (content.n_elements != n_elements() || content.dimension() != dimension()) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, step->path(),
                                    "has " + std::to_string(content.n_elements) + " elements of dimension " +
                                        std::to_string(content.dimension()) + ", but " + geometry().path() + " has " +
                                        std::to_string(n_elements()) + " of dimension " + std::to_string(dimension()));
        }
    }
}

void DataSet::find_fields() {
    m_fields = fields_of(m_steps.front()->content());
    std::erase_if(m_fields, [&](const Block& field) {
        return std::ranges::any_of(m_steps, [&](const auto& step) { return !step->content().find(field); });
    });
    std::set<std::string> left_out;
    for (const auto& step : m_steps) {
        for (const Block& field : fields_of(step->content())) {
            if (std::ranges::find(m_fields, field) == m_fields.end()) {
                left_out.insert(name(field));
            }
        }
    }
    for (const std::string& field : left_out) {
        m_host.log(ELVIS_LOG_WARNING, "field '" + field + "' is left out: not all time steps have it");
    }
    for (const Block& field : m_fields) {
        m_n_values += n_components(field);
    }
}

void DataSet::check_coordinates() {
    const Content& content = geometry().content();
    const std::size_t block = *content.coordinates();
    std::vector<double> coordinates(dimension() * content.n_points());
    double shortest = std::numeric_limits<double>::infinity();
    constexpr std::uint64_t report_size = 4096;
    for (std::uint64_t element = 0; element < n_elements(); ++element) {
        if (element % report_size == 0) {
            m_host.check_cancelled();
            m_host.report_progress(static_cast<double>(element) / static_cast<double>(n_elements()), "checking coordinates");
        }
        geometry().read(block, element, coordinates);
        for (const double coordinate : coordinates) {
            if (!std::isfinite(coordinate)) {
                throw elvis::api::Error(ELVIS_ERROR_FORMAT, geometry().path(),
                                        "element " + std::to_string(element + 1) + " has a coordinate that is not finite");
            }
            m_largest_coordinate = std::max(m_largest_coordinate, std::abs(coordinate));
        }
        shortest = std::min(shortest, shortest_edge(content, coordinates));
    }
    if (geometry().precision().mantissa_bits < double_precision.mantissa_bits) {
        // Copies of a corner may be rounded to neighbouring numbers, but corners of an element stay apart.
        m_corner_tolerance = std::min(2 * geometry().precision().spacing * m_largest_coordinate, 0.1 * shortest);
    }
}

void DataSet::make_tables() {
    const auto add = [&](const Snapshot& step, const Block& block) {
        const NodeSet set = step.nodes(*step.content().find(block));
        m_tables.try_emplace(set, set);
    };
    add(geometry(), {Quantity::coordinates, 0});
    for (const auto& step : m_steps) {
        for (const Block& field : m_fields) {
            add(*step, field);
        }
    }
}

std::uint32_t DataSet::n_components(const Block& field) const {
    return static_cast<std::uint32_t>(geometry().content().n_components(field));
}

std::array<std::uint32_t, 3> DataSet::geometry_order() const {
    return order_of(geometry().nodes(*geometry().content().coordinates()));
}

std::array<std::uint32_t, 3> DataSet::order(const Block& field) const {
    std::array<std::uint32_t, 3> order{};
    for (const auto& step : m_steps) {
        const auto own = order_of(step->nodes(*step->content().find(field)));
        std::ranges::transform(order, own, order.begin(), [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
    }
    return order;
}

std::uint32_t DataSet::mantissa_bits() const {
    std::uint32_t bits = geometry().precision().mantissa_bits;
    for (const auto& step : m_steps) {
        bits = std::min(bits, step->precision().mantissa_bits);
    }
    return bits;
}

} // namespace elvis_nek5000
