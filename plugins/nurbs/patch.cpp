#include "patch.hpp"

#include <algorithm>

namespace elvis::nurbs {

namespace {

/** Indices k of the non-empty spans [u_k, u_(k+1)]. */
std::vector<std::size_t> spans_of(const std::vector<double>& knots) {
    std::vector<std::size_t> spans;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        if (knots[k] < knots[k + 1]) {
            spans.push_back(k);
        }
    }
    return spans;
}

/**
 * Row i: weights of the control points k-p .. k in Bezier coefficient i of span k. Coefficient i is the blossom of the spline
 * at p - i copies of the span's begin and i of its end (Ramshaw 1989), which de Boor's recursion gives with another argument in
 * every step.
 */
std::vector<double> extraction_rows(const std::vector<double>& knots, std::size_t k, std::size_t p) {
    const double begin = knots[k];
    const double end = knots[k + 1];
    std::vector<double> rows((p + 1) * (p + 1));
    for (std::size_t i = 0; i <= p; ++i) {
        for (std::size_t unit = 0; unit <= p; ++unit) {
            std::vector<double> d(p + 1, 0.0);
            d[unit] = 1;
            for (std::size_t r = 1; r <= p; ++r) {
                const double t = r <= p - i ? begin : end;
                for (std::size_t j = p; j >= r; --j) {
                    const double low = knots[j + k - p];
                    const double high = knots[j + 1 + k - r];
                    const double alpha = (t - low) / (high - low);
                    d[j] = (1 - alpha) * d[j - 1] + alpha * d[j];
                }
            }
            rows[i * (p + 1) + unit] = d[p];
        }
    }
    return rows;
}

/** Values and derivatives by xi of the Bernstein polynomials of degree p. */
void bernstein(int p, double xi, double* values, double* derivatives) {
    const double t = (1 + xi) / 2;
    values[0] = 1;
    for (int n = 1; n <= p; ++n) {
        if (n == p) {
            for (int i = 0; i <= p; ++i) {
                derivatives[i] = 0.5 * p * ((i > 0 ? values[i - 1] : 0) - (i < p ? values[i] : 0));
            }
        }
        values[n] = 0;
        for (int i = n; i >= 0; --i) {
            values[i] = (1 - t) * values[i] + (i > 0 ? t * values[i - 1] : 0);
        }
    }
}

} // namespace

std::vector<Element> extract_elements(const PatchData& patch, std::uint32_t number, std::size_t width) {
    std::array<std::vector<std::size_t>, 3> spans;
    std::array<std::size_t, 3> p{};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        spans[direction] = spans_of(patch.knots[direction]);
        p[direction] = static_cast<std::size_t>(patch.degree[direction]);
    }
    std::vector<Element> elements;
    for (std::uint32_t c = 0; c < spans[2].size(); ++c) {
        for (std::uint32_t b = 0; b < spans[1].size(); ++b) {
            for (std::uint32_t a = 0; a < spans[0].size(); ++a) {
                const std::array<std::size_t, 3> k{spans[0][a], spans[1][b], spans[2][c]};
                // Control points of the span, homogeneous; then one direction after the other.
                std::vector<double> points;
                for (std::size_t z = k[2] - p[2]; z <= k[2]; ++z) {
                    for (std::size_t y = k[1] - p[1]; y <= k[1]; ++y) {
                        for (std::size_t x = k[0] - p[0]; x <= k[0]; ++x) {
                            const double* point = &patch.points[((z * patch.n_points(1) + y) * patch.n_points(0) + x) * width];
                            for (std::size_t n = 0; n < width; ++n) {
                                points.push_back(n == 3 ? point[3] : point[3] * point[n]);
                            }
                        }
                    }
                }
                std::size_t stride = width;
                for (std::size_t direction = 0; direction < 3; ++direction) {
                    const std::size_t n = p[direction] + 1;
                    const std::vector<double> rows = extraction_rows(patch.knots[direction], k[direction], p[direction]);
                    std::vector<double> extracted(points.size(), 0.0);
                    for (std::size_t at = 0; at < points.size(); ++at) {
                        const std::size_t i = at / stride % n;
                        for (std::size_t j = 0; j < n; ++j) {
                            extracted[at] += rows[i * n + j] * points[at - i * stride + j * stride];
                        }
                    }
                    points = std::move(extracted);
                    stride *= n;
                }
                elements.push_back({number, {a, b, c}, std::move(points)});
            }
        }
    }
    return elements;
}

void evaluate_bezier(const Element& element, const std::array<int, 3>& degree, std::size_t width, std::size_t first,
                     std::size_t count, const double* xi, double* out) {
    std::array<std::array<double, 16>, 3> values{};
    std::array<std::array<double, 16>, 3> derivatives{};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        bernstein(degree[direction], xi[direction], values[direction].data(), derivatives[direction].data());
    }
    std::fill_n(out, 4 * count, 0.0);
    const double* point = element.coefficients.data() + first;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree[2]); ++k) {
        for (std::size_t j = 0; j <= static_cast<std::size_t>(degree[1]); ++j) {
            for (std::size_t i = 0; i <= static_cast<std::size_t>(degree[0]); ++i, point += width) {
                const double weights[4] = {
                    values[0][i] * values[1][j] * values[2][k], derivatives[0][i] * values[1][j] * values[2][k],
                    values[0][i] * derivatives[1][j] * values[2][k], values[0][i] * values[1][j] * derivatives[2][k]};
                for (std::size_t n = 0; n < count; ++n) {
                    for (std::size_t d = 0; d < 4; ++d) {
                        out[4 * n + d] += weights[d] * point[n];
                    }
                }
            }
        }
    }
}

} // namespace elvis::nurbs
