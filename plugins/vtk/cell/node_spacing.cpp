#include "node_spacing.hpp"

#include "cell_edges.hpp"
#include "line_positions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace elvis_vtk {

namespace {

/** Edges that are looked at: enough for a vote, few enough to take no time. */
constexpr std::size_t most_edges = 20000;
/** An edge tells if it fits one spacing better than another by this factor of squares: on straight ones it is above 1e10. */
constexpr double clear_spacing_ratio = 4;
/** Votes for one spacing against those for the other, since edges may be graded as if their nodes were others. */
constexpr double majority = 3;

/** How far nodes on an edge are from a quadratic curve. */
class QuadraticFit {
public:
    QuadraticFit(Spacing spacing, int degree) {
        const std::span<const double> at = line_positions(spacing, degree);
        for (std::size_t power = 0; power < 3; ++power) {
            std::vector<double>& function = m_functions[power];
            for (const double x : at) {
                function.push_back(std::pow(2 * x - 1, static_cast<double>(power)));
            }
            // Orthonormal on the nodes, by Gram and Schmidt.
            for (std::size_t before = 0; before < power; ++before) {
                remove(m_functions[before], function);
            }
            const double norm = std::sqrt(dot(function, function));
            std::ranges::for_each(function, [&](double& value) { value /= norm; });
        }
    }

    /** Sum of squares of what a quadratic leaves of the numbers at the nodes. */
    double residual(std::vector<double> values) const {
        for (const std::vector<double>& function : m_functions) {
            remove(function, values);
        }
        return dot(values, values);
    }

private:
    static double dot(const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            sum += a[i] * b[i];
        }
        return sum;
    }
    static void remove(const std::vector<double>& function, std::vector<double>& values) {
        const double part = dot(function, values);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] -= part * function[i];
        }
    }

    std::array<std::vector<double>, 3> m_functions;
};

/** Of one number of nodes. */
struct Fits {
    explicit Fits(int degree)
        : equidistant(Spacing::equidistant, degree), lobatto(Spacing::lobatto, degree), chebyshev(Spacing::chebyshev, degree) {}
    QuadraticFit equidistant, lobatto, chebyshev;
};

/** What edges say. */
struct Votes {
    std::size_t equidistant = 0;
    std::size_t other = 0;
    std::size_t none = 0;
    /** Residuals of the edges whose nodes are others, by squares of their lengths. */
    double lobatto = 0;
    double chebyshev = 0;

    std::size_t n_edges() const { return equidistant + other + none; }
    /** Nothing where edges disagree. */
    std::optional<Spacing> winner() const {
        const auto n = static_cast<double>(equidistant), m = static_cast<double>(other);
        if (n > majority * m) {
            return Spacing::equidistant;
        }
        if (m > majority * n) {
            return lobatto <= chebyshev ? Spacing::lobatto : Spacing::chebyshev;
        }
        return std::nullopt;
    }
};

class Poll {
public:
    explicit Poll(const Grid& grid) : m_grid(grid), m_fits(max_degree + 1) {}

    /** Asks edges of more than three nodes of kinds that `is_asked` tells. */
    template <class IsAsked> Votes ask(IsAsked is_asked) {
        std::vector<std::vector<std::vector<std::size_t>>> edges(m_grid.kinds.size());
        std::size_t n_all = 0;
        for (std::size_t kind = 0; kind < edges.size(); ++kind) {
            if (is_asked(m_grid.kinds[kind])) {
                edges[kind] = edge_nodes(m_grid.kinds[kind]);
                std::erase_if(edges[kind], [](const auto& nodes) { return nodes.size() < 4; });
            }
        }
        for (const Cell& cell : m_grid.cells) {
            n_all += edges[cell.kind].size();
        }
        Votes votes;
        const std::size_t stride = 1 + n_all / most_edges;
        for (std::size_t cell = 0; cell < m_grid.cells.size(); cell += stride) {
            for (const std::vector<std::size_t>& nodes : edges[m_grid.cells[cell].kind]) {
                ask_edge(m_grid.cells[cell], nodes, votes);
            }
        }
        return votes;
    }

private:
    void ask_edge(const Cell& cell, const std::vector<std::size_t>& nodes, Votes& votes) {
        std::optional<Fits>& fits = m_fits[nodes.size() - 1];
        if (!fits) {
            fits.emplace(static_cast<int>(nodes.size()) - 1);
        }
        double equidistant = 0, lobatto = 0, chebyshev = 0, length = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<double> x;
            for (const std::size_t node : nodes) {
                x.push_back(m_grid.points[3 * static_cast<std::size_t>(m_grid.connectivity[cell.first + node]) + axis]);
            }
            const auto [least, most] = std::ranges::minmax(x);
            length += (most - least) * (most - least);
            equidistant += fits->equidistant.residual(x);
            lobatto += fits->lobatto.residual(x);
            chebyshev += fits->chebyshev.residual(x);
        }
        const double other = std::min(lobatto, chebyshev);
        if (clear_spacing_ratio * equidistant < other) {
            ++votes.equidistant;
        } else if (clear_spacing_ratio * other < equidistant) {
            ++votes.other;
            votes.lobatto += lobatto / length;
            votes.chebyshev += chebyshev / length;
        } else {
            ++votes.none;
        }
    }

    const Grid& m_grid;
    /** By degree. */
    std::vector<std::optional<Fits>> m_fits;
};

bool is_lagrange(const CellKind& kind) { return kind.is_of_any_degree && !kind.is_bezier; }

} // namespace

void adopt_node_spacing(Grid& grid, const std::string& path, const elvis::api::Host& host) {
    Poll poll(grid);
    for (const bool is_tensor : {true, false}) {
        const auto is_asked = [&](const CellKind& kind) {
            return is_lagrange(kind) && (kind.family == Family::tensor) == is_tensor;
        };
        const Votes votes = poll.ask(is_asked);
        const std::optional<Spacing> spacing = votes.winner();
        if (votes.n_edges() == 0 || spacing == Spacing::equidistant) {
            continue;
        }
        const std::string shapes = is_tensor ? "quadrilaterals and hexahedra" : "triangles, tetrahedra and wedges";
        if (!spacing) {
            grid.has_unclear_nodes = true;
            host.log(ELVIS_LOG_WARNING, path + ": edges do not tell whether the nodes of Lagrange " + shapes +
                                            " are equidistant; they are read so, as VTK defines them");
            continue;
        }
        if (!is_tensor || spacing == Spacing::chebyshev) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                    "nodes on the edges of Lagrange " + shapes + " are " +
                                        (spacing == Spacing::lobatto ? "Gauss" : "Chebyshev-Gauss") +
                                        "-Lobatto points, where VTK has equidistant ones; read so, values between nodes "
                                        "would be wrong");
        }
        host.log(ELVIS_LOG_WARNING, path + ": nodes of Lagrange " + shapes +
                                        " are Gauss-Lobatto points, not equidistant as VTK has them; read as such (told by " +
                                        std::to_string(votes.other) + " of " + std::to_string(votes.n_edges()) + " edges)");
        for (CellKind& kind : grid.kinds) {
            kind.is_lobatto = is_asked(kind);
        }
    }
}

} // namespace elvis_vtk
