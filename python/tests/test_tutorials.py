"""The commands of the tutorials and of README.md run as they stand: those of one page in one folder, one after the other, and each ends
with the exit code that stands beside it (`# exit 1`), else with 0. What takes a minute is asked for less: options are added, and
nothing is left out. README.md says of some lines what they need: of these, the options are looked at alone. The
fit with which several pages begin is made by the first of them alone."""

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
    (r"^(flank fit blisk\.step .*?)( +#|$)", r"\1 --check-faces F1\2"),
    (r"^(flank trochoid .*?)( +#|$)", r"\1 --tool cavity.tool.json --layers 1 --strategy plain --stock-cell 2\2"),
)
FIRST_FIT = "flank fit blade.step --face F1 --tolerance 0.1 -o out"
PAGES = sorted((ROOT / "docs/tutorials").glob("*.md"))
README = (ROOT / "README.md").read_text()
# A comment of README.md that begins so is of a line that is not run here.
NEEDS = re.compile(r"# needs [^:]+: ")


def blocks(page):
    return re.findall(r"```(sh|toml|python)\n(.*?)```", page.read_text(), re.DOTALL)


def with_less(text):
    for line, less in LESS:
        text = re.sub(line, less, text, flags=re.MULTILINE)
    return text


def lines(text):
    """(command, exit code) of each line."""
    for line in text.splitlines():
        code = re.search(r"# exit (\d)", line)
        if line.strip():
            yield line.split(" #")[0].strip(), int(code[1]) if code else 0


def readme_lines():
    """Those of the command; `make` is for .ci/run."""
    text = "".join(block for _, block in re.findall(r"```(sh)\n(.*?)```", README, re.DOTALL))
    return [line for line in text.splitlines() if line.startswith("flank ")]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Runs a command in a folder; the result of FIRST_FIT is kept once a page has made it."""
    kept = tmp_path_factory.mktemp("first") / "out"
    path = os.path.dirname(os.environ["FLANK_BINARY"]) + os.pathsep + os.environ["PATH"]

    def run(words, folder, code=0):
        if words[-1] == FIRST_FIT:
            copy = f"cp -r {shlex.quote(str(kept))} out" if kept.exists() else f"{FIRST_FIT} && cp -r out {shlex.quote(str(kept))}"
            words = [*words[:-1], copy]
        done = subprocess.run(words, cwd=folder, env=dict(os.environ, PATH=path), capture_output=True, text=True)
        assert done.returncode == code, f"exit {done.returncode}, not {code}: {words[-1]}\n{done.stdout}\n{done.stderr}"
        return done.stdout

    return run


def test_there_are_tutorials_and_commands_in_them():
    assert len(PAGES) >= 7
    assert sum(len(blocks(page)) for page in PAGES) >= 15


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_commands_of_a_tutorial_run(page, tmp_path, run):
    for kind, text in blocks(page):
        text = with_less(text)
        if kind == "toml":
            (tmp_path / "plan.toml").write_text(text)
        elif kind == "python":
            run([sys.executable, "-c", text], tmp_path)
        else:
            # One by one: a code that is not the one that stands there is noticed, also where it is 0.
            for command, code in lines(text):
                run(["sh", "-c", command], tmp_path, code)


def test_the_commands_of_the_readme_run(tmp_path, run):
    quick = [line for line in readme_lines() if not NEEDS.search(line)]
    assert len(quick) >= 15
    for command, code in lines("\n".join(quick)):
        run(["sh", "-c", command], tmp_path, code)


def test_every_command_of_the_readme_knows_its_options_and_names_its_part_and_tolerance(tmp_path, run):
    helps = {}
    made = set(re.findall(r"^flank example .*?-o (\S+)", "\n".join(readme_lines()), re.MULTILINE))
    for line in readme_lines():
        words = shlex.split(line.split(" #")[0])
        assert words[0] == "flank" and " # " in line, line
        if words[1] not in helps:
            helps[words[1]] = run(["flank", words[1], "--help"], tmp_path)
        for option in words[2:]:
            if option.startswith("-") and not option[1:2].isdigit():
                assert re.search(rf"(^|[\s,]){re.escape(option)}\b", helps[words[1]]), f"{option} is no option of flank {words[1]}"
        if words[1] in ("fit", "cover", "trochoid", "design"):
            assert words[2] in made, f"{words[2]} is made by no line"
            assert "--tolerance" in words, line
