#!/usr/bin/env python3
"""Prints how many moving pictures a page receives, how late and how large: ELVIS_PROGRAM=build/release/bin/elvis tests/serve/measure_moving.py [SECONDS [ROUNDS]]"""
import sys
import tempfile

from moving import Turn, canister


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 5
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 4
    with tempfile.TemporaryDirectory(prefix="elvis-moving-") as folder:
        server = canister(folder)
        try:
            page = server.page(size=[480, 270])
            page.exact()
            for _ in range(rounds):
                print(Turn(page, seconds))
            page.close()
        finally:
            server.stop()


if __name__ == "__main__":
    main()
