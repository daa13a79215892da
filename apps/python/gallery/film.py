"""Time steps as pictures with the same colours, and as a film where ffmpeg is installed."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import elvis

_, out = map(Path, sys.argv[1:])
text = {"generator": 1, "mesh": "box", "box": [[0, 0, 0], [3.2, 3.2, 3.2]], "elements": [3, 3, 3], "order": 5,
        "field": "taylor-green", "time_steps": 6}
(out / "vortex.json").write_text(json.dumps(text))
elvis.convert(out / "vortex.json", out / "vortex.h5")
vortex = elvis.open(out / "vortex.h5")

scene = vortex.scene(field="pressure", cut_planes=[[0, 0, 1, -1.1], [1, 0, 0, -1.6]])
scene.camera.eye, scene.camera.up = [7, 5, 6], [0, 0, 1]
scene.image.size = [320, 240]
scene.animation.time_steps = "all"
animation = vortex.animate(scene)
frames = out / "film"
frames.mkdir(exist_ok=True)
for number, picture in enumerate(animation):
    picture.save(frames / f"frame_{number:04}.png")
    step = animation.time_step(number)
    span = vortex.range("pressure", step)
    print(f"time {vortex.time_steps[step]:g}: pressure in [{span.minimum:.3f}, {span.maximum:.3f}]")
if shutil.which("ffmpeg"):
    subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", "5", "-i", frames / "frame_%04d.png", "-pix_fmt", "yuv420p",
                    out / "film.mp4"], check=True)
