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

ranges = [vortex.range("pressure", step) for step in range(len(vortex.time_steps))]
frames = out / "film"
frames.mkdir(exist_ok=True)
for step, time in enumerate(vortex.time_steps):
    scene = vortex.scene(field="pressure", cut_planes=[[0, 0, 1, -1.1], [1, 0, 0, -1.6]], time_step=step)
    scene.color_map.range = [min(r.minimum for r in ranges), max(r.maximum for r in ranges)]
    scene.camera.eye, scene.camera.up = [7, 5, 6], [0, 0, 1]
    scene.render(320, 240).save(frames / f"frame_{step:04}.png")
    print(f"time {time:g}: pressure in [{ranges[step].minimum:.3f}, {ranges[step].maximum:.3f}]")
if shutil.which("ffmpeg"):
    subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", "5", "-i", frames / "frame_%04d.png", "-pix_fmt", "yuv420p",
                    out / "film.mp4"], check=True)
