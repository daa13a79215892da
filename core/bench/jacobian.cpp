/*
 * The certified check of Jacobians alone, without reading: a million quadratic hexahedra are made block by block, and only the
 * check is timed.
 */
#include <core/base/vector3.hpp>
#include <core/bench/bench.hpp>

#include <elvis/native/jacobian.hpp>

#include <array>
#include <cmath>
#include <ctime>
#include <random>

namespace elvis {

namespace {

/** Elements made and checked at once; 10 MB of coefficients at order 2, more than caches hold, as it is for a volume from disk.
 */
constexpr std::uint64_t block = 16384;

/** Processor time of this thread, which other programs on the machine do not lengthen. */
double thread_milliseconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/** Nodal values on the 2^3 or 3^3 lattice, first index fastest, to coefficients of the modified basis l, r, l r. */
void to_modes(std::uint32_t order, std::array<double, 27>& values) {
    if (order == 1) {
        return;
    }
    for (const std::size_t stride : {1u, 3u, 9u}) {
        for (std::size_t line = 0; line < 9; ++line) {
            const std::size_t first = line / stride * stride * 3 + line % stride;
            const double low = values[first], middle = values[first + stride], high = values[first + 2 * stride];
            // A_2 is 1/4 in the middle.
            values[first + stride] = high;
            values[first + 2 * stride] = 4 * (middle - 0.5 * (low + high));
        }
    }
}

/** Elements of the waves mesh, each node moved by up to `disturbance` of the distance between nodes. */
class Elements {
public:
    Elements(std::uint64_t n_elements, std::uint32_t order, double disturbance)
        : m_side(static_cast<std::uint64_t>(std::ceil(std::cbrt(static_cast<double>(n_elements))))), m_order(order),
          m_disturbance(disturbance), m_random(1) {}

    void make(std::uint64_t first, std::uint64_t count, std::vector<double>& coefficients) {
        const std::uint32_t n = m_order + 1;
        const std::size_t n_nodes = std::size_t{n} * n * n;
        const double step = 2.0 / static_cast<double>(m_side * m_order);
        std::uniform_real_distribution<double> disturb(-m_disturbance * step, m_disturbance * step);
        coefficients.resize(count * 3 * n_nodes);
        std::array<std::array<double, 27>, 3> x{};
        for (std::uint64_t element = 0; element < count; ++element) {
            const std::uint64_t index = first + element;
            const std::array<std::uint64_t, 3> cell{index % m_side, index / m_side % m_side, index / (m_side * m_side)};
            for (std::size_t node = 0; node < n_nodes; ++node) {
                const std::array<std::uint64_t, 3> at{node % n, node / n % n, node / (n * n)};
                Vector3 q{};
                for (std::size_t i = 0; i < 3; ++i) {
                    q[i] = -1 + step * static_cast<double>(cell[i] * m_order + at[i]);
                }
                for (std::size_t i = 0; i < 3; ++i) {
                    x[i][node] = q[i] + 0.06 * std::sin(M_PI * q[(i + 1) % 3]) * std::cos(M_PI * q[(i + 2) % 3]) +
                                 (m_disturbance > 0 ? disturb(m_random) : 0);
                }
            }
            for (std::size_t i = 0; i < 3; ++i) {
                to_modes(m_order, x[i]);
                std::copy_n(x[i].begin(), n_nodes,
                            coefficients.begin() + static_cast<std::ptrdiff_t>((element * 3 + i) * n_nodes));
            }
        }
    }

private:
    std::uint64_t m_side;
    std::uint32_t m_order;
    double m_disturbance;
    std::mt19937_64 m_random;
};

} // namespace

JacobianResult bench_jacobian(std::uint64_t n_elements, std::uint32_t geometry_order, double disturbance) {
    Elements elements(n_elements, geometry_order, disturbance);
    const native::Space space{
        native::Shape::hexahedron, native::Basis::modified, {geometry_order, geometry_order, geometry_order}};
    native::JacobianChecker checker(space);
    JacobianResult result;
    result.n_elements = n_elements;
    result.geometry_order = geometry_order;
    result.disturbance = disturbance;
    std::vector<double> coefficients;
    std::vector<native::JacobianCheck> checks;
    double milliseconds = 0;
    for (std::uint64_t first = 0; first < n_elements; first += block) {
        const std::uint64_t count = std::min(block, n_elements - first);
        elements.make(first, count, coefficients);
        checks.assign(count, {});
        const double start = thread_milliseconds();
        checker(coefficients, checks);
        milliseconds += thread_milliseconds() - start;
        for (const native::JacobianCheck& check : checks) {
            result.n_negative += check.sign == native::JacobianSign::negative ? 1 : 0;
            result.n_undecided += check.sign == native::JacobianSign::undecided ? 1 : 0;
        }
    }
    result.elements_a_second = 1e3 * static_cast<double>(n_elements) / milliseconds;
    return result;
}

} // namespace elvis
