"""sweep and design: the same tables as those of the commands."""

import json
import os

import pytest

import openflank

PLAN = """
schema = "openflank/sweep-plan/1"
command = "cover"
part = "side.step"
faces = ["F1"]
tools = ["cylinder:radius=4", "cylinder:radius=6"]

[options]
tolerance_mm = 0.5
strips = 1
side = "-"
sample_mm = 3.0
"""


@pytest.fixture(autouse=True)
def command(monkeypatch):
    monkeypatch.setenv("FLANK_COMMAND", os.environ["FLANK_BINARY"])


@pytest.fixture
def side(flank, tmp_path):
    file = tmp_path / "side.step"
    flank("example", "elliptic-side", "-o", file)
    return file


def test_the_command_must_be_there(monkeypatch, tmp_path):
    monkeypatch.setenv("FLANK_COMMAND", "no-such-flank")
    with pytest.raises(openflank.InputError, match="no-such-flank: is no command on the path"):
        openflank.sweep(tmp_path / "plan.toml", tmp_path / "out")


def test_what_the_command_refuses_is_raised(tmp_path):
    with pytest.raises(openflank.InputError, match="plan.toml: cannot be read"):
        openflank.sweep(tmp_path / "plan.toml", tmp_path / "out")
    with pytest.raises(openflank.UsageError, match="toleranze_mm: is no field of design; expected part, "):
        openflank.design(tmp_path / "side.step", tmp_path / "out", toleranze_mm=1)


def test_sweep_gives_the_table_of_the_command(side, tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN)
    answer = openflank.sweep(tmp_path / "plan.toml", tmp_path / "out", processes=1)
    assert answer == json.loads((tmp_path / "out" / "sweep.json").read_text())
    assert len(answer["tasks"]) == 2


def test_design_gives_the_table_of_the_command(flank, side, tmp_path):
    stages = []
    given = {"faces": "F1", "source": "fit", "shape": "cylinder", "tolerance_mm": 2.0, "side": -1, "avoid": False, "sample_mm": 3.0}
    answer = openflank.design(side, tmp_path / "python", progress=lambda stage, share: stages.append(share), **given)
    assert answer == json.loads((tmp_path / "python" / "design.json").read_text())
    flank("design", side, "--faces", "F1", "--source", "fit", "--shape", "cylinder", "--tolerance", "2", "--side", "-", "--avoid", "off",
          "--sample", "3", "-o", tmp_path / "command")
    assert (tmp_path / "command" / "design.json").read_bytes() == (tmp_path / "python" / "design.json").read_bytes()
    assert stages == sorted(stages) and stages[-1] <= 1.0


def test_what_progress_raises_ends_the_command(side, tmp_path):
    def stop(stage, share):
        raise ZeroDivisionError
    with pytest.raises(ZeroDivisionError):
        openflank.design(side, tmp_path / "out", progress=stop, faces="F1", tolerance_mm=0.01)
