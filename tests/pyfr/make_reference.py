#!/usr/bin/env python3
"""Writes tests/data/pyfr/mixed.ref: positions and values of mixed_3.1.pyfrm and waves_3.1.pyfrs at points inside of every element.

Nothing of ElVis or PyFR is used, but h5py and numpy: the functions are those of plugins/pyfr/format.md, section 2, in PyFR's own coordinates.
A line: kind, element of the kind, X Y Z, x y z, values of all variables.
"""
import os
import h5py
import numpy as np

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'data', 'pyfr')


def jacobi(n, a, z):
    """P_n^(a,0)"""
    p = [np.ones_like(z), (a + 2) * z / 2 + a / 2]
    for k in range(2, n + 1):
        s = 2 * k + a
        p.append(((s - 1) * (s * (s - 2) * z + a * a) * p[-1] - 2 * (k + a - 1) * (k - 1) * s * p[-2]) / (2 * k * (k + a) * (s - 2)))
    return p[n]


def modes(kind, n, points):
    x, y, z = points.T
    out = []
    r = range(n + 1)
    with np.errstate(all='ignore'):
        if kind == 'hex':
            out = [jacobi(i, 0, x) * jacobi(j, 0, y) * jacobi(k, 0, z) for i in r for j in r for k in r]
        elif kind == 'pri':
            a = np.where(y < 1, 2 * (1 + x) / (1 - y) - 1, -1)
            out = [jacobi(i, 0, a) * (1 - y)**i * jacobi(j, 2 * i + 1, y) * jacobi(k, 0, z) for i in r for j in range(n + 1 - i) for k in r]
        elif kind == 'tet':
            a = np.where(y + z != 0, -2 * (1 + x) / (y + z) - 1, -1)
            b = np.where(z < 1, 2 * (1 + y) / (1 - z) - 1, -1)
            out = [jacobi(i, 0, a) * (1 - b)**i * jacobi(j, 2 * i + 1, b) * (1 - z)**(i + j) * jacobi(k, 2 * (i + j + 1), z)
                   for i in r for j in range(n + 1 - i) for k in range(n + 1 - i - j)]
        else:
            a, b = np.where(z < 1, 2 * x / (1 - z), 0), np.where(z < 1, 2 * y / (1 - z), 0)
            out = [jacobi(i, 0, a) * jacobi(j, 0, b) * (1 - z)**(i + j) * jacobi(k, 2 * (i + j + 1), z)
                   for i in r for j in r for k in range(n + 1 - max(i, j))]
    return np.stack(out, 1)


def at(kind, n, nodes, points):
    """Matrix: values at points from values at nodes."""
    return np.linalg.solve(modes(kind, n, nodes).T, modes(kind, n, points).T).T


def inside(kind, n, rng):
    p = rng.uniform(-1, 1, (100 * n, 3))
    x, y, z = p.T
    keep = {'hex': x < 2, 'pri': x + y < 0, 'tet': x + y + z < -1, 'pyr': (abs(x) < (1 - z) / 2) & (abs(y) < (1 - z) / 2)}[kind]
    return p[keep][:n]


def main():
    rng = np.random.default_rng(3)
    mesh, solution = h5py.File(f'{DATA}/mixed_3.1.pyfrm'), h5py.File(f'{DATA}/waves_3.1.pyfrs')
    with open(f'{DATA}/mixed.ref', 'w') as out:
        for kind in sorted(mesh['eles']):
            elements = mesh['eles'][kind]
            nodes = mesh['nodes']['location'][elements['nodes']]
            values = solution[f'soln/p4-{kind}']
            for element in range(len(nodes)):
                points = inside(kind, 6, rng)
                x = at(kind, 2, elements.attrs['pts'], points) @ nodes[element]
                u = at(kind, 4, values.attrs['pts'], points) @ values[element].T
                for row in zip(points, x, u):
                    out.write(f'{kind} {element} ' + ' '.join('%.17g' % number for part in row for number in part) + '\n')


main()
