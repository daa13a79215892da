// MFEM, mesh/ncmesh.cpp: GridSfcOrdering2D, GridSfcOrdering3D, after J. Cerveny's generalized Hilbert curve. A box is given by
// its first cell and its sides a, b, c; the curve goes from the first cell to the one at the end of a.
#include "grid_curve.hpp"

#include <cstdlib>

namespace elvis_mfem {

namespace {

Cell operator+(const Cell& a, const Cell& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Cell operator-(const Cell& a) { return {-a[0], -a[1], -a[2]}; }
Cell operator-(const Cell& a, const Cell& b) { return a + -b; }

/** Sides lie along the axes. */
int length(const Cell& side) { return std::abs(side[0] + side[1] + side[2]); }

Cell unit(const Cell& side) {
    const auto sign = [](int x) { return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0); };
    return {sign(side[0]), sign(side[1]), sign(side[2])};
}

/** From the first cell of a side to its last. */
Cell reach(const Cell& side) { return side - unit(side); }

Cell half(const Cell& side) { return {side[0] / 2, side[1] / 2, side[2] / 2}; }

/** Half of a side, rather even than odd. */
Cell even_half(const Cell& side) {
    const Cell result = half(side);
    return length(result) % 2 == 1 && length(side) > 2 ? result + unit(side) : result;
}

class Curve {
public:
    void flat(const Cell& first, const Cell& a, const Cell& b) {
        if (length(a) == 1 || length(b) == 1) {
            row(first, length(b) == 1 ? a : b);
            return;
        }
        if (2 * length(a) > 3 * length(b)) {
            const Cell a1 = even_half(a);
            flat(first, a1, b);
            flat(first + a1, a - a1, b);
            return;
        }
        const Cell a1 = half(a), b1 = even_half(b);
        flat(first, b1, a1);
        flat(first + b1, a, b - b1);
        flat(first + reach(a) + reach(b1), -b1, a1 - a);
    }

    void solid(const Cell& first, const Cell& a, const Cell& b, const Cell& c) {
        const int width = length(a), height = length(b), depth = length(c);
        if ((width > 1) + (height > 1) + (depth > 1) <= 1) {
            row(first, width > 1 ? a : height > 1 ? b : c);
            return;
        }
        const Cell a1 = even_half(a), b1 = even_half(b), c1 = even_half(c);
        if (2 * width > 3 * height && 2 * width > 3 * depth) {
            solid(first, a1, b, c);
            solid(first + a1, a - a1, b, c);
        } else if (3 * height > 4 * depth) {
            solid(first, b1, c, a1);
            solid(first + b1, a, b - b1, c);
            solid(first + reach(a) + reach(b1), -b1, c, a1 - a);
        } else if (3 * depth > 4 * height) {
            solid(first, c1, a1, b);
            solid(first + c1, a, b, c - c1);
            solid(first + reach(a) + reach(c1), -c1, a1 - a, b);
        } else {
            solid(first, b1, c1, a1);
            solid(first + b1, c, a1, b - b1);
            solid(first + reach(b1) + reach(c), a, -b1, c1 - c);
            solid(first + reach(a) + b1 + reach(c), -c, a1 - a, b - b1);
            solid(first + reach(a) + reach(b1), -b1, c1, a1 - a);
        }
    }

    std::vector<Cell> cells;

private:
    void row(Cell cell, const Cell& side) {
        for (int n = length(side); n > 0; --n, cell = cell + unit(side)) {
            cells.push_back(cell);
        }
    }
};

} // namespace

std::vector<Cell> curve_through_grid(const std::array<int, 3>& counts) {
    const auto [nx, ny, nz] = counts;
    const Cell x{nx, 0, 0}, y{0, ny, 0}, z{0, 0, nz};
    Curve curve;
    if (nz == 0) {
        nx >= ny ? curve.flat({}, x, y) : curve.flat({}, y, x);
    } else if (nx >= ny && nx >= nz) {
        curve.solid({}, x, y, z);
    } else if (ny >= nx && ny >= nz) {
        curve.solid({}, y, x, z);
    } else {
        curve.solid({}, z, x, y);
    }
    return std::move(curve.cells);
}

} // namespace elvis_mfem
