"""Results as plain values: dicts for pandas and JSON, and faces as triangles with their error for a plot."""

import base64
import json
import pathlib
import tempfile

import numpy as np

from . import _core


def _plain(value):
    """Numbers, texts, lists and dicts of them."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if type(value).__module__.startswith("openflank"):
        return to_dict(value)
    return value


def to_dict(self):
    """All figures as numbers, texts, lists and dicts of them, by the names of the attributes; the text for a terminal is left out."""
    names = [name for name in dir(type(self)) if not name.startswith("_") and isinstance(getattr(type(self), name), property) and name != "text"]
    return {name: _plain(getattr(self, name)) for name in names}


def _result_dict(self):
    """The figures of summary.json as a dict, and those of the check under "report"."""
    return {**json.loads(self.summary_json), "report": to_dict(self.report)}


def _program_dict(self):
    """The figures of the program as a dict."""
    return json.loads(self.figures_json)


def _indices(text):
    """Indices of zigzag differences, 7 bits a byte."""
    out, before, value, shift = [], 0, 0, 0
    for byte in base64.b64decode(text):
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            before += -(value + 1) // 2 if value % 2 else value // 2
            out.append(before)
            value = shift = 0
    return np.array(out, dtype=np.int32).reshape(-1, 3)


def _body(body):
    low, high = np.asarray(body["box"])
    steps = np.frombuffer(base64.b64decode(body["positions"]), dtype="<u2").reshape(-1, 3)
    error = np.frombuffer(base64.b64decode(body["f_mm"]), dtype="<f4").astype(float) if "f_mm" in body else None
    return {"face": body["face"], "target": body["target"], "points": low + steps / 65535.0 * (high - low),
            "triangles": _indices(body["indices"]), "error_mm": error}


def error_triangles(self):
    """The faces of the part as triangles, those that are machined with their error: a list of dicts.

    Each has "face", "target", "points" (n x 3, mm), "triangles" (m x 3, indices of points) and "error_mm" (n, signed: minus is a
    gouge), which is None for a face that is not machined.
    """
    with tempfile.TemporaryDirectory(prefix="openflank-") as folder:
        self.write(folder)
        view = json.loads((pathlib.Path(folder) / "view.json").read_text(encoding="utf-8"))
    return [_body(body) for body in view["bodies"]]


def add_to_classes():
    for kind in (_core.VerifyReport, _core.FaceVerdict, _core.WorstPlace, _core.Verification):
        kind.to_dict = to_dict
    _core.Result.to_dict = _result_dict
    _core.Result.error_triangles = error_triangles
    _core.Program.to_dict = _program_dict
