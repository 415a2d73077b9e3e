"""The commands of the tutorials run as they stand: those of one page in one folder, one after the other. What takes a minute is asked
for less: options are added, and nothing is left out. The fit with which several pages begin is made by the first of them alone."""

import os
import pathlib
import re
import shlex
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Of the two blades on their hub, the hub alone is protected; of a cavity, one layer with the tool that it was made by.
LESS = (
    (r"^(flank fit blisk\.step .*?)( \|\||$)", r"\1 --check-faces F1\2"),
    (r"^(flank trochoid .*?)( \|\||$)", r"\1 --tool cavity.tool.json --layers 1 --strategy plain --stock-cell 2\2"),
)
FIRST_FIT = "flank fit blade.step --face F1 --tolerance 0.1 -o out"
PAGES = sorted((ROOT / "docs/tutorials").glob("*.md"))


def blocks(page):
    return re.findall(r"```(sh|toml|python)\n(.*?)```", page.read_text(), re.DOTALL)


def with_less(text):
    for line, less in LESS:
        text = re.sub(line, less, text, flags=re.MULTILINE)
    return text


def test_there_are_tutorials_and_commands_in_them():
    assert len(PAGES) >= 7
    assert sum(len(blocks(page)) for page in PAGES) >= 15


@pytest.fixture(scope="module")
def first_fit(tmp_path_factory):
    """Where the result of FIRST_FIT is kept once a page has made it."""
    return tmp_path_factory.mktemp("first") / "out"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_commands_of_a_tutorial_run(page, tmp_path, first_fit):
    path = os.path.dirname(os.environ["FLANK_BINARY"]) + os.pathsep + os.environ["PATH"]
    for kind, text in blocks(page):
        text = with_less(text)
        if kind == "sh" and FIRST_FIT in text.splitlines():
            kept = shlex.quote(str(first_fit))
            instead = f"cp -r {kept} out" if first_fit.exists() else f"{FIRST_FIT}\ncp -r out {kept}"
            text = text.replace(FIRST_FIT, instead)
        if kind == "toml":
            (tmp_path / "plan.toml").write_text(text)
            continue
        words = ["sh", "-ec", text] if kind == "sh" else [sys.executable, "-c", text]
        done = subprocess.run(words, cwd=tmp_path, env=dict(os.environ, PATH=path), capture_output=True, text=True)
        assert done.returncode == 0, f"{text}\n{done.stdout}\n{done.stderr}"
