"""The commands of the tutorials run as they stand: those of one page in one folder, one after the other. What takes a minute is asked
for less: options are added, and nothing is left out."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Of the blade, an open sheet, the side that is found to be the better one; of a cavity, one layer with the tool that it was
# made by.
LESS = (
    (r"^(flank (?:fit|cover) blade\.step .*?)( \|\||$)", r"\1 --side +\2"),
    (r"^(flank trochoid .*?)( \|\||$)", r"\1 --tool cavity.tool.json --layers 1 --strategy plain --stock-cell 2\2"),
    (r"^\[options\]$", '[options]\nside = "+"'),
)
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


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_commands_of_a_tutorial_run(page, tmp_path):
    path = os.path.dirname(os.environ["FLANK_BINARY"]) + os.pathsep + os.environ["PATH"]
    for kind, text in blocks(page):
        text = text if kind == "python" else with_less(text)
        if kind == "toml":
            (tmp_path / "plan.toml").write_text(text)
            continue
        words = ["sh", "-ec", text] if kind == "sh" else [sys.executable, "-c", text]
        done = subprocess.run(words, cwd=tmp_path, env=dict(os.environ, PATH=path), capture_output=True, text=True)
        assert done.returncode == 0, f"{text}\n{done.stdout}\n{done.stderr}"
