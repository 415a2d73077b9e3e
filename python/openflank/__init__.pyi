import os
from typing import Any, Callable, Literal, Sequence, Union

import numpy as np
import numpy.typing as npt

__version__: str
__all__: list[str]

_File = Union[str, os.PathLike[str]]
_Doubles = npt.NDArray[np.float64]
_Progress = Callable[[str, float], object]

class Error(RuntimeError):
    field: str

class UsageError(Error, ValueError): ...
class InputError(Error): ...
class InternalError(Error): ...

class Interrupted(KeyboardInterrupt):
    result: Result
    def __init__(self, result: Result) -> None: ...

class Tool:
    def __init__(self, family: str, axis_length_mm: float, shank: npt.ArrayLike = ..., holder: npt.ArrayLike = ...,
                 **parameters: float) -> None: ...
    @staticmethod
    def spline(axis_length_mm: float, coefficients: npt.ArrayLike, name: str = 'spline') -> Tool:
        """A tool whose r(s) is a clamped cubic B-spline with equal knots over [0, L]; coefficients (n,), n >= 4, mm. Raises InputError if it is no tool."""
    @staticmethod
    def load(file: _File) -> Tool:
        """Reads a tool.json. Raises InputError naming file and key."""
    @staticmethod
    def from_json(text: str) -> Tool:
        """The tool of a tool.json's text. Raises InputError naming the key."""
    def save(self, file: _File) -> None:
        """Writes a tool.json, whole or not at all. Raises InputError."""
    def to_json(self) -> str:
        """The text of tool.json; its numbers are read back exactly."""
    def radius(self, s: npt.ArrayLike) -> _Doubles:
        """r(s), mm, for an array of arc lengths s, mm; in the shape of s."""
    def slope(self, s: npt.ArrayLike) -> _Doubles:
        """r'(s) for an array of arc lengths s, mm; in the shape of s."""
    def meridian(self, count: int = 201) -> _Doubles:
        """Profile of the flank, count x 2: z along the axis from s = 0, distance from it; mm, at equal steps of s."""
    @property
    def name(self) -> str:
        """Name of the tool."""
    @property
    def family(self) -> str:
        """"cylinder", "cone", ..., "spline"."""
    @property
    def axis_length_mm(self) -> float:
        """Length L of the axis, mm."""
    @property
    def parameters(self) -> dict[str, float]:
        """Parameters of the family by name: mm, angles in degrees. Empty for a spline."""
    @property
    def coefficients(self) -> _Doubles:
        """Parameters in the family's order, of a spline its coefficients (n,): mm, angles in radians. No copy."""
    @property
    def shank(self) -> _Doubles:
        """Profile of the shank, N x 2: z along the axis from s = 0, radius; mm. No copy."""
    @property
    def holder(self) -> _Doubles:
        """Profile of the holder, N x 2: z along the axis from s = 0, radius; mm. No copy."""
    @property
    def smallest_radius_mm(self) -> float:
        """Smallest radius of an inscribed sphere, mm; exact."""
    @property
    def largest_radius_mm(self) -> float:
        """Largest radius of an inscribed sphere, mm; exact."""
    @property
    def slenderness(self) -> float:
        """Length over the diameter of the cylinder that bends as much."""
    @property
    def deflection_um(self) -> float:
        """Deflection of the tip under 100 N, in cemented carbide, micrometres."""
    def __eq__(self, other: object) -> bool: ...
    def __getstate__(self) -> str: ...
    def __setstate__(self, state: str) -> None: ...
    def _repr_svg_(self) -> str: ...

class Footpoints:
    @property
    def points(self) -> _Doubles:
        """N x 3, mm, on the target. No copy."""
    @property
    def normals(self) -> _Doubles:
        """N x 3, unit, towards the machining side. No copy."""
    @property
    def distances_mm(self) -> _Doubles:
        """(N,), mm, signed: negative on the material's side. No copy."""
    @property
    def k1(self) -> _Doubles:
        """(N,), 1/mm: the smaller principal curvature, positive where the target bends towards the machining side."""
    @property
    def k2(self) -> _Doubles:
        """(N,), 1/mm: the larger principal curvature. No copy."""
    @property
    def uv(self) -> _Doubles:
        """N x 2: surface parameters. No copy."""
    @property
    def patch(self) -> npt.NDArray[np.int32]:
        """(N,): index of the target's face, or triangle."""

class Samples:
    @property
    def points(self) -> _Doubles:
        """N x 3, mm. No copy."""
    @property
    def normals(self) -> _Doubles:
        """N x 3, unit, towards the machining side. No copy."""
    @property
    def areas_mm2(self) -> _Doubles:
        """(N,), mm^2: the share of the area that each stands for. No copy."""

class Target:
    @property
    def area_mm2(self) -> float:
        """Area, mm^2."""
    @property
    def diagonal_mm(self) -> float:
        """Diagonal of the bounding box, mm."""
    @property
    def box(self) -> _Doubles:
        """Lowest and highest corner, 2 x 3, mm."""
    def closest(self, points: npt.ArrayLike) -> Footpoints:
        """The globally closest point for each of N x 3 points, mm."""
    def samples(self, spacing_mm: float) -> Samples:
        """Samples about spacing_mm apart, in a fixed order."""

class Face:
    @property
    def id(self) -> str:
        """"F1", or "F1a" for a piece."""
    @property
    def type(self) -> str:
        """plane, cylinder, B-spline, ... as the file has it; mesh; not read."""
    @property
    def left_out(self) -> str:
        """Why the face could not be read; empty if it could."""
    @property
    def area_mm2(self) -> float:
        """Area inside its trims, mm^2."""
    @property
    def box(self) -> _Doubles:
        """Lowest and highest corner, 2 x 3, mm."""
    @property
    def trims(self) -> int:
        """Closed loops that trim it; 0: the whole parameter rectangle, or a mesh."""
    @property
    def of_solid(self) -> bool:
        """Whether it bounds a solid; else its normal says nothing about where the material is."""
    @property
    def degree(self) -> tuple[int, int]:
        """Degrees of the B-spline along u and v."""
    @property
    def poles(self) -> _Doubles:
        """Control points, n_u x n_v x 3, mm. No copy."""
    @property
    def weights(self) -> _Doubles:
        """Weights, n_u x n_v; 0 x 0: polynomial. No copy."""
    @property
    def knots_u(self) -> _Doubles:
        """Knots along u, (n_u + degree + 1,). No copy."""
    @property
    def knots_v(self) -> _Doubles:
        """Knots along v, (n_v + degree + 1,). No copy."""
    def points(self, uv: npt.ArrayLike) -> _Doubles:
        """Points of the surface at parameters N x 2: N x 3, mm; also outside the trims."""
    def normals(self, uv: npt.ArrayLike) -> _Doubles:
        """Unit normals at parameters N x 2: N x 3, away from the material if the face bounds a solid."""

class Part:
    @property
    def file(self) -> str:
        """Name of the file."""
    @property
    def sha256(self) -> str:
        """SHA-256 of the file, 64 hexadecimal digits."""
    @property
    def format(self) -> str:
        """Format of the file: STEP, STL, ..."""
    @property
    def unit(self) -> str:
        """Unit of the file: mm, cm, m or in."""
    @property
    def solids(self) -> int:
        """Number of solids."""
    @property
    def repairs(self) -> list[str]:
        """What was repaired, one sentence each."""
    @property
    def is_mesh(self) -> bool:
        """Whether the part is a mesh."""
    @property
    def box(self) -> _Doubles:
        """Lowest and highest corner of the bounding box, 2 x 3, mm; tight."""
    @property
    def faces(self) -> list[Face]:
        """The faces F1, F2, ... in the order of the file."""
    @property
    def vertices(self) -> _Doubles:
        """Vertices of a mesh: N x 3, mm. No copy."""
    @property
    def triangles(self) -> npt.NDArray[np.int32]:
        """Triangles of a mesh: indices of vertices, M x 3, counter-clockwise seen from the machining side. No copy."""
    def __getitem__(self, id: str) -> Face: ...
    def target(self, faces: str, side: int = 1) -> Target:
        """The target of faces such as "F1,F3-F5"; side -1: machined from the other side of their normals. Raises InputError."""
    def _repr_html_(self) -> str: ...

def read_part(file: _File, unit: str | None = None, pieces: str = '') -> Part:
    """Reads a STEP, IGES, BREP, STL, OBJ or PLY file. unit ("mm", "cm", "m", "in") is required for a mesh, whose file has none. pieces: faces to be split into sides and edges, "F1a". Raises InputError naming the file and what would be accepted."""

class Strip:
    @property
    def id(self) -> int:
        """Number of the pass."""
    @property
    def kind(self) -> str:
        """flank, side, front, back, entry, link, ..."""
    @property
    def layer(self) -> int:
        """Layer of a cavity, from 1 at the top; 0: no layer."""
    @property
    def face(self) -> str:
        """The machined faces, "F1" or "F1,F3"."""
    @property
    def poses(self) -> _Doubles:
        """N x 6: tip x, y, z, mm, and unit vector i, j, k towards the holder. No copy."""
    def __len__(self) -> int: ...

class Path:
    def __init__(self, strips: Sequence[npt.ArrayLike], face: str = ..., kind: str = ...) -> None: ...
    @staticmethod
    def load(file: _File) -> Path:
        """Reads a path.json. Raises InputError naming file, pass and CL point."""
    @staticmethod
    def from_json(text: str) -> Path:
        """The path of a path.json's text. Raises InputError naming pass and CL point."""
    def save(self, file: _File) -> None:
        """Writes a path.json, completely or not at all. Raises InputError."""
    def to_json(self) -> str:
        """The text of path.json; its numbers are read back exactly."""
    @property
    def strips(self) -> list[Strip]:
        """The passes."""
    @property
    def pose_count(self) -> int:
        """Number of CL points of all passes."""
    def __len__(self) -> int: ...

class Envelope:
    @property
    def points(self) -> _Doubles:
        """count_t x count_s x 3, mm. No copy."""
    @property
    def normals(self) -> _Doubles:
        """count_t x count_s x 3, unit, from the axis to the contact point. No copy."""
    @property
    def c(self) -> _Doubles:
        """count_t x count_s: axial slip c; a contact exists where |c| < 1. No copy."""

class RuledMotion:
    def __init__(self, tip_poles: npt.ArrayLike, direction_poles: npt.ArrayLike, axis_length_mm: float) -> None: ...
    @property
    def axis_length_mm(self) -> float:
        """Length of the axis, mm."""
    @property
    def tip_poles(self) -> _Doubles:
        """Control points of the tip rail, n x 3, mm. No copy."""
    @property
    def direction_poles(self) -> _Doubles:
        """Control points of the direction rail, n x 3. No copy."""
    def poses(self, t: npt.ArrayLike) -> _Doubles:
        """CL points at times t (N,) in [0, 1]: N x 6, tip (mm) and unit vector towards the holder."""
    def sample(self, chord_tolerance_mm: float = 0.0001) -> _Doubles:
        """CL points N x 6, so dense that the chord error is at most chord_tolerance_mm: proved."""
    def envelope(self, tool: Tool, side: int = 1, count_t: int = 101, count_s: int = 101) -> Envelope:
        """Contact points of the tool under this motion, at equal steps of t and s; side +1 or -1 of the axis."""

class SweptDistances:
    @property
    def f_mm(self) -> _Doubles:
        """(N,), mm; negative: gouge, positive: excess material. A view, not a copy."""
    @property
    def strip(self) -> npt.NDArray[np.int32]:
        """(N,): index of the pass, from 0; -1: the tool comes nowhere within horizon_mm. No copy."""
    @property
    def t(self) -> _Doubles:
        """(N,): index of the CL point, and fraction. No copy."""
    @property
    def s(self) -> _Doubles:
        """(N,), mm: arc length on the axis, in [0, L]. No copy."""

def swept_distances(tool: Tool, path: Path, points: npt.ArrayLike, horizon_mm: float = ...) -> SweptDistances:
    """f(x) = least distance, over the whole path, from x to the tool: for N x 3 points, mm. Exact to about 1e-9 mm up to horizon_mm. Raises InputError for an invalid tool or invalid CL points."""

class FaceVerdict:
    @property
    def face(self) -> str:
        """"F1"."""
    @property
    def target(self) -> bool:
        """Whether the face is machined; else it is a check surface."""
    @property
    def area_mm2(self) -> float:
        """Area, mm^2."""
    @property
    def copies(self) -> int:
        """Equal faces that it stands for in the coverage of all, itself among them."""
    @property
    def overcut_mm(self) -> float:
        """Deepest gouge found, mm."""
    @property
    def overcut_bound_mm(self) -> float:
        """Proved bound of the gouge, mm."""
    @property
    def undercut_mm(self) -> float:
        """Most excess material, mm (machined faces only)."""
    @property
    def rms_mm(self) -> float:
        """RMS of f, mm, where a pass goes over the face."""
    @property
    def coverage(self) -> float:
        """Finished share of the area: |f| <= tolerance."""
    @property
    def coverage_reachable(self) -> float:
        """Finished share of the accessible area."""
    def to_dict(self) -> dict[str, Any]:
        """All figures as numbers, texts, lists and dicts of them, by the names of the attributes; the text for a terminal is left out."""

class WorstPlace:
    @property
    def face(self) -> str:
        """"F1"."""
    @property
    def point(self) -> _Doubles:
        """(3,), mm. No copy."""
    @property
    def f_mm(self) -> float:
        """mm, negative."""
    @property
    def strip(self) -> int:
        """0-based."""
    @property
    def t(self) -> float:
        """Index of the CL point, and fraction."""
    @property
    def s(self) -> float:
        """Arc length on the axis, mm."""
    def to_dict(self) -> dict[str, Any]:
        """All figures as numbers, texts, lists and dicts of them, by the names of the attributes; the text for a terminal is left out."""

class VerifyReport:
    @property
    def verdict(self) -> Literal["pass", "overcut", "gouge", "unproved", "not run"]:
        """pass, overcut, gouge, unproved or not run."""
    @property
    def tolerance_mm(self) -> float:
        """mm."""
    @property
    def allowance_mm(self) -> float:
        """mm left on purpose: every error is measured from the faces moved out by this."""
    @property
    def coverage(self) -> float:
        """Finished share of the machined faces: |f| <= tolerance."""
    @property
    def coverage_reachable(self) -> float:
        """Finished share of the accessible area."""
    @property
    def reachable_share(self) -> float:
        """Share of the area that is accessible."""
    @property
    def overcut_mm(self) -> float:
        """Deepest gouge found in a machined face, mm."""
    @property
    def overcut_bound_mm(self) -> float:
        """Proved bound of the gouge of machined faces, mm."""
    @property
    def undercut_mm(self) -> float:
        """Most excess material on a machined face, mm."""
    @property
    def rms_mm(self) -> float:
        """RMS of f, mm, where a pass goes over the face."""
    @property
    def gouge_mm(self) -> float:
        """Deepest gouge found in a check surface, mm."""
    @property
    def gouge_bound_mm(self) -> float:
        """Proved bound of the gouge of check surfaces, mm."""
    @property
    def faces(self) -> list[FaceVerdict]:
        """The figures of each face."""
    @property
    def largest_turn_deg(self) -> float | None:
        """Largest change of the motion's direction within 1 % of the face's diagonal, degrees; None if not measured."""
    @property
    def unread_faces(self) -> list[tuple[str, str]]:
        """Faces of the file that could not be read and so were not checked, each with its reason."""
    @property
    def worst(self) -> list[WorstPlace]:
        """The deepest places, over all faces."""
    @property
    def histogram_edges_mm(self) -> _Doubles:
        """Edges of the bins of f over the machined faces, mm. No copy."""
    @property
    def histogram_area_mm2(self) -> _Doubles:
        """Area of each bin, mm^2. No copy."""
    def _repr_html_(self) -> str: ...
    def to_dict(self) -> dict[str, Any]:
        """All figures as numbers, texts, lists and dicts of them, by the names of the attributes; the text for a terminal is left out."""

def judge(tool: Tool, path: Path, part: Part, faces: str, tolerance_mm: float, check_faces: str = '',
          spacing_mm: float = 1.0) -> VerifyReport:
    """Checks tool and path on faces ("F1,F3") of a part at samples spacing_mm apart, mm, with a proved bound of every gouge. Raises UsageError and InputError."""

class Result:
    @property
    def tool(self) -> Tool:
        """The tool."""
    @property
    def path(self) -> Path:
        """The path."""
    @property
    def motions(self) -> list[RuledMotion]:
        """The motion of each pass of the path; of a cavity, those of the two side paths."""
    @property
    def report(self) -> VerifyReport:
        """The figures of the check."""
    @property
    def notes(self) -> list[str]:
        """Notes: repairs of the part, warnings."""
    @property
    def complete(self) -> bool:
        """False: the run was stopped early, and the result is unfinished."""
    @property
    def part_sha256(self) -> str:
        """SHA-256 of the part's file."""
    @property
    def chord_bound_mm(self) -> float:
        """Proved bound of the chord error, mm: the distance of the motions from the lines that join the CL points."""
    @property
    def largest_c(self) -> float:
        """Largest axial slip |c| where the tool touches the face; at 1 it moves along its own axis."""
    @property
    def passed(self) -> bool:
        """Whether the result meets the request."""
    @property
    def reasons(self) -> list[tuple[str, str]]:
        """Why it does not meet the request: pairs (figure of verify.json, sentence). Empty if it does."""
    @property
    def cautions(self) -> list[tuple[str, str]]:
        """Cautions, which do not change the verdict: pairs (figure, sentence)."""
    @property
    def text(self) -> str:
        """The summary as a table for a terminal."""
    @property
    def summary_json(self) -> str:
        """The text of summary.json."""
    def write(self, folder: _File) -> None:
        """Writes all files of the result into a folder, all or none, as the command does. Raises InputError."""
    def _repr_html_(self) -> str: ...
    def to_dict(self) -> dict[str, Any]:
        """The figures of summary.json as a dict, and those of the check under "report"."""
    def error_triangles(self) -> list[dict[str, Any]]:
        """The faces of the part as triangles, those that are machined with their error: a list of dicts.

        Each has "face", "target", "points" (n x 3, mm), "triangles" (m x 3, indices of points) and "error_mm" (n, signed: minus is a
        gouge), which is None for a face that is not machined.
        """

class Verification:
    @property
    def report(self) -> VerifyReport:
        """The figures of the check."""
    @property
    def notes(self) -> list[str]:
        """Warnings."""
    @property
    def passed(self) -> bool:
        """Whether the result meets the request."""
    @property
    def reasons(self) -> list[tuple[str, str]]:
        """Why it does not meet the request: pairs (figure of verify.json, sentence). Empty if it does."""
    @property
    def cautions(self) -> list[tuple[str, str]]:
        """Cautions, which do not change the verdict: pairs (figure, sentence)."""
    @property
    def text(self) -> str:
        """The verdict as a table for a terminal."""
    def to_dict(self) -> dict[str, Any]:
        """All figures as numbers, texts, lists and dicts of them, by the names of the attributes; the text for a terminal is left out."""

class Program:
    @property
    def program(self) -> str:
        """Text of the program; empty if it does not pass and force is not set."""
    @property
    def machine(self) -> str:
        """Name of the machine."""
    @property
    def setup(self) -> str:
        """Set-up of the part on the table: x,y,z,a,b,c; mm, degrees."""
    @property
    def poses(self) -> int:
        """Number of CL points of the passes."""
    @property
    def moves(self) -> int:
        """Number of blocks that move the tool."""
    @property
    def deviation_mm(self) -> float:
        """Proved bound of the control's deviation from the path, mm."""
    @property
    def minutes(self) -> float:
        """Machining time."""
    @property
    def notes(self) -> list[str]:
        """Warnings."""
    @property
    def passed(self) -> bool:
        """Whether its links neither gouge nor collide, and the rounding of its numbers keeps the tolerance."""
    @property
    def reasons(self) -> list[tuple[str, str]]:
        """Why it does not pass: pairs (figure, sentence)."""
    @property
    def cautions(self) -> list[tuple[str, str]]:
        """Cautions, which do not change the verdict: pairs (figure, sentence)."""
    @property
    def text(self) -> str:
        """The figures as a table for a terminal."""
    @property
    def figures_json(self) -> str:
        """The figures as JSON."""
    def to_dict(self) -> dict[str, Any]:
        """The figures of the program as a dict."""

class JobField:
    @property
    def name(self) -> str:
        """The keyword, with its unit: tolerance_mm."""
    @property
    def option(self) -> str:
        """Name on the command line: --tolerance."""
    @property
    def unit(self) -> str:
        """Unit: mm, mm/min; empty: none."""
    @property
    def group(self) -> str:
        """Group of the help text; empty: the first."""
    @property
    def help(self) -> str:
        """What the field means."""
    @property
    def accepted(self) -> str:
        """Values that it takes; empty: any."""
    @property
    def kind(self) -> Literal["text", "texts", "number", "count", "auto or count", "sign", "switch"]:
        """Kind of value: text, texts, number, count, auto or count, sign, switch."""
    @property
    def needed(self) -> bool:
        """Whether it has no default and must be given."""
    @property
    def usual(self) -> str | None:
        """The default as a text; None: not set."""

def job_fields(command: str) -> list[JobField]:
    """The table of fields of fit, cover, trochoid, verify, post or design."""
def report(folder: _File, file: _File | None = None) -> os.PathLike[str]:
    """Writes the HTML page of a folder of results: report.html in it, or the file. The page's path. Raises InputError."""
def set_thread_count(threads: int) -> None:
    """Sets the number of threads that the library works with (>= 0); 0: all cores. Call it once, at the start. No result depends on it."""
def thread_count() -> int:
    """The number of threads in force, at least 1."""

def inspect(part: Union[_File, Part], unit: str | None = None, sort: str = '', type: str = '') -> dict[str, Any]:
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
def example(name: str, file: _File, seed: int = 1) -> dict[str, Any]:
    """Writes a part that the library makes itself, and its truth where it is known, as flank example does: a dict with the files.

    Raises UsageError for an unknown name, and lists the known ones; InputError if it cannot be written.
    """
def examples() -> list[str]:
    """The names that example knows."""
def machines() -> list[dict[str, Any]]:
    """Name, nesting and description of each machine that comes with the library: a list of dicts. Raises InputError."""
def machine(name: _File) -> dict[str, Any]:
    """Joints, limits and control of a machine, by its name or its file: a dict, as flank machine --json has it. Raises InputError."""
def sweep(
    plan: _File,
    folder: _File,
    *,
    processes: int = 0,
    resume: bool = False,
    progress: _Progress | None = None,
) -> dict[str, Any]:
    """Runs fit or cover on many faces with many tools, as flank sweep does: sweep.json as a dict (docs/schema/sweep.md).

    plan
        A file NAME.toml.
    folder
        For all results; made if there is none.
    processes
        Tasks at a time; 0: one for each core. The results do not depend on it.
    resume
        True keeps the finished tasks of an earlier run.
    progress
        Called as progress(stage, share) with the share in [0, 1] of all the work. What it raises ends the work.

    The command flank must be on the path, or FLANK_COMMAND name its file. Raises UsageError and InputError.
    """
def design(
    part: Union[_File, Part],
    folder: _File,
    *,
    processes: int = 0,
    resume: bool = False,
    progress: _Progress | None = None,
    **fields: Any,
) -> dict[str, Any]:
    """Finds the set of tools that finishes several faces in the least time, as flank design does: design.json as a dict.

        part, folder, processes, resume, progress
            As of sweep; the part is a file, or one that was read.

    unit
        Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in (expected mm, cm, m or
        in).
    faces
        Faces to finish, each by one tool of the set, as F1,F3 or F10-F19.
    side
        Machined side of an open sheet: + (towards the normal in the file) or -. Default: the outside
        where the faces enclose a space, else + (expected + or -).
    tools
        Largest number of tools in the set, the fastest such set is taken; or auto: the smallest set
        that finishes everything that can be finished (expected auto or a number from 1 to 100).
    source
        Where tools come from: fit (found for one or several of the faces), catalogue, or both (must be
        fit, catalogue or both).
    shape
        Form of fitted tools: free (any profile), or a family with any of its parameters
        (cone:radius=2).
    tolerance_mm
        Allowed deviation of all faces, both ways [mm] (expected a length > 0 mm).
    axis_length_mm
        Axis length of a fitted tool. Default: as its faces need [mm] (expected a length > 0 mm).
    tool_change_min
        Time of a tool change, for each tool of the set [min] (expected a time >= 0 min).
    radius_min_mm
        Smallest radius of a free tool (core). Default: 1 % of the face's diagonal [mm] (expected a
        radius > 0 mm).
    radius_max_mm
        Largest radius of a free tool. Default: 15 % of the face's diagonal [mm] (expected a radius > 0
        mm).
    slope_max
        Steepest taper of a free tool's profile, dr/ds (expected a number between 0 and 1).
    slenderness_max
        Largest L:D of a free tool with its shank: length over the diameter of a cylinder that bends as
        much. If the part does not allow it, the stiffest tool found is used (expected a number > 0).
    profile
        tapered: a free tool has no neck; any: it may have one (must be tapered or any).
    neck
        Allowed necking of a tapered tool, as a share of the radius nearer the tip (expected a share
        between 0 and 1).
    wheel_radius_mm
        Smallest radius of a concave profile, as the grinding wheel needs it. Default: any [mm]
        (expected a radius > 0 mm).
    coverage
        Share of the accessible area that must be within the tolerance (expected a share above 0 and at
        most 1).
    coverage_whole
        Share of the whole face, accessible or not, that must be within the tolerance. Default: any; a
        caution reports the rest (expected a share above 0 and at most 1).
    sample_mm
        Fast check of samples at this spacing only; it passes if no gouge deeper than the tolerance fits
        between them. Default: samples, and a proof that no place in between is cut deeper [mm]
        (expected a length > 0 mm).
    reach_radius_mm
        Areas where a ball of this radius would gouge a face are not accessible and do not count for
        coverage. Default: the smallest radius of a given tool; for a free tool axis length / (2 x
        slenderness-max); in a cavity the largest that fits through; smaller in grooves and fillets [mm]
        (expected a radius > 0 mm).
    catalogue
        Folder of tool files (NAME.json) for --tool catalogue. Default: $FLANK_CATALOGUE, else the tools
        that come with flank (share/openflank/catalogue).
    finalists
        Number of tools whose passes are planned in full; the others are compared by a quick plan
        (expected a number from 1 to 100).
    feed_mm_min
        Feed along the passes, for the machining time in the ranking [mm/min] (expected a rate > 0
        mm/min).
    rapid_mm_min
        Rapid rate between the passes [mm/min] (expected a rate > 0 mm/min).
    check_faces
        Faces that the tool must not gouge by more than the tolerance, as F88,F12. Default: all faces
        that are not machined.
    ignore_faces
        Faces that the tool may cut into; they are not checked. S2-S5 names all faces of solids 2 to 5.
    shank
        given: that of shank_length_mm or of the tool, and where there is none as auto; auto: a shank
        that reaches out of the part, as thick as the flank's upper end or thinner, so that it is clear;
        none: no shank (must be given, auto or none).
    shank_length_mm
        Length of a cylindrical shank above the flank [mm] (expected a length > 0 mm).
    shank_radius_mm
        Shank radius. Default: the radius of the flank's upper end [mm] (expected a length > 0 mm).
    holder
        Holder outline as z:r,z:r,... (height above the flank's upper end and radius, mm), or a file of
        such pairs.
    fixtures
        Part file that flank, shank and holder must not touch; may be given several times.
    fixture_unit
        Unit of fixtures that are meshes: mm, cm, m or in; default: that given for the part (expected
        mm, cm, m or in).
    clearance_mm
        Smallest distance of the holder from the part, of the shank from the faces that are not
        machined, and of the whole tool from fixtures. Default: no collision [mm] (expected a length >=
        0 mm).
    avoid
        on: fits plan around the neighbouring faces; off: tools are fitted without them, which is quick
        (they are checked all the same).
    """
def wheel(
    part: _File,
    folder: _File,
    *,
    tolerance_mm: float = 0.05,
    unit: str | None = None,
    tool: _File | None = None,
    coverage: float = 0.97,
    effort: str = 'quick',
    sample_mm: float | None = None,
    holder: _File | None = None,
    most_tools: int = 2,
    rough: bool = True,
    edges: bool = True,
    blank: _File | None = None,
    allowance_mm: float = 0.5,
    most_engagement_deg: float = 90.0,
    balance: float | None = None,
    machine: _File | None = None,
    most_tilt_deg: float = 100.0,
    hub: str | None = None,
    blades: Sequence[str] = (),
    splitters: Sequence[str] = (),
    count: int | None = None,
    progress: _Progress | None = None,
) -> dict[str, Any]:
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

# From the library's table of fields: scripts/python_stubs.py writes what follows.
def fit(
    part: Union[_File, Part],
    *,
    unit: str | None = None,
    faces: Union[str, Sequence[str]] = 'F1',
    skin: str | None = None,
    side: Literal[1, -1, "+", "-"] | None = None,
    tool: _File = 'free',
    tolerance_mm: float | None = None,
    allowance_mm: float | None = None,
    axis_length_mm: float | None = None,
    strips: Union[int, Literal["auto"]] = 'auto',
    effort: str = 'normal',
    start: str | None = None,
    guide: _File | None = None,
    radius_min_mm: float | None = None,
    radius_max_mm: float | None = None,
    slope_max: float = 0.95,
    slenderness_max: float = 8.0,
    profile: str = 'tapered',
    neck: float = 0.1,
    wheel_radius_mm: float | None = None,
    stiffness_curve: bool = False,
    cut: str = 'climb',
    min_bend_radius_mm: float | None = None,
    turn_max: float = 15.0,
    coverage: float = 0.99,
    coverage_whole: float | None = None,
    sample_mm: float | None = None,
    reach_radius_mm: float | None = None,
    check_faces: Union[str, Sequence[str]] | None = None,
    ignore_faces: Union[str, Sequence[str]] | None = None,
    shank: str = 'given',
    shank_length_mm: float | None = None,
    shank_radius_mm: float | None = None,
    holder: _File | None = None,
    fixtures: Sequence[_File] | None = None,
    fixture_unit: str | None = None,
    clearance_mm: float | None = None,
    avoid: bool = True,
    progress: _Progress | None = None,
) -> Result:
    """Finds a tool and a five-axis motion that finish a face, and checks them: a Result.

    part
        CAD or mesh file; flank inspect --help names the formats.
    unit
        Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in (expected mm, cm, m or
        in).
    faces
        Faces to machine: F1, F1,F3, F143-F160, or a piece F1a (see flank inspect).
    skin
        Instead of faces: this face and all faces tangent to it, as F143.
    side
        Machined side of an open sheet: + (towards the normal in the file) or -. Default: the outside
        where the faces enclose a space, else + (expected + or -).
    tool
        free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file.
    tolerance_mm
        Allowed deviation of the machined face, both ways. Default: a thousandth of the diagonal of the
        machined faces, rounded down to 1, 2 or 5 times a power of ten, from 0.005 to 0.5 mm [mm]
        (expected a length > 0 mm).
    allowance_mm
        Material left on purpose, for a later pass: the machined faces and all other faces of the part
        count as moved outwards by this, in planning and in the check. Default: 0 [mm] (expected a
        length >= 0 mm).
    axis_length_mm
        Length of the tool's axis, tip centre to upper end. Default: as the face needs [mm] (expected a
        length > 0 mm).
    strips
        Number of passes side by side with one tool, or auto: as many as the tolerance needs (expected
        auto or a number from 1 to 64).
    effort
        How long to search: quick ends after about 20 s of one processor, with at most four passes;
        normal after about five minutes; thorough has no limit (must be quick, normal or thorough).
    start
        First tool axis x,y,z,x,y,z (tip, holder end), mm. Default: found.
    guide
        File of several axes, one a line, that the motion follows.
    radius_min_mm
        Smallest radius of a free tool (core). Default: 1 % of the face's diagonal [mm] (expected a
        radius > 0 mm).
    radius_max_mm
        Largest radius of a free tool. Default: 15 % of the face's diagonal [mm] (expected a radius > 0
        mm).
    slope_max
        Steepest taper of a free tool's profile, dr/ds (expected a number between 0 and 1).
    slenderness_max
        Largest L:D of a free tool with its shank: length over the diameter of a cylinder that bends as
        much. If the part does not allow it, the stiffest tool found is used (expected a number > 0).
    profile
        tapered: a free tool has no neck; any: it may have one (must be tapered or any).
    neck
        Allowed necking of a tapered tool, as a share of the radius nearer the tip (expected a share
        between 0 and 1).
    wheel_radius_mm
        Smallest radius of a concave profile, as the grinding wheel needs it. Default: any [mm]
        (expected a radius > 0 mm).
    stiffness_curve
        on: also fit free tools of other L:D and report finished area, gouge and excess material of
        each.
    cut
        climb or conventional milling, in every pass; the spindle turns clockwise seen from the holder
        (must be climb or conventional).
    min_bend_radius_mm
        Smallest radius of curvature of the paths of tip and holder end that meets the request. Default:
        any [mm] (expected a radius > 0 mm).
    turn_max
        Largest change of the motion's direction over 1 % of the face's diagonal, degrees. A larger one
        is a kink and does not meet the request. 180: any (expected an angle above 0 and at most 180
        degrees).
    coverage
        Share of the accessible area that must be within the tolerance (expected a share above 0 and at
        most 1).
    coverage_whole
        Share of the whole face, accessible or not, that must be within the tolerance. Default: any; a
        caution reports the rest (expected a share above 0 and at most 1).
    sample_mm
        Fast check of samples at this spacing only; it passes if no gouge deeper than the tolerance fits
        between them. Default: samples, and a proof that no place in between is cut deeper [mm]
        (expected a length > 0 mm).
    reach_radius_mm
        Areas where a ball of this radius would gouge a face are not accessible and do not count for
        coverage. Default: the smallest radius of a given tool; for a free tool axis length / (2 x
        slenderness-max); in a cavity the largest that fits through; smaller in grooves and fillets [mm]
        (expected a radius > 0 mm).
    check_faces
        Faces that the tool must not gouge by more than the tolerance, as F88,F12. Default: all faces
        that are not machined.
    ignore_faces
        Faces that the tool may cut into; they are not checked. S2-S5 names all faces of solids 2 to 5.
    shank
        given: that of shank_length_mm or of the tool, and where there is none as auto; auto: a shank
        that reaches out of the part, as thick as the flank's upper end or thinner, so that it is clear;
        none: no shank (must be given, auto or none).
    shank_length_mm
        Length of a cylindrical shank above the flank [mm] (expected a length > 0 mm).
    shank_radius_mm
        Shank radius. Default: the radius of the flank's upper end [mm] (expected a length > 0 mm).
    holder
        Holder outline as z:r,z:r,... (height above the flank's upper end and radius, mm), or a file of
        such pairs.
    fixtures
        Part file that flank, shank and holder must not touch; may be given several times.
    fixture_unit
        Unit of fixtures that are meshes: mm, cm, m or in; default: that given for the part (expected
        mm, cm, m or in).
    clearance_mm
        Smallest distance of the holder from the part, of the shank from the faces that are not
        machined, and of the whole tool from fixtures. Default: no collision [mm] (expected a length >=
        0 mm).
    avoid
        on: plan around the neighbouring faces; off: plan without them (they are checked all the same).
    progress
        Called as progress(stage, share), share in [0, 1] of all the work. An exception that it raises ends the run.
    """
def cover(
    part: Union[_File, Part],
    tool: _File,
    *,
    unit: str | None = None,
    faces: Union[str, Sequence[str]] = 'F1',
    skin: str | None = None,
    side: Literal[1, -1, "+", "-"] | None = None,
    axis_length_mm: float | None = None,
    tolerance_mm: float | None = None,
    allowance_mm: float | None = None,
    strategy: str = 'grow',
    seed: int | None = None,
    seeds: str = 'grid',
    strips: int | None = None,
    strip_price: float | None = None,
    cut: str = 'climb',
    turn_max: float = 15.0,
    coverage: float = 0.95,
    coverage_whole: float | None = None,
    sample_mm: float | None = None,
    reach_radius_mm: float | None = None,
    catalogue: _File | None = None,
    finalists: int = 3,
    feed_mm_min: float = 1000.0,
    rapid_mm_min: float = 5000.0,
    check_faces: Union[str, Sequence[str]] | None = None,
    ignore_faces: Union[str, Sequence[str]] | None = None,
    shank: str = 'given',
    shank_length_mm: float | None = None,
    shank_radius_mm: float | None = None,
    holder: _File | None = None,
    fixtures: Sequence[_File] | None = None,
    fixture_unit: str | None = None,
    clearance_mm: float | None = None,
    progress: _Progress | None = None,
) -> Result:
    """Finds the passes with which a given or chosen tool finishes a face, and checks them: a Result.

    part
        CAD or mesh file; flank inspect --help names the formats.
    unit
        Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in (expected mm, cm, m or
        in).
    faces
        Faces to machine: F1, F1,F3, F143-F160, or a piece F1a (see flank inspect).
    skin
        Instead of faces: this face and all faces tangent to it, as F143.
    side
        Machined side of an open sheet: + (towards the normal in the file) or -. Default: the outside
        where the faces enclose a space, else + (expected + or -).
    tool
        A tool file; a family with all its parameters (barrel:arc=85,radius=5) and axis_length_mm; a
        family with some or none (barrel), the others are found for this face; or catalogue, the best of
        a folder of tools.
    axis_length_mm
        Axis length of a family's tool. If parameters are found, default: the width of the face over 1,
        2, 3 and 4 passes, all tried [mm] (expected a length > 0 mm).
    tolerance_mm
        Allowed deviation of the machined face, both ways. Default: a thousandth of the diagonal of the
        machined faces, rounded down to 1, 2 or 5 times a power of ten, from 0.005 to 0.5 mm [mm]
        (expected a length > 0 mm).
    allowance_mm
        Material left on purpose, for a later pass: the machined faces and all other faces of the part
        count as moved outwards by this, in planning and in the check. Default: 0 [mm] (expected a
        length >= 0 mm).
    strategy
        How passes are found: grow (extended step by step), or curves (the published method, to compare)
        (must be grow or curves).
    seed
        Seed of the random numbers of strategy curves. Default: 1.
    seeds
        Where passes start: grid, spread evenly; shape, more where the face is curved more (must be grid
        or shape).
    strips
        Largest number of passes. Default: until another one adds less than strip_price (expected a
        number from 1 to 200).
    strip_price
        Share of the face that another pass must add. Default: 0.005 (expected a share from 0 to 1).
    cut
        climb or conventional milling, in every pass; the spindle turns clockwise seen from the holder
        (must be climb or conventional).
    turn_max
        Largest change of the motion's direction over 1 % of the face's diagonal, degrees. A larger one
        is a kink and does not meet the request. 180: any (expected an angle above 0 and at most 180
        degrees).
    coverage
        Share of the accessible area that must be within the tolerance (expected a share above 0 and at
        most 1).
    coverage_whole
        Share of the whole face, accessible or not, that must be within the tolerance. Default: any; a
        caution reports the rest (expected a share above 0 and at most 1).
    sample_mm
        Fast check of samples at this spacing only; it passes if no gouge deeper than the tolerance fits
        between them. Default: samples, and a proof that no place in between is cut deeper [mm]
        (expected a length > 0 mm).
    reach_radius_mm
        Areas where a ball of this radius would gouge a face are not accessible and do not count for
        coverage. Default: the smallest radius of a given tool; for a free tool axis length / (2 x
        slenderness-max); in a cavity the largest that fits through; smaller in grooves and fillets [mm]
        (expected a radius > 0 mm).
    catalogue
        Folder of tool files (NAME.json) for tool catalogue. Default: $FLANK_CATALOGUE, else the tools
        that come with flank (share/openflank/catalogue).
    finalists
        Number of tools whose passes are planned in full; the others are compared by a quick plan
        (expected a number from 1 to 100).
    feed_mm_min
        Feed along the passes, for the machining time in the ranking [mm/min] (expected a rate > 0
        mm/min).
    rapid_mm_min
        Rapid rate between the passes [mm/min] (expected a rate > 0 mm/min).
    check_faces
        Faces that the tool must not gouge by more than the tolerance, as F88,F12. Default: all faces
        that are not machined.
    ignore_faces
        Faces that the tool may cut into; they are not checked. S2-S5 names all faces of solids 2 to 5.
    shank
        given: that of shank_length_mm or of the tool, and where there is none as auto; auto: a shank
        that reaches out of the part, as thick as the flank's upper end or thinner, so that it is clear;
        none: no shank (must be given, auto or none).
    shank_length_mm
        Length of a cylindrical shank above the flank [mm] (expected a length > 0 mm).
    shank_radius_mm
        Shank radius. Default: the radius of the flank's upper end [mm] (expected a length > 0 mm).
    holder
        Holder outline as z:r,z:r,... (height above the flank's upper end and radius, mm), or a file of
        such pairs.
    fixtures
        Part file that flank, shank and holder must not touch; may be given several times.
    fixture_unit
        Unit of fixtures that are meshes: mm, cm, m or in; default: that given for the part (expected
        mm, cm, m or in).
    clearance_mm
        Smallest distance of the holder from the part, of the shank from the faces that are not
        machined, and of the whole tool from fixtures. Default: no collision [mm] (expected a length >=
        0 mm).
    progress
        Called as progress(stage, share), share in [0, 1] of all the work. An exception that it raises ends the run.
    """
def trochoid(
    part: Union[_File, Part],
    *,
    left: Union[str, Sequence[str]] = 'F1',
    right: Union[str, Sequence[str]] = 'F2',
    floor: str | None = None,
    tool: _File = 'free',
    tolerance_mm: float | None = None,
    allowance_mm: float | None = None,
    axis_length_mm: float | None = None,
    effort: str = 'normal',
    max_engagement: float = 60.0,
    cut: str = 'climb',
    layers: Union[int, Literal["auto"]] = 'auto',
    entry: str = 'auto',
    ramp_angle: float = 3.0,
    strategy: str = 'volume',
    feed_mm_min: float = 1000.0,
    rapid_mm_min: float = 5000.0,
    stock_cell_mm: float | None = None,
    radius_min_mm: float | None = None,
    radius_max_mm: float | None = None,
    slope_max: float = 0.95,
    slenderness_max: float = 8.0,
    profile: str = 'tapered',
    neck: float = 0.1,
    wheel_radius_mm: float | None = None,
    coverage: float = 0.95,
    coverage_whole: float | None = None,
    sample_mm: float | None = None,
    reach_radius_mm: float | None = None,
    check_faces: Union[str, Sequence[str]] | None = None,
    ignore_faces: Union[str, Sequence[str]] | None = None,
    shank: str = 'given',
    shank_length_mm: float | None = None,
    shank_radius_mm: float | None = None,
    holder: _File | None = None,
    fixtures: Sequence[_File] | None = None,
    fixture_unit: str | None = None,
    clearance_mm: float | None = None,
    avoid: bool = True,
    progress: _Progress | None = None,
) -> Result:
    """Roughs and finishes the cavity between two sides with one tool, and checks it: a Result.

    part
        STEP, IGES or BREP file.
    left
        Faces of one side of the cavity, as F9, or several that are joined, F9,F10.
    right
        Faces of the opposite side.
    floor
        A face at the bottom of the cavity, where the tool's tip is. Default: found from the walls, else
        at the narrower end.
    tool
        free (any profile), a family with any of its parameters (cone:radius=2,angle=3), or a tool file.
    tolerance_mm
        Allowed deviation of the machined face, both ways. Default: a thousandth of the diagonal of the
        machined faces, rounded down to 1, 2 or 5 times a power of ten, from 0.005 to 0.5 mm [mm]
        (expected a length > 0 mm).
    allowance_mm
        Material left on purpose, for a later pass: the machined faces and all other faces of the part
        count as moved outwards by this, in planning and in the check. Default: 0 [mm] (expected a
        length >= 0 mm).
    axis_length_mm
        Length of the tool's axis, tip centre to upper end. Default: as a layer needs [mm] (expected a
        length > 0 mm).
    effort
        How long to search: quick ends after about 20 s of one processor, normal after about 90 s, with
        the best so far; thorough has no limit (must be quick, normal or thorough).
    max_engagement
        Largest engagement angle of the cutter, degrees (expected an angle above 5 and up to 180
        degrees).
    cut
        climb or conventional milling; the spindle turns clockwise seen from the holder (must be climb
        or conventional).
    layers
        Number of layers with one tool, or auto: as many as the tolerance needs (expected auto or a
        number from 1 to 12).
    entry
        How a layer is entered: open, from outside the blank; ramp, to and fro while sinking; plunge,
        along the tool's axis; auto: open where an end is open, else ramp. Ramps and plunges cut a slot,
        beyond max_engagement; their engagement is reported by itself (must be auto, open, ramp or
        plunge).
    ramp_angle
        Steepest slope of a ramp, degrees (expected an angle of at least 0.1 and at most 45 degrees).
    strategy
        volume: optimise the shape of every cycle for removed volume per path length; plain: optimise
        its step only; paper: the published method, to compare (must be volume, plain or paper).
    feed_mm_min
        Feed of cycles and side paths, for the machining time [mm/min] (expected a rate > 0 mm/min).
    rapid_mm_min
        Rapid rate of the links, for the machining time [mm/min] (expected a rate > 0 mm/min).
    stock_cell_mm
        Grid spacing of the stock simulation. Default: by the size of the cavity [mm] (expected a length
        > 0 mm).
    radius_min_mm
        Smallest radius of a free tool (core). Default: 1 % of the face's diagonal [mm] (expected a
        radius > 0 mm).
    radius_max_mm
        Largest radius of a free tool. Default: 15 % of the face's diagonal [mm] (expected a radius > 0
        mm).
    slope_max
        Steepest taper of a free tool's profile, dr/ds (expected a number between 0 and 1).
    slenderness_max
        Largest L:D of a free tool with its shank: length over the diameter of a cylinder that bends as
        much. If the part does not allow it, the stiffest tool found is used (expected a number > 0).
    profile
        tapered: a free tool has no neck; any: it may have one (must be tapered or any).
    neck
        Allowed necking of a tapered tool, as a share of the radius nearer the tip (expected a share
        between 0 and 1).
    wheel_radius_mm
        Smallest radius of a concave profile, as the grinding wheel needs it. Default: any [mm]
        (expected a radius > 0 mm).
    coverage
        Share of the accessible area that must be within the tolerance (expected a share above 0 and at
        most 1).
    coverage_whole
        Share of the whole face, accessible or not, that must be within the tolerance. Default: any; a
        caution reports the rest (expected a share above 0 and at most 1).
    sample_mm
        Fast check of samples at this spacing only; it passes if no gouge deeper than the tolerance fits
        between them. Default: samples, and a proof that no place in between is cut deeper [mm]
        (expected a length > 0 mm).
    reach_radius_mm
        Areas where a ball of this radius would gouge a face are not accessible and do not count for
        coverage. Default: the smallest radius of a given tool; for a free tool axis length / (2 x
        slenderness-max); in a cavity the largest that fits through; smaller in grooves and fillets [mm]
        (expected a radius > 0 mm).
    check_faces
        Faces that the tool must not gouge by more than the tolerance, as F88,F12. Default: all faces
        that are not machined.
    ignore_faces
        Faces that the tool may cut into; they are not checked. S2-S5 names all faces of solids 2 to 5.
    shank
        given: that of shank_length_mm or of the tool, and where there is none as auto; auto: a shank
        that reaches out of the part, as thick as the flank's upper end or thinner, so that it is clear;
        none: no shank (must be given, auto or none).
    shank_length_mm
        Length of a cylindrical shank above the flank [mm] (expected a length > 0 mm).
    shank_radius_mm
        Shank radius. Default: the radius of the flank's upper end [mm] (expected a length > 0 mm).
    holder
        Holder outline as z:r,z:r,... (height above the flank's upper end and radius, mm), or a file of
        such pairs.
    fixtures
        Part file that flank, shank and holder must not touch; may be given several times.
    fixture_unit
        Unit of fixtures that are meshes: mm, cm, m or in; default: that given for the part (expected
        mm, cm, m or in).
    clearance_mm
        Smallest distance of the holder from the part, of the shank from the faces that are not
        machined, and of the whole tool from fixtures. Default: no collision [mm] (expected a length >=
        0 mm).
    avoid
        on: plan around the neighbouring faces; off: plan without them (they are checked all the same).
    progress
        Called as progress(stage, share), share in [0, 1] of all the work. An exception that it raises ends the run.
    """
def verify(
    folder: _File | None = None,
    more_folders: Sequence[_File] | None = None,
    *,
    nc: _File | None = None,
    machine: _File | None = None,
    setup: str | None = None,
    tool: _File | None = None,
    faces: Union[str, Sequence[str]] | None = None,
    work_offset: int | None = None,
    tool_number: int | None = None,
    follow: str = 'path',
    part: Union[_File, Part] | None = None,
    side: Literal[1, -1, "+", "-"] | None = None,
    tolerance_mm: float | None = None,
    sample_mm: float | None = None,
    reach_radius_mm: float | None = None,
    stock_cell_mm: float | None = None,
    check_faces: Union[str, Sequence[str]] | None = None,
    ignore_faces: Union[str, Sequence[str]] | None = None,
    shank: str = 'given',
    shank_length_mm: float | None = None,
    shank_radius_mm: float | None = None,
    holder: _File | None = None,
    fixtures: Sequence[_File] | None = None,
    fixture_unit: str | None = None,
    clearance_mm: float | None = None,
    bending: bool = False,
    material: str | None = None,
    flutes: int | None = None,
    helix: float = 30.0,
    finish_stock_mm: float | None = None,
) -> Verification:
    """Checks the tool and path of a folder, or an NC program: a Verification.

    folder
        A folder written by flank fit, cover or trochoid; not needed with nc.
    more_folders
        The folders of the program's other operations, in their order.
    nc
        Check this NC program, run on machine, instead of the path of DIR.
    machine
        The machine: a name (flank machine --list) or a file NAME.toml.
    setup
        Set-up of the part x,y,z,a,b,c (mm, degrees). Default: the one in the program's header.
    tool
        Tool file of the program. Default: that of DIR.
    faces
        Faces that the program machines. Default: those of DIR, else F1.
    work_offset
        Work offset that holds the set-up; 1 is G54. Default: the one in the header, else in the
        machine's file (expected a number from 1 to 99).
    tool_number
        Number of the tool in the program. Default: the one in its header (expected a number from 1 to
        1000000).
    follow
        path: the program must cut the whole path of DIR in its order; any: only what it cuts counts
        (must be path or any).
    part
        Check against this part instead of the one named in job.json.
    side
        Machined side of an open sheet: + (towards the normal in the file) or -. Default: the outside
        where the faces enclose a space, else + (expected + or -).
    tolerance_mm
        Another tolerance than that of the job [mm] (expected a length > 0 mm).
    sample_mm
        Fast check of samples at this spacing only; it passes if no gouge deeper than the tolerance fits
        between them. Default: samples, and a proof that no place in between is cut deeper [mm]
        (expected a length > 0 mm).
    reach_radius_mm
        Areas where a ball of this radius would gouge a face are not accessible and do not count for
        --coverage. Default: the smallest radius of a given tool; for a free tool axis length / (2 x
        slenderness-max); in a cavity the largest that fits through; smaller in grooves and fillets [mm]
        (expected a radius > 0 mm).
    stock_cell_mm
        Grid spacing of the stock simulation. Default: by the size of the cavity [mm] (expected a length
        > 0 mm).
    check_faces
        Faces that the tool must not gouge by more than the tolerance, as F88,F12. Default: all faces
        that are not machined.
    ignore_faces
        Faces that the tool may cut into; they are not checked. S2-S5 names all faces of solids 2 to 5.
    shank
        given: that of shank_length_mm or of the tool, and where there is none as auto; auto: a shank
        that reaches out of the part, as thick as the flank's upper end or thinner, so that it is clear;
        none: no shank (must be given, auto or none).
    shank_length_mm
        Length of a cylindrical shank above the flank [mm] (expected a length > 0 mm).
    shank_radius_mm
        Shank radius. Default: the radius of the flank's upper end [mm] (expected a length > 0 mm).
    holder
        Holder outline as z:r,z:r,... (height above the flank's upper end and radius, mm), or a file of
        such pairs.
    fixtures
        Part file that flank, shank and holder must not touch; may be given several times.
    fixture_unit
        Unit of fixtures that are meshes: mm, cm, m or in; default: that given for the part (expected
        mm, cm, m or in).
    clearance_mm
        Smallest distance of the holder from the part, of the shank from the faces that are not
        machined, and of the whole tool from fixtures. Default: no collision [mm] (expected a length >=
        0 mm).
    bending
        Also report the errors with the tool bent by its load, at the feed of flank post with this
        material.
    material
        Workpiece material (share/materials); needed by bending.
    flutes
        Number of the tool's cutting edges; needed by bending (expected a number from 1 to 1000000).
    helix
        Helix angle of the cutting edges, degrees (expected an angle from 0 to 60 degrees).
    finish_stock_mm
        Thickness of what roughing has left on the machined faces. Not needed for a cavity, whose folder
        holds its load [mm] (expected a length > 0 mm).
    """
def post(
    folder: _File,
    machine: _File,
    more_folders: Sequence[_File] | None = None,
    *,
    part: Union[_File, Part] | None = None,
    setup: str | None = None,
    feed_mm_min: float | None = None,
    clamp: str = 'any',
    speed: str = 'feed',
    most_feed_mm_min: float | None = None,
    deviation_mm: float | None = None,
    tool_length_mm: float | None = None,
    spindle: float | None = None,
    material: str | None = None,
    flutes: int | None = None,
    helix: float = 30.0,
    finish_stock_mm: float | None = None,
    most_force: float | None = None,
    most_power: float | None = None,
    most_deflection_mm: float | None = None,
    operations: Sequence[_File] | None = None,
    copies: int = 1,
    copy_axis: str | None = None,
    coolant: str = 'off',
    dry: bool = False,
    force: bool = False,
    link_clearance_mm: float = 5.0,
    lift_mm: float = 2.0,
    order: str = 'shortest',
) -> Program:
    """Writes the program with which a machine runs the path of a folder: a Program.

    folder
        A folder written by flank fit, cover or trochoid.
    more_folders
        More folders of the same part: the program has an operation for each, with its own tool.
    machine
        The machine: a name (flank machine --list) or a file NAME.toml.
    part
        Another part than the one named in job.json.
    setup
        Set-up of the part on the table, x,y,z,a,b,c: its origin in mm, its turns about X, then Y, then
        Z in degrees. Default: found, so that the machine reaches everything.
    feed_mm_min
        Feed rate of the contact point along the passes; required, except for a dry run (1000) and speed
        optimal [mm/min] (expected a rate > 0 mm/min).
    clamp
        How the part is clamped, where setup is not given. any: any way up; bottom: its Z axis up; bore:
        copy_axis (default: its Z axis) up and on the axis of the table (must be any, bottom or bore).
    speed
        feed: feed_mm_min, slower where the axes need it, and in a cavity adapted to the engagement so
        that the thickest chip stays the same; constant: feed_mm_min everywhere; optimal: as fast as the
        axes can (must be feed, constant or optimal).
    most_feed_mm_min
        In a cavity: largest feed, where little or nothing is engaged. Default: three times feed_mm_min
        [mm/min] (expected a rate > 0 mm/min).
    deviation_mm
        Allowed deviation of the control's motion from the path. Default: 0.5 % of the tolerance [mm]
        (expected a length > 0 mm).
    tool_length_mm
        Tool length, from the gauge line to the controlled point. Default: the machine's [mm] (expected
        a length > 0 mm).
    spindle
        Spindle speed, 1/min; required, except for a dry run and with material (expected a number > 0).
    material
        Workpiece material (share/materials: aluminium, titanium, ...): derives spindle and feed_mm_min
        from its cutting speed and chip load; needs flutes.
    flutes
        Number of the tool's cutting edges, for the feed of material (expected a number from 1 to
        1000000).
    helix
        Helix angle of the cutting edges, degrees (expected an angle from 0 to 60 degrees).
    finish_stock_mm
        Thickness of what roughing has left on the machined faces: the feed follows the load of taking
        it. Not needed for a cavity, whose folder holds its load [mm] (expected a length > 0 mm).
    most_force
        Largest cutting force, N: the feed is slower where it would be exceeded (expected a number > 0).
    most_power
        Largest cutting power, W (expected a number > 0).
    most_deflection_mm
        Largest deflection of the tool's tip [mm] (expected a length > 0 mm).
    operations
        Settings of one operation, NUMBER:KEY=VALUE,...: name, tool (number), length (mm), spindle
        (1/min), feed (mm/min), flutes; as 2:name=finish,tool=7. May be given several times.
    copies
        Run each operation so many times, turned by 360 degrees / copies about copy_axis. The part must
        be the same when it is turned (expected a number from 1 to 999).
    copy_axis
        Axis of the copies in the part's frame x,y,z,x,y,z: a point (mm) and a direction. Default: its Z
        axis.
    coolant
        Coolant while the tool cuts: off, flood (M8) or mist (M7) (must be off, flood or mist).
    dry
        Dry run: the spindle stands still, and the program's header says so.
    force
        Write the program although it does not meet its request; its header says why, and the exit code
        is still 1.
    link_clearance_mm
        Distance of the links from the part and its surroundings [mm] (expected a length > 0 mm).
    lift_mm
        Lead-in and lead-out distance from the surface, before and after each pass [mm] (expected a
        length > 0 mm).
    order
        Order of the passes: shortest (short links) or given (as in the path). Trochoidal cycles keep
        their order (must be shortest or given).
    """
