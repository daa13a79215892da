"""The flow past a rotating canister: a cut with contours, and an isosurface around it."""

import sys
from pathlib import Path

import elvis

data, out = map(Path, sys.argv[1:])
elvis.convert(data / "elvis/bulletH1P2.dat", out / "canister.h5")
canister = elvis.open(out / "canister.h5")
print(canister)
found = canister.range("density")
print(f"density lies in [{found.minimum:.4g}, {found.maximum:.4g}]{', which is proven' if found.certified else ''}")

scene = canister.scene(cut_planes=[[1, 0, 0, 0]], isosurfaces=[-0.15])
scene.surfaces[0].contours.count = 20
scene.surfaces[1].opacity = 0.6
scene.color_map.name, scene.color_map.range = "viridis", [-0.5, 0.5]
scene.camera = elvis.Scene.read(data / "gallery/canister.json").camera
scene.lighting = "default"
scene.image.annotation = "default"
picture = scene.render(480, 360)
picture.save(out / "first_picture.png")
print(*picture.remarks, sep="\n")
