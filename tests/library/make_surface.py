#!/usr/bin/env python3
"""Writes definitions of all functions that headers declare, for their types to be compared: make_surface.py OUTPUT.C HEADER..."""

import re
import sys

declared = []
for header in sys.argv[2:]:
    with open(header, encoding="utf-8") as file:
        text = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.S)
    declared += re.findall(r"ELVIS_EXPORT\s+([^;]+?)\s*(\w+)\(([^;]*?)\);", text, flags=re.S)
with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write("#include <elvis/editing.h>\n#include <elvis/extract.h>\n#include <elvis/insitu.h>\n")
    for result, name, parameters in declared:
        body = "" if result.strip() == "void" else "return 0;"
        file.write(f"ELVIS_EXPORT {result} {name}({' '.join(parameters.split())}) {{ {body} }}\n")
