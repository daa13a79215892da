#!/usr/bin/env python3
"""What volume rendering in parts costs, for as many parts as no machine here has: runs of light along rays through real partitions.

    cost_of_parts.py [--elements N] [--parts 8,64,512,4096] [--size 1920x1080]

A cube of N^3 elements is partitioned by METIS (gpmetis, Debian's metis). Rays of a picture that the cube fills are followed from
element to element; each way of a ray through one part is one run of light (core/parts), of 72 bytes. Some pixels stand for all.
Tiles of the picture are dealt to the processes as core/parts/tile_shares.cpp does; each process has one part.

The model of time: the device takes as long as for a volume in one part, times the share of the part with most of all steps. Then runs
go to the processes that own the pixels: the one that sends or receives most counts, and the one with most messages. Each puts together
its runs at the rate that --fold gives, as `elvis render --parts --stats` measures it. Finished pixels go to the first process, 36 bytes
each. "First alone" is what would be if the first process received and put together all runs.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

RUN_BYTES = 72
PIXEL_BYTES = 36


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


def tile_owners(width, height, n_shares):
    """The process of each tile, and the side of tiles: as TileShares."""
    side = 128
    while side > 8 and -(-width // side) * -(-height // side) < 64 * n_shares:
        side //= 2
    n_columns, n_rows = -(-width // side), -(-height // side)
    column, row = numpy.meshgrid(numpy.arange(n_columns), numpy.arange(n_rows))
    code = numpy.zeros_like(column)
    for bit in range(16):
        code |= (column >> bit & 1) << (2 * bit) | (row >> bit & 1) << (2 * bit + 1)
    owners = numpy.empty(code.size, dtype=int)
    owners[numpy.argsort(code.ravel(), kind="stable")] = numpy.arange(code.size) % n_shares
    return owners.reshape(code.shape), side


def follow(parts, n_parts, eye, directions, owners):
    """Runs of all rays, steps from element to element, and runs received, by part; who sends to whom; how many rays meet the cube."""
    n = parts.shape[0]
    runs, steps, received = (numpy.zeros(n_parts, dtype=int) for _ in range(3))
    messages, n_met = set(), 0
    planes = numpy.arange(n + 1) / n
    for row, owner in zip(directions, owners):
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
        ray, segment = numpy.nonzero(length > 1e-12)
        along = parts[tuple(cell[ray, segment].T)]
        begins = numpy.concatenate([[True], (along[1:] != along[:-1]) | (ray[1:] != ray[:-1])])
        to = owner[met][ray[begins]]
        runs += numpy.bincount(along[begins], minlength=n_parts)
        received += numpy.bincount(to, minlength=n_parts)
        steps += numpy.bincount(along, minlength=n_parts)
        messages.update(numpy.unique(along[begins] * n_parts + to).tolist())
    return runs, steps, received, numpy.bincount(numpy.array(sorted(messages)) // n_parts, minlength=n_parts), n_met


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--elements", type=int, default=64)
    parser.add_argument("--parts", default="8,64,512,4096")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--device", type=float, default=38.9, help="milliseconds of the whole volume on one device")
    parser.add_argument("--fold", type=float, default=6, help="million runs a second that one process puts together")
    parser.add_argument("--network", type=float, default=12.5, help="GB a second into one process")
    parser.add_argument("--message", type=float, default=2, help="microseconds a message takes besides its bytes")
    parser.add_argument("--rows", type=int, default=270, help="rows of pixels that are followed")
    arguments = parser.parse_args()
    width, height = (int(number) for number in arguments.size.split("x"))
    n_columns = round(arguments.rows * width / height)
    scale = width * height / (n_columns * arguments.rows)
    eye, directions = rays(width, height, n_columns, arguments.rows)
    print(f"{arguments.elements}^3 elements, {width} x {height} pixels")
    print("| parts | runs a ray, mean | MB in all | MB sent by a process, mean | most | MB received, most | messages, most | device, ms "
          "| exchange, ms | putting together, ms | pixels to the first, ms | in all, ms | first alone, ms |")
    print("|" + "---|" * 13)
    columns = ((numpy.arange(n_columns) + 0.5) * width / n_columns).astype(int)
    rows = ((numpy.arange(arguments.rows) + 0.5) * height / arguments.rows).astype(int)
    with tempfile.TemporaryDirectory() as folder:
        graph = Path(folder) / "elements.graph"
        write_graph(graph, arguments.elements)
        for n_parts in (int(number) for number in arguments.parts.split(",")):
            parts = partition(graph, arguments.elements, n_parts)
            owners, side = tile_owners(width, height, n_parts)
            of_rays = owners[rows[:, None] // side, columns[None, :] // side]
            runs, steps, received, messages, n_met = follow(parts, n_parts, eye, directions, of_rays)
            n_bytes = runs.sum() * scale * RUN_BYTES
            most_sent, most_received = runs.max() * scale * RUN_BYTES, received.max() * scale * RUN_BYTES
            device = arguments.device * steps.max() / steps.sum()
            exchange = max(most_sent, most_received) / arguments.network / 1e6 + messages.max() * arguments.message / 1e3
            folding = received.max() * scale / arguments.fold / 1e3
            pixels = n_met * scale * PIXEL_BYTES / arguments.network / 1e6
            alone = device + n_bytes / arguments.network / 1e6 + runs.sum() * scale / arguments.fold / 1e3
            print(f"| {n_parts} | {runs.sum() / n_met:.1f} | {n_bytes / 1e6:.0f} | {n_bytes / n_parts / 1e6:.1f} "
                  f"| {most_sent / 1e6:.1f} | {most_received / 1e6:.1f} | {messages.max()} | {device:.2f} | {exchange:.2f} "
                  f"| {folding:.2f} | {pixels:.1f} | {device + exchange + folding + pixels:.1f} | {alone:.0f} |", flush=True)


if __name__ == "__main__":
    main()
