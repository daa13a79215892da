#!/usr/bin/env python3
"""Runs the commands of pages as a reader would, in a folder of their own: run_commands.py ELVIS FOLDER PAGE...

Commands are those of indented blocks that begin with elvis, echo, cd or, for Debian's Python, import. Pictures are small, so that it takes seconds.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^    .*\n|^\n(?=    ))+", re.MULTILINE)

# What the reader's shell lacks: small pictures; no window, nor files that stand for the reader's own; films where there is ffmpeg.
SHELL = r"""
set -e
cd() { :; }
elvis() {
    case "$1 $2" in
    view*|"convert mesh.mesh") return ;;
    esac
    local arguments=("$@")
    if [ "$1" = render ]; then
        case "$*" in
        *--size*) ;;
        *) arguments+=(--size 48x36) ;;
        esac
    fi
    "$ELVIS" --quiet "${arguments[@]}"
}
"""


def blocks(page):
    for found in BLOCK.finditer(page.read_text()):
        lines = [line[4:] for line in found.group(0).splitlines()]
        yield "\n".join(lines).replace("./elvis", "elvis").strip("\n")


def command_of(block):
    first = block.split()[0]
    if first in ("elvis", "echo", "cd"):
        if not shutil.which("ffmpeg"):
            block = re.sub(r" --film \S+", "", block)
        return ["bash", "-c", SHELL + block]
    return ["/usr/bin/python3", "-c", block] if first == "import" else None


def main():
    elvis, folder, *pages = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "tests").symlink_to(ROOT / "tests")
    n_run = 0
    for page in pages:
        for block in blocks(page):
            command = command_of(block)
            if command and subprocess.run(command, cwd=folder, env={**os.environ, "ELVIS": str(elvis.resolve())}).returncode != 0:
                sys.exit(f"{page}: this does not work:\n{block}")
            n_run += command is not None
    print(f"{n_run} blocks of commands work.")


if __name__ == "__main__":
    main()
