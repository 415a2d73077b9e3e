"""The same input gives the same bytes as the command."""

import json
import pathlib
import shutil

import pytest
import openflank


def bytes_of(folder):
    """All files; the manifest without the name of the folder that the result was written to."""
    files = {file.name: file.read_bytes() for file in pathlib.Path(folder).iterdir()}
    manifest = json.loads(files.pop("manifest.json"))
    del manifest["folder"]
    return files, manifest


def test_fit_writes_what_the_command_writes(flank, blade, folder, tmp_path):
    flank("fit", blade, "--face", "F1", "--side", "+", "--tolerance", "0.1", "-o", tmp_path / "out")
    ours, theirs = bytes_of(folder), bytes_of(tmp_path / "out")
    assert sorted(ours[0]) == sorted(theirs[0])
    assert "tool.json" in ours[0] and "view.json" in ours[0]
    assert ours == theirs


def test_cover_writes_what_the_command_writes(flank, blade, tmp_path):
    tool, part = "cylinder:radius=6", tmp_path / "side.step"
    flank("example", "elliptic-side", "-o", part)
    flank("cover", part, "--tool", tool, "--axis-length", 45, "--tolerance", 0.3, "--strips", 3, "--side", "-", "-o", tmp_path / "command")
    openflank.cover(part, tool, axis_length_mm=45, tolerance_mm=0.3, strips=3, side="-").write(tmp_path / "python")
    assert bytes_of(tmp_path / "python") == bytes_of(tmp_path / "command")


def test_verify_and_report_leave_what_the_command_leaves(flank, folder, tmp_path):
    kept = tmp_path / "out"
    found = {}
    for who in ("command", "python"):
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(folder, kept)
        if who == "command":
            flank("verify", kept, "--tolerance", "0.2")
            flank("report", kept)
        else:
            assert openflank.verify(kept, tolerance_mm=0.2).report.tolerance_mm == 0.2
            assert openflank.report(kept) == kept / "report.html"
        found[who] = bytes_of(kept)
    assert "report.html" in found["python"][0]
    assert found["python"] == found["command"]


def test_post_makes_the_program_of_the_command(flank, folder, tmp_path):
    flank("post", folder, "--machine", "linuxcnc-xyzac-trt", "--spindle", 8000, "--feed", 800, "-o", tmp_path / "blade.ngc")
    program = openflank.post(folder, "linuxcnc-xyzac-trt", spindle=8000, feed_mm_min=800)
    assert program.program == (tmp_path / "blade.ngc").read_text()
    assert program.passed and program.poses > 10 and program.machine == "linuxcnc-xyzac-trt"


def test_a_post_without_a_spindle_is_asked_for(folder):
    with pytest.raises(openflank.UsageError, match="spindle"):
        openflank.post(folder, "linuxcnc-xyzac-trt", feed_mm_min=800)
    assert "DRY RUN" in openflank.post(folder, "linuxcnc-xyzac-trt", dry=True).program


def test_the_summary_is_that_of_the_command(fitted, folder):
    assert fitted.summary_json == (folder / "summary.json").read_text()
    assert fitted.tool.to_json() == (folder / "tool.json").read_text()
    assert fitted.path.to_json() == (folder / "path.json").read_text()
