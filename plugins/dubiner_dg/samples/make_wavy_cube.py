#!/usr/bin/env python3
"""Writes wavy_cube.ddg: what a modal discontinuous Galerkin code could write of a cube of curved tetrahedra.

Orders differ from element to element, so that fields jump. Only Python's own library is needed:
    python3 make_wavy_cube.py > wavy_cube.ddg
"""
import itertools
import math

CUBES = 2
GEOMETRY_ORDER = 3


def jacobi(n, alpha, x):
    """Jacobi polynomial P_n^(alpha, 0)."""
    before, value = 0.0, 1.0
    for k in range(n):
        if k == 0:
            following = (alpha + 2) / 2 * x + alpha / 2
        else:
            a = (2 * k + 1 + alpha) * (2 * k + 2 + alpha) / (2 * (k + 1) * (k + 1 + alpha))
            b = alpha * alpha * (2 * k + 1 + alpha) / (2 * (k + 1) * (k + 1 + alpha) * (2 * k + alpha))
            c = k * (k + alpha) * (2 * k + 2 + alpha) / ((k + 1) * (k + 1 + alpha) * (2 * k + alpha))
            following = (a * x + b) * value - c * before
        before, value = value, following
    return value


def gauss_legendre(n):
    points = []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(50):
            value, before = jacobi(n, 0, x), jacobi(n - 1, 0, x)
            slope = n * (before - x * value) / (1 - x * x)
            x -= value / slope
        points.append((x, 2 / ((1 - x * x) * slope * slope)))
    return points


def modes(order, a, b, c):
    """Orthonormal Dubiner modes at collapsed coordinates, r fastest."""
    values = []
    for p in range(order + 1):
        for q in range(order + 1 - p):
            for r in range(order + 1 - p - q):
                value = jacobi(p, 0, a) * jacobi(q, 2 * p + 1, b) * jacobi(r, 2 * p + 2 * q + 2, c)
                value *= ((1 - b) / 2) ** p * ((1 - c) / 2) ** (p + q)
                values.append(value * math.sqrt((p + 0.5) * (p + q + 1) * (p + q + r + 1.5)))
    return values


def quadrature(n):
    """Collapsed coordinates, reference point and weight over the tetrahedron."""
    rule = gauss_legendre(n)
    for (a, wa), (b, wb), (c, wc) in itertools.product(rule, rule, rule):
        y = (1 + b) * (1 - c) / 2 - 1
        x = (1 + a) * (-y - c) / 2 - 1
        yield (a, b, c), (x, y, c), wa * wb * wc * (1 - b) / 2 * ((1 - c) / 2) ** 2


def wavy(x):
    s, c = [math.sin(math.pi * t) for t in x], [math.cos(math.pi * t) for t in x]
    return [x[0] + 0.06 * s[1] * c[2], x[1] + 0.06 * s[2] * c[0], x[2] + 0.06 * s[0] * c[1]]


def straight(corners, xi):
    weights = [-(1 + sum(xi)) / 2] + [(1 + t) / 2 for t in xi]
    return [sum(w * corner[d] for w, corner in zip(weights, corners)) for d in range(3)]


def pressure(x):
    return [math.exp(-2 * sum((t - 0.3) ** 2 for t in x)) - 0.5 * math.cos(2 * x[0]) * math.sin(x[1] + x[2])]


def velocity(x):
    s, c = [math.sin(1.5 * t) for t in x], [math.cos(1.5 * t) for t in x]
    return [s[0] * c[1] * c[2], -c[0] * s[1] * c[2], 0.3 * s[2]]


def main():
    side = CUBES + 1
    elements = []
    for cube in itertools.product(range(CUBES), repeat=3):
        # Six tetrahedra about the diagonal, from corner to corner along the axes in every order.
        for axes in itertools.permutations(range(3)):
            corner = list(cube)
            lattice = [tuple(corner)]
            for axis in axes:
                corner[axis] += 1
                lattice.append(tuple(corner))
            if axes in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):
                lattice[2], lattice[3] = lattice[3], lattice[2]
            elements.append(lattice)
    number = {v: v[0] + side * (v[1] + side * v[2]) for v in itertools.product(range(side), repeat=3)}

    print("dubiner-dg 1\nfield p 1 Pa\nfield velocity 3 m/s")
    orders = [2 + i % 3 for i in range(len(elements))]
    all_corners = []
    for order, lattice in zip(orders, elements):
        corners = [[2 * t / CUBES - 1 for t in v] for v in lattice]
        all_corners.append(corners)
        g = GEOMETRY_ORDER
        nodes = [[-1 + 2 * t / g for t in (i, j, k)]
                 for k in range(g + 1) for j in range(g + 1 - k) for i in range(g + 1 - j - k)]
        numbers = [t for node in nodes for t in wavy(straight(corners, node))]
        print("element", order, g, *(number[v] for v in lattice), *("%.9g" % t for t in numbers))
    for lattice in elements:
        for face in itertools.combinations(lattice, 3):
            for axis, (low, high) in enumerate((("west", "east"), ("south", "north"), ("bottom", "top"))):
                for end, name in ((0, low), (CUBES, high)):
                    if all(v[axis] == end for v in face):
                        print("boundary", name, *(number[v] for v in face))
    print("time 0.5")
    n = 9
    for element, (order, corners) in enumerate(zip(orders, all_corners)):
        for name, function in (("p", pressure), ("velocity", velocity)):
            sums = None
            for collapsed, xi, weight in quadrature(n):
                values = function(wavy(straight(corners, xi)))
                of_modes = modes(order, *collapsed)
                if sums is None:
                    sums = [[0.0] * len(of_modes) for _ in values]
                for component, value in enumerate(values):
                    for mode, of_mode in enumerate(of_modes):
                        sums[component][mode] += weight * value * of_mode
            print("modes", name, element, *("%.9g" % t for component in sums for t in component))


main()
