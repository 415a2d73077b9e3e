"""FlankOperation: faces in, tool, path, map of the error and a verdict out. Every recompute runs the command as a child."""

import json
import os
import tempfile

import FreeCAD
import Mesh
import Part

import flank_child
import flank_view

#: Properties that are fields of the command: name, kind, option, help.
FIELDS = [
    ("Tolerance", "App::PropertyLength", "--tolerance", "Allowed deviation of the machined face, both ways; 0: by the size of the face"),
    ("Tool", "App::PropertyString", "--tool", "free (any profile), a family with any of its parameters, or the name of a tool.json; empty: free"),
    ("AxisLength", "App::PropertyLength", "--axis-length", "Length of the tool's axis; 0: as the face needs"),
    ("ShankLength", "App::PropertyLength", "--shank-length", "Length of a cylindrical shank above the flank; 0: no shank, not checked"),
    ("Holder", "App::PropertyString", "--holder", "Holder outline as z:radius,z:radius,...; empty: no holder, not checked"),
    ("Coverage", "App::PropertyFloat", "--coverage", "Share of the accessible area that must be within the tolerance; 0: the default of the command"),
]
CHOICES = [
    ("Side", ["found", "+", "-"], "--side", "Machined side of a sheet"),
    ("Effort", ["normal", "quick", "thorough"], "--effort", "How long to search"),
]


def option_words(obj):
    """The options that the properties stand for; what is zero, empty or the first choice is left to the command."""
    words = []
    for name, kind, option, _ in FIELDS:
        value = getattr(obj, name)
        value = value.Value if kind == "App::PropertyLength" else value
        if value:
            words.append(f"{option}={value}")
    for name, choices, option, _ in CHOICES:
        if getattr(obj, name) != choices[0]:
            words.append(f"{option}={getattr(obj, name)}")
    return words


def face_names(sub_names):
    """FreeCAD's Face9 is F9 of the command: both count the faces of a shape in its own order."""
    return [name.replace("Face", "F") for name in sub_names if name.startswith("Face")]


class FlankOperation:
    """The proxy of a FlankOperation; see make_operation."""

    def __init__(self, obj):
        self.Type = "FlankOperation"
        obj.Proxy = self
        self.add_properties(obj)

    def add_properties(self, obj):
        """Adds the properties; also those that an object of an earlier version lacks."""
        def add(kind, name, group, text):
            if name not in obj.PropertiesList:
                obj.addProperty(kind, name, group, text)
                return True
            return False

        add("App::PropertyLinkSub", "Faces", "OpenFlank", "Faces to machine")
        add("App::PropertyLinkList", "Fixtures", "OpenFlank", "Objects that tool, shank and holder must not touch")
        for name, kind, _, text in FIELDS:
            add(kind, name, "OpenFlank", text)
        for name, choices, _, text in CHOICES:
            if add("App::PropertyEnumeration", name, "OpenFlank", text):
                setattr(obj, name, choices)
        for kind, name, text in [("App::PropertyString", "Verdict", "Verdict of the check"), ("App::PropertyInteger", "ExitCode", "Exit code of the command: 0 meets the request"),
                                 ("App::PropertyStringList", "Reasons", "Why it does not meet the request"), ("App::PropertyStringList", "Cautions", "What to know before machining, although the request is met"),
                                 ("App::PropertyString", "Folder", "Folder of the result"), ("App::PropertyLink", "ToolShape", "The tool at the first CL point"),
                                 ("App::PropertyLink", "PathShape", "The path of the tip"), ("App::PropertyLink", "ErrorMap", "The machined faces, coloured by their error")]:
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

    def execute(self, obj):
        """Runs the command into a new folder; the result of before stays until the new one is there."""
        if not obj.Faces:
            obj.Verdict = "no face is chosen"
            return
        part, sub_names = obj.Faces
        folder = tempfile.mkdtemp(prefix="openflank-")
        words = ["fit", export(part, folder, "part"), f"--face={','.join(face_names(sub_names))}", "-o", os.path.join(folder, "result"), "--json", "--progress", "json"]
        for number, fixture in enumerate(obj.Fixtures):
            words.append(f"--fixture={export(fixture, folder, f'fixture-{number + 1}')}")
        try:
            code, printed = flank_child.run(words + option_words(obj), progress_of(obj))
        except flank_child.FlankError as error:
            obj.Verdict, obj.ExitCode, obj.Reasons, obj.Cautions = f"refused: {error}", 2, [str(error)], []
            raise RuntimeError(str(error)) from error
        take_summary(obj, code, json.loads(printed) if printed else {})
        obj.Folder = os.path.join(folder, "result")
        show(obj)


def export(shape_object, folder, name):
    """The shape of an object in global coordinates, as a file."""
    file = os.path.join(folder, f"{name}.brep")
    Part.getShape(shape_object).exportBrep(file)
    return file


def progress_of(obj):
    """Shows the progress where there is a window; its Cancel stops the child."""
    if not FreeCAD.GuiUp:
        return None
    bar = FreeCAD.Base.ProgressIndicator()
    bar.start(f"{obj.Label}: flank fit", 100)
    done = [0]

    def progress(_stage, share):
        try:
            while done[0] < int(100 * share):
                bar.next(True)
                done[0] += 1
        except RuntimeError:  # cancelled by the user
            return False
        if share >= 1.0:
            bar.stop()
        return True

    return progress


def take_summary(obj, code, summary):
    obj.ExitCode = code
    obj.Reasons = [reason.get("text", "") for reason in summary.get("reasons", [])]
    obj.Cautions = [caution.get("text", "") for caution in summary.get("cautions", [])]
    stopped = "" if summary.get("complete", True) else "stopped, "
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
    if FreeCAD.GuiUp:  # only now: without the colours it would have none to show
        mesh.ViewObject.Coloring = True
        mesh.ViewObject.Lighting = "Two side"  # a sheet is looked at from its back, too


def move_tool(obj, share):
    """Puts the tool at a share of its path, 0 to 1: what a player does."""
    poses = [pose for strip in poses_of(obj.Folder) for pose in strip]
    obj.ToolShape.Placement = placed(poses[round(share * (len(poses) - 1))])


def make_operation(document, part, sub_names):
    """A FlankOperation on faces ("Face9") of an object; recompute the document to run it."""
    obj = document.addObject("App::FeaturePython", "FlankOperation")
    FlankOperation(obj)
    obj.Faces = (part, list(sub_names))
    if FreeCAD.GuiUp:
        import flank_gui

        flank_gui.ViewProvider(obj.ViewObject)
    return obj
