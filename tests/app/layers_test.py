#!/usr/bin/env python3
"""What is a client of the library includes no header of the engine: layers_test.py SOURCE-FOLDER"""

import re
import sys
from pathlib import Path

clients = ["apps/elvis/view", "apps/serve", "apps/paraview", "apps/python", "apps/elvis/render", "apps/elvis/convert", "apps/elvis/command_info.cpp",
           "apps/elvis/command_probe.cpp", "apps/elvis/command_serve.cpp", "apps/elvis/command_view.cpp",
           "apps/elvis/library_context.cpp", "apps/elvis/open_volume.hpp"]
# Of small things that know nothing of volumes and pictures.
general = ("core/base/", "core/camera/", "core/late_library/")
# A window has a Vulkan surface of its own to show pictures in.
of_window = (*general, "core/vulkan/")
# Drawing in parts of a volume or from some of its elements, and what many processes do together: the library has no word for it.
parts = {"part_choice", "parts_film", "render_parts", "volume_to_part", "render_on_demand", "convert_together"}

source = Path(sys.argv[1])
n_files = 0
wrong = []
for client in clients:
    place = source / client
    files = [place] if place.is_file() else [path for path in place.rglob("*.?pp") if path.stem not in parts]
    if not files:
        wrong.append(f"{client} is not there")
    for path in files:
        n_files += 1
        allowed = of_window if path.parent == source / "apps/elvis/view/window" else general
        headers = re.findall(r'^\s*#\s*include\s*[<"](core/[^>"]+)', path.read_text(encoding="utf-8"), flags=re.M)
        wrong += [f"{path.relative_to(source)}: <{header}>" for header in headers if not header.startswith(allowed)]
print("\n".join(wrong) or f"{n_files} files use the library alone")
sys.exit(bool(wrong))
