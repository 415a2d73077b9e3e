# Drives the workbench in FreeCAD without a window and writes down what it finds, as JSON; freecad_workbench_test.mjs judges it. Run by
# freecadcmd: FLANK_PARTS names parts, FLANK_BINARY the command, FLANK_WORKBENCH the folder of the workbench, FLANK_RESULT the file to write.
import json
import os
import subprocess
import sys

import FreeCAD
import Part

sys.path.insert(0, os.environ["FLANK_WORKBENCH"])
import flank_child  # noqa: E402
import flank_operation  # noqa: E402
import flank_view  # noqa: E402

scratch = os.path.dirname(os.environ["FLANK_RESULT"])


def areas(file):
    """Of every face, as FreeCAD and as the command count them."""
    shape = Part.read(file)
    exported = os.path.join(scratch, "mapping.brep")
    shape.exportBrep(exported)
    table = json.loads(subprocess.run([flank_child.find_flank(), "inspect", exported, "--json"], capture_output=True, check=True).stdout)
    return {"freecad": [face.Area for face in shape.Faces], "flank": [row["area"] for row in table["faces"]]}


def state(obj):
    return {"verdict": obj.Verdict, "exit": obj.ExitCode, "reasons": list(obj.Reasons), "tool": obj.ToolShape is not None and obj.ToolShape.Shape.Volume,
            "path": obj.PathShape is not None and obj.PathShape.Shape.Length, "facets": obj.ErrorMap is not None and obj.ErrorMap.Mesh.CountFacets,
            "colours": obj.ErrorMap is not None and len(obj.ErrorMap.FaceColors), "place": obj.PathShape is not None and list(obj.PathShape.Shape.BoundBox.Center)}


def operation():
    parts = os.environ["FLANK_PARTS"].split(":")
    found = {"mapping": {os.path.basename(file): areas(file) for file in parts}}
    document = FreeCAD.newDocument("Flank")
    document.UndoMode = 1
    part = document.addObject("Part::Feature", "Cone")
    part.Shape = Part.read(parts[0])
    document.openTransaction("operation")
    obj = flank_operation.make_operation(document, part, ["Face1"])
    obj.Tolerance, obj.Effort = 0.05, "quick"
    document.recompute()
    document.commitTransaction()
    found["first"] = state(obj)
    with open(os.path.join(obj.Folder, "summary.json"), encoding="utf-8") as stream:
        found["pass"] = json.load(stream)["pass"]
    flank_operation.move_tool(obj, 1.0)
    found["end"] = list(obj.ToolShape.Placement.Base)
    found["poses"] = flank_operation.poses_of(obj.Folder)[-1][-1]
    # The part is moved: path and tool follow.
    part.Placement.Base = FreeCAD.Vector(100, 0, 0)
    document.recompute()
    found["moved"] = state(obj)
    # A request that nothing can meet.
    obj.Coverage, obj.AxisLength = 1.0, 1.5
    document.recompute()
    found["failing"] = state(obj)
    obj.Tool = "no such tool"
    document.recompute()
    found["refused"] = state(obj)
    file = os.path.join(scratch, "saved.FCStd")
    document.saveAs(file)
    FreeCAD.closeDocument(document.Name)
    loaded = FreeCAD.openDocument(file)
    again = loaded.getObject("FlankOperation")
    found["loaded"] = {**state(again), "proxy": type(again.Proxy).__name__, "tolerance": again.Tolerance.Value}
    again.Tool, again.Coverage, again.AxisLength = "", 0.0, 0.0
    loaded.recompute()
    found["recomputed"] = state(again)
    loaded.UndoMode = 1
    loaded.openTransaction("other")
    flank_operation.make_operation(loaded, loaded.getObject("Cone"), ["Face1"])
    loaded.commitTransaction()
    before = len(loaded.Objects)
    loaded.undo()
    found["undone"] = before - len(loaded.Objects)
    return found


def colours():
    return [flank_view.colour(f, 0.1) for f in (-0.1, 0.0, 0.1, 1.0)]


result = {}
for name, work in (("operation", operation), ("colours", colours)):
    try:
        result[name] = work()
    except Exception as error:  # the test shows it
        import traceback

        result[name] = {"error": f"{error}\n{traceback.format_exc()}"}
with open(os.environ["FLANK_RESULT"], "w", encoding="utf-8") as stream:
    json.dump(result, stream)
