"""The commands that look and answer: what they print with --json, as values."""

import json
import os

from . import _core


def inspect(part, unit=None, sort="", type=""):
    """The faces of a part, as flank inspect --json has them: a dict.

    part
        A part that was read, or a file.
    unit
        Of a mesh: "mm", "cm", "m" or "in".
    sort
        "face", "area" (largest first), "radius" (tightest concave first) or "type".
    type
        Only faces of this type: "plane", "B-spline".

    Raises UsageError and InputError.
    """
    if not isinstance(part, _core.Part):
        part = _core.read_part(os.fspath(part), unit)
    return json.loads(_core.inspect_json(part, sort, type))


def example(name, file, seed=1):
    """Writes a part that the library makes itself, and its truth where it is known, as flank example does: a dict with the files.

    Raises UsageError for an unknown name, and lists the known ones; InputError if it cannot be written.
    """
    return json.loads(_core.example_json(name, os.fspath(file), seed))


def examples():
    """The names that example knows."""
    return list(_core.example_names())


def machines():
    """Name, nesting and description of each machine that comes with the library: a list of dicts. Raises InputError."""
    return json.loads(_core.machine_list_json())["machines"]


def machine(name):
    """Joints, limits and control of a machine, by its name or its file: a dict, as flank machine --json has it. Raises InputError."""
    return json.loads(_core.machine_json(os.fspath(name)))
