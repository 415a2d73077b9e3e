# Opens the files of a fit in FreeCAD and writes down what it finds there, as JSON; freecad_test.mjs judges it.
# Run by freecadcmd; FLANK_FOLDER is the folder of the fit, FLANK_RESULT the file to write.
import json
import math
import os

import FreeCAD
import Import
import Part
import PathScripts.PathToolBit as PathToolBit

folder = os.environ["FLANK_FOLDER"]


def file(name):
    return os.path.join(folder, name)


def box(shape):
    b = shape.BoundBox
    return [b.XMin, b.YMin, b.ZMin, b.XMax, b.YMax, b.ZMax]


def objects(name):
    """What the file's objects are called, and their shapes."""
    document = FreeCAD.newDocument()
    # Without a window FreeCAD 0.20 crashes on the link groups that it makes otherwise, of its own files too.
    Import.insert(name=file(name), docName=document.Name, useLinkGroup=False, merge=False)
    return [(o.Label, o.Shape) for o in document.Objects if hasattr(o, "Shape") and not o.Shape.isNull()]


def tool():
    return [
        {
            "label": label,
            "solids": len(shape.Solids),
            "valid": shape.isValid(),
            "closed": all(s.isClosed() for s in shape.Shells),
            "volume": shape.Volume,
            "box": box(shape),
        }
        for label, shape in objects("tool.step")
    ]


def vector(numbers):
    return FreeCAD.Vector(*numbers)


def contacts(before, pose, after, samples, k):
    """Both contact points of sample k of the tool at a pose, whose velocity comes from its neighbours."""

    def axis(p, s):
        return vector(p[:3]) + vector(p[3:]) * s

    step = samples[1][0] - samples[0][0]
    s, r = samples[k]
    slope = (samples[k + 1][1] - samples[k - 1][1]) / (2 * step)
    a, center, b = axis(before, s), axis(pose, s), axis(after, s)
    # Of the parabola through the three, whose parameter is the distance travelled.
    back, ahead = center - a, b - center
    velocity = back * (ahead.Length / back.Length) + ahead * (back.Length / ahead.Length)
    u = vector(pose[3:]).normalize()
    along = velocity * u
    across = velocity - u * along
    e1 = FreeCAD.Vector(across).normalize()
    q = math.sqrt(1 - slope**2)
    c = slope * along / (q * across.Length)
    return [
        center + (u * -slope + (e1 * c + u.cross(e1) * (side * math.sqrt(1 - c * c))) * q) * r for side in (1, -1)
    ]


def strips():
    """Distances of contact points to the envelope: [strip, s, distance]."""
    with open(file("path.json")) as text:
        path = json.load(text)
    with open(file("tool.json")) as text:
        samples = json.load(text)["samples"]
    shapes = objects("strips.step")
    distances = []
    for strip, (_, shape) in zip(path["strips"], shapes):
        poses = strip["poses"]
        for i in range(1, 8):
            p = i * len(poses) // 8
            for share in (0.15, 0.4, 0.6, 0.85):
                k = int(share * len(samples))
                points = contacts(poses[p - 1], poses[p], poses[p + 1], samples, k)
                nearest = min(shape.distToShape(Part.Vertex(point))[0] for point in points)
                distances.append([strip["id"], samples[k][0], nearest])
    return {
        "labels": [label for label, _ in shapes],
        "faces": [len(shape.Faces) for _, shape in shapes],
        "valid": all(shape.isValid() for _, shape in shapes),
        "kinds": [shape.Faces[0].Surface.TypeId for _, shape in shapes],
        "distances": distances,
    }


def widest_at(edges, height):
    """The largest radius at which a line across the axis at HEIGHT meets one of EDGES; the axis of the drawing is x."""
    across = Part.makeLine(FreeCAD.Vector(height, 0, 0), FreeCAD.Vector(height, 100, 0))
    found = [across.distToShape(edge) for edge in edges if edge.BoundBox.XMin < height < edge.BoundBox.XMax]
    return max([point.y for distance, pairs, _ in found if distance < 1e-7 for point, _ in pairs], default=None)


def drawing():
    FreeCAD.newDocument()
    # Texts and dimensions are read on demand only.
    FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Draft").SetBool("dxftext", True)
    Import.readDXF(file("tool.dxf"))
    shapes = [o.Shape for o in FreeCAD.ActiveDocument.Objects if hasattr(o, "Shape") and not o.Shape.isNull()]
    edges = [edge for shape in shapes for edge in shape.Edges]
    return {
        "radii": [widest_at(edges, height) for height in json.loads(os.environ["FLANK_HEIGHTS"])],
        "box": box(Part.makeCompound(shapes)) if shapes else None,
        "types": sorted({o.TypeId for o in FreeCAD.ActiveDocument.Objects}),
        "dimensions": sorted(
            float(o.Distance) for o in FreeCAD.ActiveDocument.Objects if hasattr(o, "Distance")
        ),
    }


def bit():
    FreeCAD.newDocument()
    found = PathToolBit.Factory.CreateFrom(file("tool.fctb"))
    return {
        "label": found.Label,
        "shape": os.path.basename(found.BitShape),
        "diameter": found.Diameter.Value,
        "length": found.Length.Value,
        "valid": found.Shape.isValid(),
        "box": box(found.Shape),
    }


answers = {}
for question in (tool, strips, drawing, bit):
    try:
        answers[question.__name__] = question()
    except Exception as error:  # the other answers still count
        answers[question.__name__] = {"error": repr(error)}
with open(os.environ["FLANK_RESULT"], "w") as result:
    json.dump(answers, result)
