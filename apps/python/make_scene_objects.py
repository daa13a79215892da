#!/usr/bin/env python3
"""Writes the classes of scene objects for Python from the JSON Schema of scenes: make_scene_objects.py SCHEMA OUTPUT."""

import json
import keyword
import sys
import textwrap

HEAD = '''"""Objects of scenes, one class for each object of the scene file. Made from scene.schema.json."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, Literal

from ._node import Node

__all__ = {names}
'''


def camel(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def singular(name: str) -> str:
    return {"lights": "light", "surfaces": "surface", "volume": "volume_file", "views": "view", "peaks": "peak",
            "key_frames": "key_frame", "points": "color_point", "texts": "text", "axes": "axes",
            "color_bars": "color_bar"}.get(name, name)


class Classes:
    def __init__(self, schema):
        self.schema = schema
        self.texts = {}

    def resolved(self, node):
        if "$ref" in node:
            name = node["$ref"].rsplit("/", 1)[1]
            return name, {**self.schema["$defs"][name], **({"description": node["description"]} if "description" in node else {})}
        return None, node

    def class_of(self, key, node):
        """The class of an object, made if it is new; None if the node is no object with keys."""
        name, node = self.resolved(node)
        if "properties" not in node:
            return None
        name = camel(name or singular(key))
        if name not in self.texts:
            self.texts[name] = None  # Its place, should it name itself.
            text = self.text_of(name, node)
            del self.texts[name]
            self.texts[name] = text  # After those that it names.
        return name

    def kind(self, key, node):
        """Python type for people, class of objects or None, whether it is a list of them."""
        if "anyOf" in node:
            kinds = [self.kind(key, alternative) for alternative in node["anyOf"]]
            classes = [(cls, is_list) for _, cls, is_list in kinds if cls]
            cls, is_list = classes[0] if classes else (None, False)
            return " | ".join(dict.fromkeys(kind for kind, _, _ in kinds)), cls, is_list
        cls = self.class_of(key, node)
        if cls:
            return cls, cls, False
        _, node = self.resolved(node)
        if "enum" in node:
            return f"Literal[{', '.join(repr(word) for word in node['enum'])}]", None, False
        if node.get("type") == "array":
            item = node.get("items")
            if isinstance(item, dict) and item:
                kind, cls, _ = self.kind(key, item)
                return (f"list[{cls}]" if cls else f"Sequence[{kind}]"), cls, cls is not None
            return "Sequence[Any]", None, False
        return {"string": "str", "number": "float", "integer": "int", "boolean": "bool", "object": "dict[str, Any]"}.get(
            node.get("type"), "Any"), None, False

    def text_of(self, name, node):
        lines = [f"class {name}(Node):", f'    """{node.get("description", "An object of a scene.")}"""', ""]
        keys = []
        for key, value in node["properties"].items():
            kind, cls, is_list = self.kind(key, value)
            attribute = key + "_" if keyword.iskeyword(key) else key
            keys.append(f'        "{attribute}": ("{key}", {cls}, {is_list}),')
            lines.append(f"    {attribute}: {kind if cls else kind + ' | None'}")
            _, whole = self.resolved(value)
            description = whole.get("description", "")
            if "default" in value and not isinstance(value["default"], dict):
                description = f"{description}.".lstrip(".") + f" By default {json.dumps(value['default'])}."
            description = description.strip()
            if description:
                description += "" if description.endswith(".") else "."
                wrapped = textwrap.wrap(description.replace("\\", "\\\\").strip(), 110)
                lines += [f'    """{wrapped[0]}'] + [f"    {line}" for line in wrapped[1:]]
                lines[-1] += '"""'
        lines += ["", "    _keys: ClassVar[dict[str, tuple[str, type | None, bool]]] = {", *keys, "    }", ""]
        return "\n".join(lines)


def main() -> None:
    with open(sys.argv[1], encoding="utf-8") as file:
        schema = json.load(file)
    classes = Classes(schema)
    root = {**schema, "description": schema.get("description", "A scene.")}
    classes.texts["SceneKeys"] = None
    text = classes.text_of("SceneKeys", root)
    del classes.texts["SceneKeys"]
    classes.texts["SceneKeys"] = text
    names = json.dumps(sorted(classes.texts))
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(HEAD.replace("{names}", names))
        for text in classes.texts.values():
            file.write("\n\n" + text)


main()
