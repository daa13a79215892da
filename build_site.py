#!/usr/bin/env python3
"""Builds all pages of the repository into a site with search: build_site.py [FOLDER], by default build/site. Needs mkdocs.

The pages lie beside what they describe. They are gathered into FOLDER/pages, in the same tree, with all files that they link to or
show; the site is FOLDER/html. Fails if a link, or its anchor, leads nowhere.
"""
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent
LINK = re.compile(r"(!?\[[^\[\]]*(?:\[[^\[\]]*\][^\[\]]*)*\])\(([^)\s]+)\)")
# Texts that `elvis new-plugin` fills in.
LEFT_OUT = "plugin_api/templates/"


def all_pages():
    """What git tracks or would; in an unpacked archive, what there is outside of hidden and build folders."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], cwd=ROOT,
                            capture_output=True, text=True)
    pages = listed.stdout.splitlines()
    if listed.returncode != 0:
        pages = [path.relative_to(ROOT).as_posix() for path in ROOT.rglob("*.md")
                 if not any(part == "build" or part.startswith(".") for part in path.relative_to(ROOT).parts)]
    return [ROOT / page for page in sorted(pages) if not page.startswith(LEFT_OUT) and (ROOT / page).exists()]


def gather(page, pages):
    """Copies a page and what it links to. Folders are their README; what has none is named, not linked."""
    def settle(found):
        text, target = found.groups()
        path, _, anchor = target.partition("#")
        if not path or ":" in path:
            return found.group(0)
        there = pathlib.Path(os.path.normpath(page.parent / path))
        if not there.exists():
            sys.exit(f"{page.relative_to(ROOT)}: the link to '{target}' leads nowhere")
        if there.is_dir():
            if not (there / "README.md").exists():
                return text[1:-1]
            path = os.path.join(path, "README.md")
        elif there.suffix != ".md":
            copy(there, pages)
        return f"{text}({path}{'#' + anchor if anchor else ''})"

    place = copy(page, pages)
    parts = re.split(r"(^```.*?^```$)", page.read_text(), flags=re.DOTALL | re.MULTILINE)
    place.write_text("".join(part if part.startswith("```") else for_mkdocs(LINK.sub(settle, part)) for part in parts))


def for_mkdocs(text):
    """GitHub wants | of code in tables escaped; mkdocs shows the escape."""
    return re.sub(r"`[^`\n]+`", lambda code: code.group(0).replace(r"\|", "|"), text)


def copy(file, pages):
    place = pages / file.relative_to(ROOT)
    place.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(file, place)
    return place


class Page(html.parser.HTMLParser):
    """Places that a page of the site has, and that it leads to."""

    def __init__(self, file):
        super().__init__()
        self.ids, self.targets = set(), []
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (name == "name" and tag == "a"):
                self.ids.add(value)
            elif name in ("href", "src") and value:
                self.targets.append(value)


def dead_links(site):
    pages = {file: Page(file) for file in site.rglob("*.html")}
    for file, page in pages.items():
        # The page of what is not found speaks of the site's root, wherever that will be.
        for target in page.targets if file.name != "404.html" else []:
            url = urllib.parse.urlparse(target)
            if url.scheme or url.netloc:
                continue
            there = (file.parent / urllib.parse.unquote(url.path)).resolve() if url.path else file
            there = there / "index.html" if there.is_dir() else there
            if not there.exists() or (url.fragment and there in pages and url.fragment not in pages[there].ids):
                yield f"{file.relative_to(site)}: the link to '{target}' leads nowhere"


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/site").resolve()
    pages, site = folder / "pages", folder / "html"
    shutil.rmtree(pages, ignore_errors=True)
    for page in all_pages():
        gather(page, pages)
    (folder / "mkdocs.yml").write_text(f"INHERIT: {ROOT / 'mkdocs.yml'}\ndocs_dir: pages\nsite_dir: html\n")
    subprocess.run(["mkdocs", "build", "--strict", "--quiet", "--clean", "--config-file", folder / "mkdocs.yml"], check=True)
    dead = list(dead_links(site))
    if dead:
        sys.exit("\n".join(dead))
    print(f"The site is {site / 'index.html'}, with {len(list(site.rglob('*.html')))} pages.")


if __name__ == "__main__":
    main()
