/*
 * A toy solver with spectral elements, drawn while it runs: heat in a cube whose faces are cold, by continuous elements of
 * order 4 on Gauss-Lobatto-Legendre points and two-stage Runge-Kutta. Ranks have layers of elements along z.
 *
 *     mpirun -n 4 heat plan.json [FOLDER]
 *
 * What is drawn, and when, says the plan. Of the solver's own code only `Insitu` knows of ElVis.
 */
#include <elvis/insitu_mpi.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

constexpr int order = 4, n_points = order + 1, n_nodes = n_points * n_points * n_points;
constexpr int n_elements = 4; // Along each edge of the cube.
constexpr double pi = 3.14159265358979323846;

/** GLL points and weights of order 4 on [-1, 1], and derivatives of the Lagrange polynomials. */
struct Basis {
    std::array<double, n_points> x{-1, -std::sqrt(3.0 / 7), 0, std::sqrt(3.0 / 7), 1};
    std::array<double, n_points> weight{0.1, 49.0 / 90, 32.0 / 45, 49.0 / 90, 0.1};
    /** Of polynomial j at point i. */
    std::array<std::array<double, n_points>, n_points> slope{};

    Basis() {
        for (int i = 0; i < n_points; ++i) {
            for (int j = 0; j < n_points; ++j) {
                double sum = 0;
                for (int m = 0; m < n_points; ++m) {
                    double product = m == j ? 0 : 1 / (x[j] - x[m]);
                    for (int k = 0; k < n_points && m != j; ++k) {
                        product *= k == j || k == m ? 1 : (x[i] - x[k]) / (x[j] - x[k]);
                    }
                    sum += product;
                }
                slope[i][j] = sum;
            }
        }
    }
};

/** A rank's layers of elements, as a grid of nodes that neighbours share. */
class Solver {
public:
    Solver(int rank, int size)
        : m_rank(rank), m_size(size), first(n_elements * rank / size), n_layers(n_elements * (rank + 1) / size - first),
          m_depth(n_layers * order + 1), m_values(m_width * m_width * m_depth), m_mass(m_values.size()) {
        for (int element = 0; element < count(); ++element) {
            for (int node = 0; node < n_nodes; ++node) {
                const auto x = position(element, node);
                m_values[place(element, node)] = std::sin(pi * x[0]) * std::sin(pi * x[1]) * std::sin(pi * x[2]);
                m_mass[place(element, node)] += volume_of(node);
            }
        }
        add_neighbours(m_mass);
    }

    int count() const { return n_elements * n_elements * n_layers; }

    /** Nodes count along x first, elements likewise. */
    std::array<double, 3> position(int element, int node) const {
        const int at[3]{node % n_points, node / n_points % n_points, node / (n_points * n_points)};
        const int of[3]{element % n_elements, element / n_elements % n_elements, first + element / (n_elements * n_elements)};
        std::array<double, 3> x{};
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] = (of[axis] + 0.5 * (basis.x[at[axis]] + 1)) / n_elements;
        }
        return x;
    }

    double value(int element, int node) const { return m_values[place(element, node)]; }

    void advance(double dt) {
        const std::vector<double> slope = slope_of(m_values);
        std::vector<double> middle = m_values;
        for (std::size_t at = 0; at < middle.size(); ++at) {
            middle[at] += 0.5 * dt * slope[at];
        }
        const std::vector<double> middle_slope = slope_of(middle);
        for (std::size_t at = 0; at < middle.size(); ++at) {
            m_values[at] += dt * middle_slope[at];
        }
    }

    Basis basis;

private:
    static constexpr int m_width = n_elements * order + 1;
    static constexpr double half = 0.5 / n_elements; // dx/dxi

    std::size_t place(int element, int node) const {
        const int i = element % n_elements * order + node % n_points;
        const int j = element / n_elements % n_elements * order + node / n_points % n_points;
        const int k = element / (n_elements * n_elements) * order + node / (n_points * n_points);
        return static_cast<std::size_t>(i + m_width * (j + m_width * k));
    }

    double volume_of(int node) const {
        return half * half * half * basis.weight[node % n_points] * basis.weight[node / n_points % n_points] *
               basis.weight[node / (n_points * n_points)];
    }

    /** du/dt: minus stiffness over mass. */
    std::vector<double> slope_of(const std::vector<double>& u) const {
        std::vector<double> result(u.size());
        for (int element = 0; element < count(); ++element) {
            for (int step : {1, n_points, n_points * n_points}) {
                add_stiffness(u, element, step, result);
            }
        }
        std::vector<double> own = std::move(result);
        add_neighbours(own);
        for (std::size_t at = 0; at < own.size(); ++at) {
            own[at] = is_cold(at) ? 0 : -own[at] / m_mass[at];
        }
        return own;
    }

    /** Along one direction, in which nodes are `step` apart. */
    void add_stiffness(const std::vector<double>& u, int element, int step, std::vector<double>& result) const {
        for (int node = 0; node < n_nodes; ++node) {
            const int i = node / step % n_points, line = node - i * step;
            double slope = 0;
            for (int j = 0; j < n_points; ++j) {
                slope += basis.slope[i][j] * u[place(element, line + j * step)];
            }
            slope *= volume_of(node) / (half * half);
            for (int j = 0; j < n_points; ++j) {
                result[place(element, line + j * step)] += basis.slope[i][j] * slope;
            }
        }
    }

    /** Layers of nodes that two ranks share have the sum of both. */
    void add_neighbours(std::vector<double>& values) const {
        const int layer = m_width * m_width;
        for (const int side : {-1, 1}) {
            const int other = m_rank + side;
            if (other < 0 || other >= m_size) {
                continue;
            }
            double* const shared = side < 0 ? values.data() : values.data() + values.size() - layer;
            std::vector<double> theirs(layer);
            MPI_Sendrecv(shared, layer, MPI_DOUBLE, other, 1, theirs.data(), layer, MPI_DOUBLE, other, 1, MPI_COMM_WORLD,
                         MPI_STATUS_IGNORE);
            for (int at = 0; at < layer; ++at) {
                shared[at] += theirs[at];
            }
        }
    }

    bool is_cold(std::size_t at) const {
        const int i = static_cast<int>(at) % m_width, j = static_cast<int>(at) / m_width % m_width;
        const int k = first * order + static_cast<int>(at) / (m_width * m_width);
        const auto is_end = [](int index) { return index == 0 || index == n_elements * order; };
        return is_end(i) || is_end(j) || is_end(k);
    }

    int m_rank, m_size;

public:
    int first, n_layers;

private:
    int m_depth;
    std::vector<double> m_values, m_mass;
};

/** What ElVis gets: positions once, values before each step, at the nodes of each element. */
class Insitu {
public:
    Insitu(const Solver& solver, const std::string& plan, const char* folder) : m_solver(solver) {
        std::vector<double> nodes, positions;
        for (int node = 0; node < n_nodes; ++node) {
            const auto& x = solver.basis.x;
            nodes.insert(nodes.end(), {x[node % n_points], x[node / n_points % n_points], x[node / (n_points * n_points)]});
        }
        for (int element = 0; element < solver.count(); ++element) {
            for (int axis = 0; axis < 3; ++axis) {
                for (int node = 0; node < n_nodes; ++node) {
                    positions.push_back(solver.position(element, node)[axis]);
                }
            }
        }
        m_values.resize(static_cast<std::size_t>(solver.count()) * n_nodes);
        const elvis_space space{sizeof space, ELVIS_BASIS_GLL_LAGRANGE, {order, order, order}, 0, nodes.data()};
        const std::uint64_t count = static_cast<std::uint64_t>(solver.count());
        const elvis_array_class hexahedra{sizeof hexahedra, ELVIS_SHAPE_HEXAHEDRON, count, &space, positions.data(), nullptr,
                                          nullptr};
        const double* const values[] = {m_values.data()};
        const elvis_array_field heat{sizeof heat, 1, "u", nullptr, ELVIS_CONTINUITY_CONTINUOUS, 0, &space, values};
        const elvis_arrays arrays{sizeof arrays, 3, 1, 1, 1, 0, &hexahedra, &heat, nullptr, nullptr};
        elvis_mpi_communicator_create(MPI_COMM_WORLD, &m_ranks);
        elvis_context_options options{};
        options.struct_size = sizeof options;
        options.log = [](void* rank, elvis_log_level level, elvis_string line) {
            if (level >= ELVIS_LOG_WARNING || (level == ELVIS_LOG_INFO && *static_cast<std::uint32_t*>(rank) == 0)) {
                std::fprintf(stderr, "%s\n", line);
            }
        };
        options.user = &m_ranks.table.rank;
        if (elvis_context_create(&options, &m_context) != ELVIS_OK) {
            fail(elvis_context_error(nullptr));
        }
        if (elvis_insitu_open(m_context, &m_ranks.table, &arrays, plan.c_str(), folder, &m_insitu) != ELVIS_OK) {
            fail(elvis_context_error(m_context));
        }
    }
    ~Insitu() {
        elvis_insitu_release(m_insitu);
        elvis_context_release(m_context);
        elvis_mpi_communicator_release(&m_ranks);
    }
    Insitu(const Insitu&) = delete;
    Insitu& operator=(const Insitu&) = delete;

    void step(std::uint64_t step, double time) {
        for (int element = 0; element < m_solver.count(); ++element) {
            for (int node = 0; node < n_nodes; ++node) {
                m_values[static_cast<std::size_t>(element * n_nodes + node)] = m_solver.value(element, node);
            }
        }
        if (elvis_insitu_step(m_insitu, step, time) != ELVIS_OK) {
            fail(elvis_insitu_error(m_insitu));
        }
    }

private:
    /** All ranks fail together, with the same text. */
    [[noreturn]] void fail(const char* text) const {
        if (m_ranks.table.rank == 0) {
            std::fprintf(stderr, "heat: %s\n", text);
        }
        MPI_Finalize();
        std::exit(1);
    }

    const Solver& m_solver;
    std::vector<double> m_values;
    elvis_mpi_communicator m_ranks{};
    elvis_context* m_context = nullptr;
    elvis_insitu* m_insitu = nullptr;
};

} // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0, size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (argc < 2 || size > n_elements) {
        std::fprintf(stderr, "usage: mpirun -n N heat PLAN [FOLDER], N at most %d\n", n_elements);
        MPI_Finalize();
        return 2;
    }
    std::ifstream file(argv[1]);
    const std::string plan{std::istreambuf_iterator<char>(file), {}};
    {
        Solver solver(rank, size);
        Insitu insitu(solver, plan, argc > 2 ? argv[2] : nullptr);
        constexpr double dt = 5e-5;
        for (std::uint64_t step = 0; step <= 200; ++step) {
            insitu.step(step, static_cast<double>(step) * dt);
            solver.advance(dt);
        }
    }
    MPI_Finalize();
    return 0;
}
