"""FlankOperation: faces in, tool, path, map of the error and a verdict out. Every recompute runs the command as a child."""

import json
import os
import tempfile

import FreeCAD
import Mesh
import Part

import flank_child
import flank_view

#: Properties that are fields of a command: name, kind, option, help.
TOLERANCE = ("Tolerance", "App::PropertyLength", "--tolerance", "Allowed deviation of the machined face, both ways; 0: by the size of the face")
COVERAGE = ("Coverage", "App::PropertyFloat", "--coverage", "Share of the accessible area that must be within the tolerance; 0: the default of the command")
TOOL = "free (any profile), a family with any of its parameters, or the name of a tool.json; empty: the default of the command"
#: Of those with choices: name, choices, option, help.
EFFORT = "How long to search"


def option_words(obj, fields, choices):
    """The options that the properties stand for; what is zero, empty or the first choice is left to the command."""
    words = []
    for name, kind, option, _ in fields:
        value = getattr(obj, name)
        value = value.Value if kind == "App::PropertyLength" else value
        if value:
            words.append(f"{option}={value}")
    for name, names, option, _ in choices:
        if getattr(obj, name) != names[0]:
            words.append(f"{option}={getattr(obj, name)}")
    return words


def face_names(sub_names):
    """FreeCAD's Face9 is F9 of the command: both count the faces of a shape in its own order."""
    return [name.replace("Face", "F") for name in sub_names if name.startswith("Face")]


class FlankOperation:
    """The proxy of an operation on chosen faces; see make_operation."""

    COMMAND = "fit"
    LINKS = [("App::PropertyLinkSub", "Faces", "Faces to machine"), ("App::PropertyLinkList", "Fixtures", "Objects that tool, shank and holder must not touch")]
    FIELDS = [
        TOLERANCE,
        ("Tool", "App::PropertyString", "--tool", TOOL),
        ("AxisLength", "App::PropertyLength", "--axis-length", "Length of the tool's axis; 0: as the face needs"),
        ("ShankLength", "App::PropertyLength", "--shank-length", "Length of a cylindrical shank above the flank; 0: no shank, not checked"),
        ("Holder", "App::PropertyString", "--holder", "Holder outline as z:radius,z:radius,...; empty: no holder, not checked"),
        COVERAGE,
    ]
    CHOICES = [("Side", ["found", "+", "-"], "--side", "Machined side of a sheet"), ("Effort", ["normal", "quick", "thorough"], "--effort", EFFORT)]
    RESULTS = [
        ("App::PropertyString", "Verdict", "Verdict of the check"),
        ("App::PropertyInteger", "ExitCode", "Exit code of the command: 0 meets the request"),
        ("App::PropertyStringList", "Reasons", "Why it does not meet the request"),
        ("App::PropertyStringList", "Cautions", "What to know before machining, although the request is met"),
        ("App::PropertyString", "Folder", "Folder of the result"),
        ("App::PropertyLink", "ToolShape", "The tool at the first CL point"),
        ("App::PropertyLink", "PathShape", "The path of the tip"),
        ("App::PropertyLink", "ErrorMap", "The machined faces, coloured by their error"),
    ]

    def __init__(self, obj):
        self.Type = type(self).__name__
        obj.Proxy = self
        self.add_properties(obj)

    def add_properties(self, obj):
        """Adds the properties; also those that an object of an earlier version lacks."""
        def add(kind, name, group, text):
            if name not in obj.PropertiesList:
                obj.addProperty(kind, name, group, text)
                return True
            return False

        for kind, name, text in self.LINKS:
            add(kind, name, "OpenFlank", text)
        for name, kind, _, text in self.FIELDS:
            add(kind, name, "OpenFlank", text)
        for name, choices, _, text in self.CHOICES:
            if add("App::PropertyEnumeration", name, "OpenFlank", text):
                setattr(obj, name, choices)
        for kind, name, text in self.RESULTS:
            add(kind, name, "Result", text)
            obj.setEditorMode(name, 1)

    def onDocumentRestored(self, obj):
        obj.Proxy = self
        self.add_properties(obj)

    def dumps(self):
        return self.Type

    def loads(self, state):
        self.Type = state

    # Of FreeCAD before 0.21.
    __getstate__, __setstate__ = dumps, loads

    def part(self, obj):
        """The object whose shape is machined; None before it is chosen."""
        return obj.Faces[0] if obj.Faces else None

    def begin(self, obj):
        """A folder for a new result: that of before stays until the new one is there."""
        return tempfile.mkdtemp(prefix="openflank-")

    def words(self, obj, folder):
        """What the command is asked for, without its folder."""
        words = [f"--face={','.join(face_names(obj.Faces[1]))}"]
        for number, fixture in enumerate(obj.Fixtures):
            words.append(f"--fixture={export(fixture, folder, f'fixture-{number + 1}')}")
        return words

    def execute(self, obj):
        """Runs the command as a child, with its progress where there is a window."""
        part = self.part(obj)
        if part is None:
            obj.Verdict = "nothing is chosen"
            return
        folder = self.begin(obj)
        result = os.path.join(folder, "result")
        words = [self.COMMAND, export(part, folder, "part"), *self.words(obj, folder), *option_words(obj, self.FIELDS, self.CHOICES), "-o", result, "--json", "--progress", "json"]
        progress = progress_of(obj)
        try:
            code, printed = flank_child.run(words, progress)
        except flank_child.FlankError as error:
            obj.Verdict, obj.ExitCode, obj.Reasons, obj.Cautions = f"refused: {error}", 2, [str(error)], []
            raise RuntimeError(str(error)) from error
        finally:
            if progress:
                progress.close()
        take_summary(obj, code, result, bool(printed))
        obj.Folder = result
        if os.path.exists(os.path.join(result, "view.json")):
            show(obj)


class WheelOperation(FlankOperation):
    """The proxy of all operations of a wheel; see make_wheel."""

    COMMAND = "wheel"
    LINKS = [("App::PropertyLink", "Part", "The wheel: an object with its blades and hub")]
    FIELDS = [("Tolerance", "App::PropertyLength", "--tolerance", "Allowed deviation of the machined faces, both ways; 0: the default of the command"),
              ("Tool", "App::PropertyString", "--tool", TOOL), COVERAGE, ("Sample", "App::PropertyLength", "--sample", "Spacing of a fast check without the proof; 0: samples and a proof")]
    CHOICES = [("Effort", ["quick", "normal", "thorough"], "--effort", EFFORT), ("Roughing", ["on", "off"], "--rough", "Whether the channels are roughed"),
               ("Edges", ["on", "off"], "--edges", "Whether leading and trailing edges are machined")]
    RESULTS = [*FlankOperation.RESULTS, ("App::PropertyStringList", "Operations", "The operations, and what became of each")]

    def part(self, obj):
        return obj.Part

    def begin(self, obj):
        """The folder of before: the command keeps the operations that are done, of the same part and request."""
        before = os.path.dirname(obj.Folder) if obj.Folder else ""
        return before if os.path.isdir(before) else tempfile.mkdtemp(prefix="openflank-")

    def words(self, _obj, _folder):
        return []

    def execute(self, obj):
        try:
            super().execute(obj)
        finally:
            obj.Operations = operations_of(obj.Folder)


def operations_of(folder):
    """"20 side: done" of every operation of a wheel."""
    plan = os.path.join(folder, "plan.json")
    if not os.path.exists(plan):
        return []
    with open(plan, encoding="utf-8") as stream:
        told = json.load(stream)["operations"]
    return [f"{one['id']} {one['kind']}: {'done' if one['done'] else 'NOT done'}{', ' + one['problem'] if one.get('problem') else ''}" for one in told]


def export(shape_object, folder, name):
    """The shape of an object in global coordinates, as a file."""
    file = os.path.join(folder, f"{name}.brep")
    Part.getShape(shape_object).exportBrep(file)
    return file


def progress_of(obj):
    """Shows the progress where there is a window; its Stop ends the child, whose best so far is kept."""
    if not FreeCAD.GuiUp:
        return None
    import flank_panel

    return flank_panel.Progress(obj.Label)


def take_summary(obj, code, result, whole):
    """The verdict from the folder; `whole`: the command came to its end and printed what it found."""
    file, summary = os.path.join(result, "summary.json"), {}
    if whole and os.path.exists(file):
        with open(file, encoding="utf-8") as stream:
            summary = json.load(stream)
    obj.ExitCode = code
    obj.Reasons = [reason.get("text", "") for reason in summary.get("reasons", [])]
    obj.Cautions = [caution.get("text", "") for caution in summary.get("cautions", [])]
    stopped = "" if summary.get("complete", whole) else "stopped, "
    obj.Verdict = stopped + ("meets the request" if code == flank_child.MEETS else "does NOT meet the request")


def child_of(obj, link, kind, label):
    """The object that a link leads to, made if it is not there."""
    found = getattr(obj, link)
    if found is None:
        found = obj.Document.addObject(kind, f"{obj.Name}{link}")
        found.Label = f"{obj.Label}: {label}"
        setattr(obj, link, found)
    return found


def placed(pose):
    """Where a tool along z from its tip stands for a pose (x, y, z, i, j, k)."""
    turn = FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), FreeCAD.Vector(*pose[3:6]))
    return FreeCAD.Placement(FreeCAD.Vector(*pose[:3]), turn)


def poses_of(folder):
    with open(os.path.join(folder, "path.json"), encoding="utf-8") as stream:
        return [strip["poses"] for strip in json.load(stream)["strips"]]


def show(obj):
    """Tool, path and map of the error from the folder of the result."""
    strips = poses_of(obj.Folder)
    tool = child_of(obj, "ToolShape", "Part::Feature", "tool")
    tool.Shape = Part.read(os.path.join(obj.Folder, "tool.step"))
    tool.Placement = placed(strips[0][0])
    path = child_of(obj, "PathShape", "Part::Feature", "path")
    path.Shape = Part.makeCompound([Part.makePolygon([FreeCAD.Vector(*pose[:3]) for pose in poses]) for poses in strips])
    with open(os.path.join(obj.Folder, "view.json"), encoding="utf-8") as stream:
        view = json.load(stream)
    facets, colours = [], []
    for _, corner, triangles, colour in flank_view.targets(view):
        for triangle in triangles:
            facets.append([corner[k] for k in triangle])
            # A facet has one colour: that of its worst corner, the one farthest from white.
            colours.append(min((colour[k] for k in triangle), key=sum))
    mesh = child_of(obj, "ErrorMap", "Mesh::Feature", "error")
    mesh.Mesh = Mesh.Mesh(facets)
    if "FaceColors" not in mesh.PropertiesList:
        mesh.addProperty("App::PropertyColorList", "FaceColors", "OpenFlank", "Colour of each facet")
    mesh.FaceColors = colours
    for child in (tool, path, mesh):
        # They are ours to set: a document that finds them changed would call for another recompute.
        child.purgeTouched()
    if FreeCAD.GuiUp:  # only now: without the colours it would have none to show
        mesh.ViewObject.Coloring = True
        mesh.ViewObject.Lighting = "Two side"  # a sheet is looked at from its back, too


def move_tool(obj, share, strips=None):
    """Puts the tool at a share of its path, 0 to 1, which is what a player does: the number of the pass and of the CL point, from 1. `strips`:
    what poses_of gives, for who moves it often."""
    places = [(number, k, pose) for number, poses in enumerate(strips or poses_of(obj.Folder), 1) for k, pose in enumerate(poses, 1)]
    number, k, pose = places[round(share * (len(places) - 1))]
    obj.ToolShape.Placement = placed(pose)
    obj.ToolShape.purgeTouched()  # a tool that is looked at elsewhere is no reason to plan anew
    return number, k


def machines():
    """[(name, description)] of the machines that the command knows."""
    listed = json.loads(flank_child.run(["machine", "--list", "--json"])[1])["machines"]
    return [(machine["name"], machine["description"]) for machine in listed]


def post(obj, machine, spindle, feed, file):
    """Writes the program of the result for a machine; (exit code, what the command says of it)."""
    return flank_child.run(["post", obj.Folder, f"--machine={machine}", f"--spindle={spindle:g}", f"--feed={feed:g}", "-o", file])


def make_operation(document, part, sub_names):
    """A FlankOperation on faces ("Face9") of an object; recompute the document to run it."""
    obj = document.addObject("App::FeaturePython", "FlankOperation")
    FlankOperation(obj)
    obj.Faces = (part, list(sub_names))
    return shown(obj)


def make_wheel(document, part):
    """A WheelOperation on an object; recompute the document to run it."""
    obj = document.addObject("App::FeaturePython", "WheelOperation")
    WheelOperation(obj)
    obj.Part = part
    return shown(obj)


def shown(obj):
    """With its look in the tree, where there is a window."""
    if FreeCAD.GuiUp:
        import flank_gui

        flank_gui.ViewProvider(obj.ViewObject)
    return obj
