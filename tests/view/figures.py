"""Figures of the window: pictures a second while orbiting, times from release to full and to pixel-exact, how long a picture takes to
stop, and memory over a long scripted interaction.

usage: figures.py ELVIS FILE [--minutes N] [--size WIDTHxHEIGHT]      the size is that of the picture
"""
import argparse
import os
import random
import sys
import tempfile
import time

from driver import Display, Failure, Window, check_programs


def opened(elvis, display, folder, file, size, arguments=()):
    """A window whose picture has that size."""
    window = Window(elvis, display, folder, [file, "--size", "{}x{}".format(*size)] + list(arguments))
    screen = window.settle()
    left, top, right, bottom = screen["places"]["view"]
    extra = [int(size[0] - (right - left)), int(size[1] - (bottom - top))]
    window.close()
    window = Window(elvis, display, folder, [file, "--size", f"{size[0] + extra[0]}x{size[1] + extra[1]}"] + list(arguments))
    window.settle()
    return window


def middle(window):
    return window.place("view")


def orbit(window, seconds=6):
    """Around and back, at sixty moves a second; then lets go."""
    x, y = middle(window)
    window.xdotool("mousemove", x, y, "mousedown", 1)
    end, step, divisors = time.time() + seconds, 0, []
    while time.time() < end:
        step += 1
        across = 150 - abs(step * 4 % 600 - 300)
        window.xdotool("mousemove", x + across, y + across // 3)
        time.sleep(0.012)
    screen = window.screen()
    window.xdotool("mouseup", 1)
    return screen


def measure_motion(window):
    for _ in range(3):
        moving = orbit(window)
        screen = window.settle()
        print(f"orbit: {moving['frames_per_second']:.1f} pictures a second at 1:{moving['divisor']}, "
              f"to all pixels {screen['rest_to_full_seconds']:.2f} s, "
              f"to pixel-exact {screen['rest_to_exact_seconds']:.2f} s", flush=True)


def measure_cancelling(window, times=40):
    """Moves again at random moments of what is drawn at rest."""
    chance = random.Random(1)
    x, y = middle(window)
    known = len(window.screen()["cancel_milliseconds"])
    for i in range(times):
        window.xdotool("mousemove", x, y, "mousedown", 1, "mousemove", x + 10 + i % 7, y + 5, "sleep", "0.05", "mouseup", 1)
        time.sleep(0.1 + 1.5 * chance.random())
    screen = window.settle()
    stopped = sorted(screen["cancel_milliseconds"][known:]) or [0]
    print(f"stopping: of {len(stopped)} the longest took {stopped[-1]:.0f} ms, half at most {stopped[len(stopped) // 2]:.0f} ms",
          flush=True)


def memory(window):
    """Mebibytes, and numbers of what lives on the device, at rest: after the time in which free memory is given back."""
    window.settle()
    time.sleep(1.5)
    memory = window.screen()["memory"]
    return {**memory, **{name: memory[name] / 2**20 for name in ("resident", "heap", "device")}}


def interact(window, chance):
    """One of the things that people do, and everything else as before at the end."""
    kind = chance.choice(["orbit", "wheel", "views", "plane", "pick", "hide", "isosurface", "volume"])
    if kind == "orbit":
        window.drag(middle(window), (chance.randint(-200, 200), chance.randint(-100, 100)), steps=15, pause=0.03)
    elif kind == "wheel":
        window.wheel(middle(window), chance.choice([-3, 3]))
        window.key("f")
    elif kind == "views":
        window.key(str(chance.randint(1, 7)))
    elif kind == "pick":
        window.click("view", chance.uniform(0.4, 0.6), chance.uniform(0.4, 0.6))
    elif kind == "hide":
        window.key("h")
        window.key("h")
    else:
        n_items = len(window.screen()["items"])
        window.click("items/add")
        window.click({"plane": "add/Cut plane", "isosurface": "add/Isosurface", "volume": "add/Volume"}[kind])
        if len(window.screen()["items"]) > n_items:
            window.key("ctrl+z")
        else:
            # A second volume cannot be added, and the menu stays open.
            window.key("Escape")
            window.wait_for(lambda screen: "add/Volume" not in screen["places"], "the menu to close", 20)
    window.settle()


def measure_memory(window, minutes):
    chance = random.Random(2)
    start, next_line = time.time(), 0.0
    n_done, series = 0, []
    while time.time() - start < 60 * minutes:
        interact(window, chance)
        n_done += 1
        if time.time() - start >= next_line:
            now = memory(window)
            series.append(now["resident"])
            print(f"  after {(time.time() - start) / 60:4.1f} min, {n_done} things done: {now['resident']:.0f} MiB, in use "
                  f"{now['heap']:.1f} of the heap and {now['device']:.1f} by {now['buffers']} buffers; {now['kernels']} kernels",
                  flush=True)
            next_line += 30
    print("memory: " + " ".join(f"{size:.0f}" for size in series) + " MiB")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("elvis")
    parser.add_argument("file")
    parser.add_argument("--minutes", type=float, default=0)
    parser.add_argument("--size", default="1280x720")
    arguments = parser.parse_args()
    check_programs()
    size = [int(x) for x in arguments.size.split("x")]
    with tempfile.TemporaryDirectory() as folder:
        display = Display(2400, 1400)
        window = None
        try:
            window = opened(os.path.abspath(arguments.elvis), display, folder, os.path.abspath(arguments.file), size)
            measure_motion(window)
            measure_cancelling(window)
            if arguments.minutes > 0:
                measure_memory(window, arguments.minutes)
        finally:
            if window:
                window.close()
            display.close()


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"figures: {failure}")
