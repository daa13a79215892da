#!/usr/bin/env python3
"""Writes ball.cut and gyroid.cut: what a cut-cell discontinuous Galerkin code could write.

Cells of a Cartesian grid that lie outside of the level set are left out, those inside are whole, the others are cut. Only Python's
own library is needed:
    python3 make_samples.py
"""
import itertools
import math

# Gauss points and weights, exact up to degree 11.
POINTS = [(s * x, w) for x, w in ((0.2386191860831969, 0.46791393457269104), (0.6612093864662645, 0.36076157304813861),
                                  (0.9324695142031521, 0.17132449237917036)) for s in (-1, 1)]
# Lobatto points: interpolants of cells with a side in common agree on it.
LOBATTO = (-1.0, -math.sqrt(0.2), math.sqrt(0.2), 1.0)


def legendre(n, t):
    return (1.0, t, (3 * t * t - 1) / 2, (5 * t * t - 3) * t / 2)[n]


def modes_of(order):
    """Orders of the modes, the first direction fastest."""
    return [(i, j, k) for k in range(order + 1) for j in range(order + 1) for i in range(order + 1)]


def projected(order, function):
    """Coefficients of the projection of a function of xi."""
    sums = [0.0] * len(modes_of(order))
    for (x, wx), (y, wy), (z, wz) in itertools.product(POINTS, repeat=3):
        value = wx * wy * wz * function((x, y, z))
        for mode, (i, j, k) in enumerate(modes_of(order)):
            norm = (2 * i + 1) * (2 * j + 1) * (2 * k + 1) / 8
            sums[mode] += norm * value * legendre(i, x) * legendre(j, y) * legendre(k, z)
    return sums


def solve(matrix, right):
    rows = [list(row) + [r] for row, r in zip(matrix, right)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(n):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    return [rows[i][n] / rows[i][i] for i in range(n)]


INVERSE = [solve([[legendre(n, t) for n in range(4)] for t in LOBATTO], [float(i == k) for i in range(4)]) for k in range(4)]


def interpolated(function):
    """Coefficients of order 3 of the interpolant in the Lobatto points."""
    values = {(a, b, c): function((LOBATTO[a], LOBATTO[b], LOBATTO[c])) for a, b, c in itertools.product(range(4), repeat=3)}
    return [math.fsum(INVERSE[a][i] * INVERSE[b][j] * INVERSE[c][k] * value for (a, b, c), value in values.items())
            for i, j, k in modes_of(3)]


def write(name, lower, upper, cells, level_order, level, fields):
    """`level`: the coefficients of the level set from a function of xi."""
    half = (upper - lower) / cells / 2
    with open(name, "w", encoding="ascii") as file:
        print("cut-cells 1", file=file)
        print("grid", *["%.17g" % lower] * 3, *["%.17g" % upper] * 3, *[cells] * 3, file=file)
        print("level", level_order, file=file)
        for field, (order, _) in fields.items():
            print("field", field, 1, order, file=file)
        inside = []
        for place in itertools.product(range(cells), repeat=3):
            middle = [lower + half * (2 * p + 1) for p in place]

            def at(xi, middle=middle):
                return [m + half * t for m, t in zip(middle, xi)]

            coefficients = [0.0 if abs(c) < 1e-15 else c for c in level(at)]
            room = math.fsum(abs(c) for c in coefficients[1:])
            if coefficients[0] - room > 0:
                continue
            inside.append(at)
            is_whole = coefficients[0] + room < 0
            print("whole" if is_whole else "cut", *place, *([] if is_whole else ["%.17g" % c for c in coefficients]), file=file)
        for cell, at in enumerate(inside):
            for field, (order, function) in fields.items():
                coefficients = projected(order, lambda xi, at=at, f=function: f(at(xi)))
                print("modes", field, cell, *("0" if abs(c) < 1e-12 else "%.10g" % c for c in coefficients), file=file)


def gyroid(x):
    s, c = [math.sin(t) for t in x], [math.cos(t) for t in x]
    return s[0] * c[1] + s[1] * c[2] + s[2] * c[0] - 0.2


RADIUS = 0.8
write("ball.cut", -1.0, 1.0, 6, 2, lambda at: projected(2, lambda xi: sum(t * t for t in at(xi)) - RADIUS * RADIUS),
      {"q": (2, lambda x: sum(t * t for t in x)),
       "u": (3, lambda x: math.sin(3 * x[0]) * math.cos(2 * x[1]) + x[2] * x[2])})
write("gyroid.cut", -math.pi, math.pi, 5, 3, lambda at: interpolated(lambda xi: gyroid(at(xi))),
      {"p": (2, lambda x: math.cos(x[0]) * math.cos(x[1]) + 0.3 * math.sin(x[2]))})
