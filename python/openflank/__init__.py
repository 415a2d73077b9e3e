"""OpenFlank: finds milling tools and five-axis motions whose flank finishes a free-form surface, and checks them.

Lengths are in millimetres, points in the frame of the part, poses rows (x, y, z, i, j, k): the tip and the unit vector towards the
holder. The functions fit, cover, trochoid, verify, post, report, inspect, example and wheel do what the commands of these names do, with the
same bytes.
"""

from . import _data, _show
from ._core import (
    Envelope, Error, Face, FaceVerdict, Footpoints, InputError, InternalError, JobField, Part, Path, Program, Result,
    RuledMotion, Samples, Strip, SweptDistances, Target, Tool, UsageError, Verification, VerifyReport, WorstPlace, __version__,
    job_fields, judge, read_part, set_thread_count, swept_distances, thread_count)
from ._commands import example, examples, inspect, machine, machines, wheel
from ._jobs import Interrupted, cover, fit, post, report, trochoid, verify
from ._tasks import design, sweep

__all__ = [
    "Envelope", "Error", "Face", "FaceVerdict", "Footpoints", "InputError", "InternalError", "Interrupted", "JobField", "Part",
    "Path", "Program", "Result", "RuledMotion", "Samples", "Strip", "SweptDistances", "Target", "Tool", "UsageError",
    "Verification", "VerifyReport", "WorstPlace", "cover", "design", "example", "examples", "fit", "inspect", "job_fields", "judge",
    "machine", "machines", "post", "read_part", "report", "set_thread_count", "sweep", "swept_distances", "thread_count", "trochoid",
    "verify", "wheel"]

for _name in __all__:
    _thing = globals()[_name]
    if getattr(_thing, "__module__", "").startswith("openflank."):
        try:
            _thing.__module__ = "openflank"
        except AttributeError:  # of a built-in function
            pass
del _name, _thing

_data.add_to_classes()
_show.add_to_classes()
