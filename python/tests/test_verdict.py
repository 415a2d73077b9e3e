"""What the judge says no to, `passed` says no to, with the figure in `reasons`; and so do the files and the exit code."""

import json
import shutil

import pytest

import openflank


def lifted(data):
    """Every pose a millimetre along the tool's axis and across it."""
    for strip in data["strips"]:
        strip["poses"] = [[x + 1.0, y + 1.0, z + 1.0, *axis] for x, y, z, *axis in strip["poses"]]
    return data


def halved(data):
    for strip in data["strips"]:
        strip["poses"] = strip["poses"][:len(strip["poses"]) // 2]
    return data


def bent(data):
    return {**data, "min_bend_radius": 500.0}


CASES = {
    "sound": (None, None, {}, None),
    "overcut_mm": ("path.json", lifted, {}, "overcut_mm"),
    "coverage_reachable": ("path.json", halved, {}, "coverage_reachable"),
    "bend_radius": ("job.json", bent, {}, "bend_radius"),
    "clearance": (None, None, {"shank_length_mm": 1.0, "holder": "0:80,40:80", "clearance_mm": 1.0}, "clearance"),
}


@pytest.mark.parametrize("name", CASES)
def test_passed_is_the_judges_word(folder, flank, tmp_path, name):
    file, change, options, figure = CASES[name]
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    if file:
        (copy / "manifest.json").unlink()
        (copy / file).write_text(json.dumps(change(json.loads((copy / file).read_text()))))
    told = openflank.verify(copy, **options)
    written = json.loads((copy / "verify.json").read_text())
    assert told.passed == written["pass"] == (figure is None), told.reasons
    assert told.reasons == [(one["figure"], one["text"]) for one in written["reasons"]]
    assert told.cautions == [(one["figure"], one["text"]) for one in written["cautions"]]
    assert told.passed == (not told.reasons)
    if figure:
        assert figure in dict(told.reasons), told.reasons
    words = ["--shank-length", "1", "--holder", "0:80,40:80", "--clearance", "1"] if options else []
    flank("verify", copy, *words, "--quiet", codes=(0 if figure is None else 1,))
