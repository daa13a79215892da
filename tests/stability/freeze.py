#!/usr/bin/env python3
"""What is to be written when the public headers change, and when a version of them is frozen.

    freeze.py --hash "beginning of the changelog's line"
        the line of plugin_api/interface_changes.txt: replaces the last one if that has the same text, else is added
    freeze.py --build build/release --baseline
        plugin_api/abi/elvis-VERSION.abi from the types that the target abi_surface holds; needs abidw (abigail-tools)
    freeze.py --plugins
        tests/stability/frozen/VERSION: the headers as they are, and plugins to be compiled with them in every later version

VERSION is what elvis/abi.h says. A frozen version that has been released is never written again.
"""
import argparse
import hashlib
import pathlib
import re
import shutil
import subprocess

root = pathlib.Path(__file__).resolve().parents[2]
api = root / "plugin_api"

# Together they use every function of the interface: all that a C plugin must give, a C++ plugin made by the tutorial, and one with
# everything that is optional, reference shapes of its own and a converter included.
plugins = {
    "cube": ["tests/fixtures/cube.h", "tests/fixtures/descriptor.h", "tests/fixtures/good.c", "tests/fixtures/tetrahedron.h"],
    "my_solver": [
        "plugin_api/tutorial/step1/src/mesh_file.cpp",
        "plugin_api/tutorial/step1/src/mesh_file.hpp",
        "plugin_api/tutorial/step1/sample/modal.mesh",
        "plugin_api/tutorial/step2/src/snippet.glsl",
        "plugin_api/tutorial/step3/src/plugin.cpp",
    ],
    "complete": [
        "tests/conformance/defective.cpp",
        "tests/conformance/defective.glsl",
        "tests/conformance/defective_data.hpp",
        "tests/conformance/defective_source.cpp",
    ],
}


def version():
    text = (api / "include/elvis/abi.h").read_text()
    return ".".join(re.search(rf"ELVIS_ABI_VERSION_{part} (\d+)u", text)[1] for part in ("MAJOR", "MINOR"))


def headers_hash():
    """As tests/stability/changelog_test.cmake has it."""
    files = [path for path in (api / "include/elvis").iterdir() if path.suffix in (".h", ".hpp")] + [api / "glsl_interface.md"]
    names = sorted(path.relative_to(api).as_posix() for path in files)
    lines = [f"{name} {hashlib.sha256((api / name).read_bytes()).hexdigest()}\n" for name in names]
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def write_hash(text):
    record = api / "interface_changes.txt"
    lines = record.read_text().splitlines()
    if lines[-1].split(" ", 1)[1] == text:
        lines.pop()
    lines.append(f"{headers_hash()} {text}")
    record.write_text("\n".join(lines) + "\n")


def write_baseline(build):
    library = pathlib.Path(build) / "tests/stability/libabi_surface.so"
    baseline = api / f"abi/elvis-{version()}.abi"
    options = ["--no-corpus-path", "--no-comp-dir-path", "--no-show-locs"]
    subprocess.run(["abidw", *options, "--out-file", baseline, library], check=True)


def freeze_plugins():
    folder = root / "tests/stability/frozen" / version()
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(api / "include/elvis", folder / "include/elvis")
    for name, sources in plugins.items():
        (folder / name).mkdir()
        for source in sources:
            shutil.copy(root / source, folder / name)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--hash", metavar="TEXT")
parser.add_argument("--build")
parser.add_argument("--baseline", action="store_true")
parser.add_argument("--plugins", action="store_true")
arguments = parser.parse_args()
if arguments.baseline and not arguments.build:
    parser.error("--baseline needs --build")
if arguments.hash:
    write_hash(arguments.hash)
if arguments.baseline:
    write_baseline(arguments.build)
if arguments.plugins:
    freeze_plugins()
