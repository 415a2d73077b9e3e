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


def wheel(part, folder, *, tolerance_mm=0.05, unit=None, tool=None, coverage=0.97, effort="quick", sample_mm=None, holder=None,
          most_tools=2, rough=True, edges=True, blank=None, allowance_mm=0.5, most_engagement_deg=90.0, balance=None, machine=None,
          most_tilt_deg=100.0, hub=None, blades=(), splitters=(), count=None, progress=None):
    """Mills a whole wheel, as flank wheel does: plan.json as a dict (docs/schema/wheel.md). The results lie in the folder.

    part, unit
        A file, and the unit of a mesh: "mm", "cm", "m" or "in".
    tolerance_mm, coverage
        The tolerance, and the share of the accessible area of sides, edges, fillets and hub that must be within it.
    tool
        A tool.json, a family such as "cone:radius=0.6,angle=12", or "free". None: found for the wheel.
    effort
        How long each fit searches: "quick", "normal" or "thorough".
    sample_mm
        Spacing of a fast check without the proof; None: samples and a proof.
    holder
        Outline of the holder as "z:r,z:r,...", height above its face and radius, mm, or a file of such pairs: shanks are
        as long as it needs. None: not checked.
    most_tools
        2: a larger tool roughs where one fits between the blades. 1: the tool that finishes roughs, too.
    rough, edges
        False leaves out the roughing, or the edges.
    blank, allowance_mm
        A closed body in the part's place, as a file. None: turned about the part, with this allowance.
    most_engagement_deg
        The largest engagement of the tool while roughing, by trochoidal cycles: 90 is half of its width.
    balance
        How far roughing lets a blade stand free on one side alone, in thicknesses of the thinnest blade. None: any.
    machine
        A name or a file NAME.toml: no pass of the tip tilts the part further than it does.
    most_tilt_deg
        The largest angle between the tool and the wheel's axis on passes of the tip: as far as the machine tilts the part.
    hub, blades, splitters, count
        Roles of the faces: "F1"; one list of faces for each blade; number of equal sectors in a whole turn. Default: found.
    progress
        Called as progress(stage, share).

    Raises UsageError, and InputError for a part that is no wheel.
    """
    request = _core.WheelRequest()
    given = {"part": os.fspath(part), "folder": os.fspath(folder), "tolerance_mm": tolerance_mm, "unit": unit,
             "tool": None if tool is None else os.fspath(tool), "coverage": coverage, "effort": effort, "sample_mm": sample_mm,
             "holder": None if holder is None else os.fspath(holder), "most_tools": most_tools, "rough": rough, "edges": edges,
             "blank": None if blank is None else os.fspath(blank), "allowance_mm": allowance_mm,
             "most_engagement_deg": most_engagement_deg, "balance": balance,
             "machine": None if machine is None else os.fspath(machine), "most_tilt_deg": most_tilt_deg,
             "hub": hub, "blades": list(blades), "splitters": list(splitters), "count": count}
    for name, value in given.items():
        setattr(request, name, value)
    text, stopped_by = _core.mill_wheel(request, progress)
    if stopped_by is not None:
        raise stopped_by
    return json.loads(text)
