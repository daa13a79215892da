#!/usr/bin/env python3
"""Checks that links of all Markdown pages lead somewhere: relative links to files, and #anchors to headings.

usage: check_links.py [ROOT]

ROOT is the project's folder by default. In a git checkout the pages are those that git tracks or would track, elsewhere all below
ROOT but for its build folders (build/). Nothing is fetched: links with a scheme (https:, mailto:) are left alone. What GitHub and
mkdocs make of a page differs in details that no page should depend on; anchors are those of GitHub.
"""
import pathlib
import re
import subprocess
import sys
import unicodedata
import urllib.parse

FENCE = re.compile(r"^ {0,3}(```|~~~).*?^ {0,3}\1[`~]*\s*$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)", re.DOTALL)
# [text](target "title"), ![picture](target), and definitions at the start of a line: [name]: target
INLINE = re.compile(r"\]\(\s*<?([^()<>\s]*(?:\([^()\s]*\)[^()<>\s]*)*)>?(?:\s+[\"'][^)]*)?\s*\)")
DEFINITION = re.compile(r"^ {0,3}\[[^\]^]+\]:\s*<?([^\s>]+)>?", re.MULTILINE)
HTML = re.compile(r"<(?:a|img)\b[^>]*?\b(?:href|src)=[\"']([^\"']+)[\"']")
HEADING = re.compile(r"^ {0,3}#{1,6}[ \t]+(.+?)[ \t]*#*[ \t]*$", re.MULTILINE)
EXPLICIT = re.compile(r"<[^>]*\b(?:id|name)=[\"']([^\"']+)[\"']|\{[^}]*#([\w-]+)[^}]*\}")
SCHEME = re.compile(r"^[a-zA-Z][a-zA-Z0-9+.-]*:|^//")


def blank(match):
    """The same number of lines, so that places of what follows stay right."""
    return "\n" * match.group().count("\n")


def pages(root):
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.md"],
                                check=True, capture_output=True, text=True).stdout.split("\0")
        found = [root / name for name in listed if name]
    except (OSError, subprocess.CalledProcessError):
        found = [page for page in root.rglob("*.md") if page.relative_to(root).parts[0] != "build"]
    return sorted(page for page in found if page.is_file())


def slug(heading):
    """The anchor that GitHub gives to a heading: letters, digits, - and _ are kept, blanks become -."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"\s*\{[^}]*\}\s*$", "", text).replace("`", "").replace("*", "")
    kept = (c for c in text.strip().lower() if c in "-_ " or unicodedata.category(c)[0] in "LN" or unicodedata.category(c) == "Mn")
    return "".join(kept).replace(" ", "-")


def anchors(page):
    text = FENCE.sub(blank, page.read_text(encoding="utf-8"))
    names = set()
    times = {}
    for heading in HEADING.findall(text):
        name = slug(heading)
        names.add(f"{name}-{times[name]}" if name in times else name)
        times[name] = times.get(name, 0) + 1
    names.update(a or b for a, b in EXPLICIT.findall(text))
    return names


def links(text):
    """(line, target) of each link outside of code."""
    text = CODE.sub(blank, FENCE.sub(blank, text))
    for pattern in (INLINE, DEFINITION, HTML):
        for match in pattern.finditer(text):
            yield text.count("\n", 0, match.start(1)) + 1, match.group(1)


def fault(page, target, known_anchors):
    """What is wrong with a link of a page, or None."""
    path, _, anchor = target.partition("#")
    aim = (page.parent / urllib.parse.unquote(path)) if path else page
    if path.startswith("/"):
        return "is absolute; write it relative to the page"
    if not aim.exists():
        return "leads to no file or folder"
    if anchor and aim.suffix == ".md":
        aim = aim.resolve()
        if aim not in known_anchors:
            known_anchors[aim] = anchors(aim)
        if urllib.parse.unquote(anchor) not in known_anchors[aim]:
            return "leads to no heading of that page"
    return None


def main(arguments):
    if len(arguments) > 1 or (arguments and arguments[0].startswith("-")):
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[2]
    found = pages(root)
    if not found:
        print(f"{root}: no Markdown page found", file=sys.stderr)
        return 1
    known_anchors = {}
    n_links = n_faults = 0
    for page in found:
        for line, target in links(page.read_text(encoding="utf-8")):
            if not target or SCHEME.match(target):
                continue
            n_links += 1
            wrong = fault(page, target, known_anchors)
            if wrong:
                n_faults += 1
                print(f"{page.relative_to(root)}:{line}: '{target}' {wrong}")
    print(f"{len(found)} pages, {n_links} links, {n_faults} of them lead nowhere")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
