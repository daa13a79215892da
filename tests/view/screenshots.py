"""Makes the README's picture of the window, on a display of its own.

usage: screenshots.py ELVIS OUT.png
"""
import json
import os
import subprocess
import sys
import tempfile

from driver import Display, Failure, Window, check_programs

SCENE = {
    "version": 1,
    "volume": {"path": "ball.h5"},
    "camera": {"eye": [2.1, 1.3, 2.0], "look_at": [0, 0, 0]},
    "color_map": {"name": "coolwarm"},
    "image": {"annotation": "default"},
    "lighting": {"specular": 0.2},
    "surfaces": [
        {"type": "plane", "plane": [1, 0, 0, -0.1], "contours": {"count": 9, "color": [0, 0, 0]}, "mesh_lines": {}},
        {"type": "boundary", "clip": [[-1, 0, 0, 0.1]]},
        {"type": "isosurface", "values": [1.2], "color": [0.95, 0.75, 0.2], "clip": [[1, 0, 0, -0.1]]},
    ],
}


def main(elvis, out):
    check_programs()
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "ball.json"), "w") as file:
            json.dump({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [4, 4, 4], "geometry_order": 3, "order": 6,
                       "field": "waves"}, file)
        subprocess.run([elvis, "convert", "ball.json", "-o", "ball.h5", "--report", "report.json"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "scene.json"), "w") as file:
            json.dump(SCENE, file)
        display = Display(1280, 800)
        window = None
        try:
            window = Window(elvis, display, folder, ["scene.json", "--size", "1280x800"])
            window.settle()
            window.click("item/0")
            window.click("view", 0.42, 0.62)
            window.wait_for(lambda screen: screen["picked"], "a point")
            window.settle()
            # The cursor away from everything that would explain itself.
            window.xdotool("mousemove", *window.place("view", 0.9, 0.95))
            window.settle()
            window.picture(out)
        finally:
            if window:
                window.close()
            display.close()


if __name__ == "__main__":
    try:
        main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]))
    except Failure as failure:
        sys.exit(f"screenshots: {failure}")
