"""check_links.py finds links that lead nowhere, and takes no other for one."""
import pathlib
import subprocess
import sys
import tempfile

CHECK = pathlib.Path(__file__).with_name("check_links.py")

PAGE = """# One heading, and `code`

[a page](other.md) [its heading](other.md#two-words) [again](other.md#two-words-1) [here](#one-heading-and-code)
[a folder](folder) [with a blank](folder/a%20file.txt) [elsewhere](https://example.org/missing) ![picture](folder/a%20file.txt "title")
[by name][name] `[code](missing)`

```
[code](missing)
# no heading
```

[name]: other.md
"""
BAD = ["[file](missing.md)", "[heading](other.md#three-words)", "[own](#no-heading)", "![picture](missing.png)", "[name]: missing.md",
       "<img src=\"missing.png\">", "[absolute](/other.md)"]


def run(folder):
    done = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True)
    return done.returncode, done.stdout


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "folder").mkdir()
    (folder / "folder/a file.txt").write_text("text")
    (folder / "build/pages").mkdir(parents=True)
    (folder / "build/pages/copied.md").write_text("[what is not copied with it](missing.md)\n")
    (folder / "other.md").write_text("# Two words\n\n## Two words\n")
    page = folder / "page.md"
    page.write_text(PAGE)
    assert run(folder) == (0, "2 pages, 8 links, 0 of them lead nowhere\n"), run(folder)
    for bad in BAD:
        page.write_text(PAGE + "\n" + bad + "\n")
        status, output = run(folder)
        line = PAGE.count("\n") + 2
        assert status == 1 and output.startswith(f"page.md:{line}: "), (bad, output)
