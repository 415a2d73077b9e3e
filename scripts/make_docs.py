#!/usr/bin/env python3
"""The site of the documents: Doxygen reads include/flank, Sphinx makes pages of docs/ and of the documents of the root.

usage: make_docs.py OUT   (OUT/html/index.html; needs doxygen, sphinx, furo, myst-parser, breathe: scripts/install-deps.sh docs)
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
REPOSITORY_FILES = ("README.md", "ARCHITECTURE.md", "GLOSSARY.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md")
# The order of the side bar.
CONTENTS = [
    ("Tutorials", ["tutorials/" + name for name in ("first-blade", "studio", "freecad", "reading-the-report", "given-tool", "beside-a-hub", "a-cavity", "to-the-machine",
                                                    "from-python", "what-it-cannot-do")]),
    ("Using it", ["root/README", "python", "python-api", "library", "api", "wheel", "longer-runs", "results", "comparison", "packaging"]),
    ("How it works", ["MATH", "root/ARCHITECTURE", "root/GLOSSARY", "reliability"]),
    ("Algorithms", ["algorithms/*"]),
    ("Files", ["schema/*"]),
    ("Decisions", ["decisions/*"]),
    ("The project", ["history", "history/*", "root/CONTRIBUTING", "root/CHANGELOG", "root/SECURITY"])]


def doxygen(work):
    settings = {"PROJECT_NAME": "OpenFlank", "INPUT": ROOT / "include/flank", "RECURSIVE": "YES", "GENERATE_HTML": "NO", "GENERATE_LATEX": "NO",
                "GENERATE_XML": "YES", "OUTPUT_DIRECTORY": work, "QUIET": "YES", "WARNINGS": "NO", "EXTRACT_ALL": "YES",
                "FILE_PATTERNS": "*.h"}
    text = "".join(f"{key} = {value}\n" for key, value in settings.items())
    subprocess.run(["doxygen", "-"], input=text, text=True, check=True)


def relinked(text, source, moved):
    """Links to files of the tree that are on the site at another place lead there; what is not on the site is named only."""
    def link(match):
        label, target = match.group(1), match.group(2)
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        path, _, mark = target.partition("#")
        file = (source.parent / path).resolve()
        if file.is_dir() and (file / "README.md").is_file():
            file = file / "README.md"
        place = moved.get(file)
        if place is None:
            return match.group(0) if file.suffix in (".png", ".svg") else label
        return f"[{label}]({os.path.relpath(place, moved[source].parent)}{'#' + mark if mark else ''})"

    return re.sub(r"(?<!!)\[([^\]\n]*)\]\(([^)\s]+)\)", link, text)


def has_module():
    """The signatures and docstrings of the Python module are taken from the module itself."""
    return subprocess.run([sys.executable, "-c", "import openflank"], capture_output=True).returncode == 0


def lay_out(work):
    """docs/ as it is, the root's documents in root/, a page of the API, and the first page."""
    moved = {file: work / file.relative_to(ROOT / "docs") for file in (ROOT / "docs").rglob("*.md")}
    moved |= {ROOT / name: work / "root" / name for name in REPOSITORY_FILES}
    for file, place in moved.items():
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(relinked(file.read_text(), file, moved))
    shutil.copytree(ROOT / "docs/images", work / "images", dirs_exist_ok=True)
    (work / "root" / "docs").mkdir(exist_ok=True)
    shutil.copytree(ROOT / "docs/images", work / "root/docs/images", dirs_exist_ok=True)
    shutil.copy(ROOT / "docs/site/conf.py", work)
    (work / "api.md").write_text("# The C++ front door\n\nAll of `flank/flank.h`.\n\n```{eval-rst}\n.. doxygennamespace:: flank\n   :project: openflank\n"
                                 "   :content-only:\n   :members:\n```\n")
    (work / "python-api.md").write_text("# The module openflank\n\n" + (
        "```{eval-rst}\n.. automodule:: openflank\n   :members:\n   :imported-members:\n   :undoc-members:\n```\n" if has_module()
        else "This site was made without the module: PYTHONPATH names the build tree's.\n"))
    index = moved[ROOT / "docs/index.md"]
    trees = "".join("\n```{toctree}\n:hidden:\n:glob:\n:caption: " + caption + "\n\n" + "\n".join(pages) + "\n```\n" for caption, pages in CONTENTS)
    index.write_text(index.read_text() + trees)


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    work = out / "source"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    lay_out(work)
    (out / "doxygen").mkdir(exist_ok=True)
    doxygen(out / "doxygen")
    environment = dict(os.environ, FLANK_SOURCE=str(ROOT), FLANK_DOXYGEN=str(out / "doxygen/xml"))
    done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", str(work), str(out / "html")], env=environment)
    sys.exit(done.returncode)


if __name__ == "__main__":
    main()
