"""The notebook of the docs runs, cell by cell."""

import importlib.util
import json
import pathlib

import numpy as np
import openflank

NOTEBOOK = pathlib.Path(__file__).resolve().parents[2] / "docs/tutorials/study.ipynb"


def cells():
    return ["".join(cell["source"]) for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]


def test_every_cell_runs(monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    names = {}
    for cell in cells():
        if "matplotlib" in cell and importlib.util.find_spec("matplotlib") is None:
            continue
        exec(compile(cell, str(NOTEBOOK), "exec"), names)
    assert len(names["rows"]) == 3 and all(row["passed"] for row in names["rows"])
    check_values(names["results"][0.1], names["face"])


def check_values(result, face):
    """Dicts are plain values, and the triangles have the error that the report tells."""
    told = result.to_dict()
    assert json.loads(json.dumps(told)) == told
    assert told["report"]["faces"][0]["face"] == "F1" and told["pass"] is True
    assert face["points"].shape[1] == 3 and face["triangles"].max() < len(face["points"]) == len(face["error_mm"])
    assert abs(max(0.0, -face["error_mm"].min()) - result.report.overcut_mm) < 0.1 * result.report.tolerance_mm
    assert np.isfinite(face["error_mm"]).all() and isinstance(openflank.VerifyReport.to_dict(result.report), dict)
