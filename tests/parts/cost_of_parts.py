#!/usr/bin/env python3
"""What volume rendering in parts costs, for as many parts as no machine here has: runs of light along rays through real partitions.

    cost_of_parts.py [--elements N] [--parts 8,64,512,4096] [--size 1920x1080]

A cube of N^3 elements is partitioned by METIS (gpmetis, Debian's metis). Rays of a picture that the cube fills are followed from
element to element; each way of a ray through one part is one run of light (core/parts), of 72 bytes. Some pixels stand for all.

The model of time: the device takes as long as for a volume in one part, times the share of the part with most of all steps; the first
process receives all runs by its network, and puts them together at the rate that --fold gives, as `elvis render --parts --stats`
measures it. "Shared" is what would be where each process puts together an equal share of the pixels.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

RUN_BYTES = 72


def write_graph(path, n):
    """Elements that share a face, as METIS reads graphs: counted from 1."""
    number = numpy.arange(n**3).reshape(n, n, n) + 1
    n_edges = 3 * n * n * (n - 1)
    with open(path, "w") as file:
        file.write(f"{n**3} {n_edges}\n")
        padded = numpy.zeros((n + 2, n + 2, n + 2), dtype=int)
        padded[1:-1, 1:-1, 1:-1] = number
        sides = [padded[2:, 1:-1, 1:-1], padded[:-2, 1:-1, 1:-1], padded[1:-1, 2:, 1:-1], padded[1:-1, :-2, 1:-1],
                 padded[1:-1, 1:-1, 2:], padded[1:-1, 1:-1, :-2]]
        for row in numpy.stack([side.ravel() for side in sides], axis=1):
            file.write(" ".join(str(other) for other in row if other) + "\n")


def partition(graph, n, n_parts):
    """The part of each element."""
    done = subprocess.run(["gpmetis", "-seed=1", str(graph), str(n_parts)], capture_output=True, text=True)
    result = Path(f"{graph}.part.{n_parts}")
    if done.returncode != 0 or not result.exists():
        sys.exit(f"gpmetis failed: {done.stdout}{done.stderr}")
    return numpy.loadtxt(result, dtype=int).reshape(n, n, n)


def rays(width, height, n_columns, n_rows):
    """Of evenly spread pixels: the eye, and directions of rays. The unit cube fills most of the picture's height."""
    eye = numpy.array([1.9, 1.5, 2.3])
    forward = numpy.array([0.5, 0.5, 0.5]) - eye
    forward /= numpy.linalg.norm(forward)
    right = numpy.cross(forward, [0, 1, 0])
    right /= numpy.linalg.norm(right)
    up = numpy.cross(right, forward)
    tangent = 0.4
    x = ((numpy.arange(n_columns) + 0.5) / n_columns * 2 - 1) * tangent * width / height
    y = (1 - (numpy.arange(n_rows) + 0.5) / n_rows * 2) * tangent
    return eye, forward + x[None, :, None] * right + y[:, None, None] * up


def follow(parts, n_parts, eye, directions):
    """Runs of all rays, steps from element to element, by part; and how many rays meet the cube."""
    n = parts.shape[0]
    runs, steps, n_met = numpy.zeros(n_parts, dtype=int), numpy.zeros(n_parts, dtype=int), 0
    planes = numpy.arange(n + 1) / n
    for row in directions:
        with numpy.errstate(divide="ignore"):
            crossings = (planes[None, None, :] - eye[None, :, None]) / row[:, :, None]
        enter = numpy.maximum(crossings.min(axis=2).max(axis=1), 0)
        leave = crossings.max(axis=2).min(axis=1)
        met = leave > enter
        if not met.any():
            continue
        n_met += int(met.sum())
        t = numpy.sort(numpy.clip(crossings[met].reshape(met.sum(), -1), enter[met, None], leave[met, None]), axis=1)
        middle, length = 0.5 * (t[:, 1:] + t[:, :-1]), t[:, 1:] - t[:, :-1]
        cell = numpy.floor((eye + middle[:, :, None] * row[met][:, None, :]) * n).astype(int).clip(0, n - 1)
        along = parts[cell[:, :, 0], cell[:, :, 1], cell[:, :, 2]]
        is_step = length > 1e-12
        for ray, there in zip(along, is_step):
            of_ray = ray[there]
            if of_ray.size:
                begins = numpy.concatenate([[True], of_ray[1:] != of_ray[:-1]])
                numpy.add.at(runs, of_ray[begins], 1)
                numpy.add.at(steps, of_ray, 1)
    return runs, steps, n_met


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--elements", type=int, default=64)
    parser.add_argument("--parts", default="8,64,512,4096")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--device", type=float, default=38.9, help="milliseconds of the whole volume on one device")
    parser.add_argument("--fold", type=float, default=6, help="million runs a second that one process puts together")
    parser.add_argument("--network", type=float, default=12.5, help="GB a second into one process")
    parser.add_argument("--rows", type=int, default=54, help="rows of pixels that are followed")
    arguments = parser.parse_args()
    width, height = (int(number) for number in arguments.size.split("x"))
    n_columns = round(arguments.rows * width / height)
    scale = width * height / (n_columns * arguments.rows)
    eye, directions = rays(width, height, n_columns, arguments.rows)
    print(f"{arguments.elements}^3 elements, {width} x {height} pixels")
    print("| parts | runs a ray, mean | MB in all | MB a process, mean | most | device, ms | sending, ms | putting together, ms "
          "| in all, ms | shared, ms |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        graph = Path(folder) / "elements.graph"
        write_graph(graph, arguments.elements)
        for n_parts in (int(number) for number in arguments.parts.split(",")):
            parts = partition(graph, arguments.elements, n_parts)
            runs, steps, n_met = follow(parts, n_parts, eye, directions)
            n_runs, most = runs.sum() * scale, runs.max() * scale
            device = arguments.device * steps.max() / steps.sum()
            sending = n_runs * RUN_BYTES / arguments.network / 1e6
            folding = n_runs / arguments.fold / 1e3
            # Each process sends its runs and receives those of its pixels, and the first the pixels.
            shared = device + (max(most, n_runs / n_parts) * RUN_BYTES + width * height * 16) / arguments.network / 1e6 + folding / n_parts
            print(f"| {n_parts} | {runs.sum() / n_met:.1f} | {n_runs * RUN_BYTES / 1e6:.0f} | {n_runs * RUN_BYTES / n_parts / 1e6:.1f} "
                  f"| {most * RUN_BYTES / 1e6:.1f} | {device:.2f} | {sending:.0f} | {folding:.0f} | {device + sending + folding:.0f} "
                  f"| {shared:.1f} |", flush=True)


if __name__ == "__main__":
    main()
