"""What a window must stand for hours: conversion plugins that crash or never return, and the same things done again and again.

usage: endurance_test.py ELVIS FOLDER TROUBLED_PLUGIN
"""
import json
import os
import shutil
import sys
import time

from driver import Display, Failure, Window, check_programs, require
from window_test import run

VOLUME = {"generator": 1, "mesh": "ball", "shape": "hexahedron", "elements": [2, 2, 2], "geometry_order": 2, "order": 2,
          "field": "waves"}
# Of the heap in use, each time. What is seen is some 0.02: undo, messages, and what drivers keep.
MOST_GROWTH = 0.25


def offers_conversion(window):
    """Until the conversion has been begun."""
    window.wait_for(lambda screen: screen["dialog"] == 4, "the offer to convert")
    window.click("dialog/do")


def says(window, *words):
    window.wait_for(lambda screen: any(all(word in message for word in words) for message in screen["messages"]),
                    f"a message with {words}", 30)


def opens(window, file):
    window.key("ctrl+o")
    window.wait_for(lambda screen: screen["dialog"] == 1, "the dialog")
    window.write(file)
    window.key("Return")


def survives_plugin(elvis, display, folder, trouble):
    os.environ["ELVIS_TROUBLE"] = trouble
    window = Window(elvis, display, folder, ["--size", "800x600"])
    try:
        opens(window, os.path.join(folder, "bad.tetrahedron"))
        offers_conversion(window)
        if trouble == "crash":
            says(window, "bad.tetrahedron", "org.elvis.test.troubled-source", "in its function sample", "signal 11")
        else:
            time.sleep(1)
            window.click("dialog/cancel")
            says(window, "the conversion was cancelled")
        # The window goes on.
        opens(window, os.path.join(folder, "ball.h5"))
        window.wait_for(lambda screen: screen["volume"].endswith("ball.h5"), "another volume")
    finally:
        window.close()
        del os.environ["ELVIS_TROUBLE"]
    print(f"the window goes on after: {trouble}", flush=True)
    left = [name for name in os.listdir(folder) if name.startswith(".elvis") or name == "bad.h5"]
    require(not left, f"{trouble} left {left}")


def memory(window):
    """At rest, after free memory was given back."""
    window.settle()
    time.sleep(1.5)
    return window.screen()["memory"]


def do_all(window):
    """What leaves everything as it was."""
    x, y = window.place("view")
    window.drag((x, y), (80, 30))
    window.settle()
    window.key("1")
    window.settle()
    # The isosurface has a field of its own, whose kernels go when it does.
    for name in ("add/Cut plane", "add/Isosurface"):
        window.click("items/add")
        window.click(name)
        window.settle()
        window.key("ctrl+z")
        window.settle()


def keeps_its_size(elvis, display, folder, n_rounds=3):
    """What grows in each round is lost. What grows in one, as when a slow machine shows other pictures before the last one, is not."""
    window = Window(elvis, display, folder, ["ball.h5", "--size", "800x600"])
    try:
        do_all(window)
        sizes = [memory(window)]
        for _ in range(n_rounds):
            do_all(window)
            sizes.append(memory(window))
    finally:
        window.close()
    first, last = sizes[0], sizes[-1]
    for what in ("kernels", "buffers", "device"):
        require(last[what] == first[what], f"{what}: {first[what]}, and after the same things again {last[what]}")
    growths = [(after["heap"] - before["heap"]) / 2**20 for before, after in zip(sizes, sizes[1:])]
    require(min(growths) < MOST_GROWTH, f"the heap grows each time, by {', '.join(f'{growth:.2f}' for growth in growths)} MiB")
    # What is free goes back to the system, but for what lies between pieces that are in use.
    resident = (last["resident"] - first["resident"]) / 2**20
    require(resident < 60, f"the program has grown by {resident:.0f} MiB")
    print(f"the heap has grown by {', '.join(f'{growth:.3f}' for growth in growths)} MiB, {resident:.1f} MiB are resident in all")


def main(elvis, folder, plugin):
    check_programs()
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "plugins"))
    os.chdir(folder)
    shutil.copy(plugin, "plugins")
    os.environ["ELVIS_PLUGIN_PATH"] = os.path.join(folder, "plugins")
    with open("ball.json", "w") as file:
        json.dump(VOLUME, file)
    open("bad.tetrahedron", "w").close()
    run(elvis, folder, "convert", "ball.json", "-o", "ball.h5")
    display = Display(1200, 900)
    try:
        survives_plugin(elvis, display, folder, "crash")
        survives_plugin(elvis, display, folder, "hang")
        keeps_its_size(elvis, display, folder)
    finally:
        display.close()


if __name__ == "__main__":
    try:
        main(*(os.path.abspath(argument) for argument in sys.argv[1:4]))
    except Failure as failure:
        sys.exit(f"endurance_test: {failure}")
