"""What needs a window: the command of the workbench, and the look of a FlankOperation in the tree."""

import os
import subprocess

import FreeCAD
import FreeCADGui

import flank_child
import flank_operation

#: A dot in the colour of the verdict, as XPM.
DOT = ['"16 16 2 1"', '"  c None"', '"x c {colour}"', *(['"                "'] * 3), '"     xxxxxx     "', *(['"    xxxxxxxx    "'] * 8), '"     xxxxxx     "', *(['"                "'] * 3)]


class ViewProvider:
    def __init__(self, view):
        view.Proxy = self
        self.Object = view.Object

    def attach(self, view):
        self.Object = view.Object

    def claimChildren(self):
        return [child for child in (self.Object.ToolShape, self.Object.PathShape, self.Object.ErrorMap) if child]

    def isShow(self):
        """It has nothing of its own to draw, and FreeCAD draws the icon of what is hidden in grey."""
        return True

    def getIcon(self):
        verdict = self.Object.Verdict
        colour = "#9aa6b3" if not verdict else "#1e7a46" if verdict == "meets the request" and not self.Object.Cautions else "#c98500" if verdict == "meets the request" else "#b3241f"
        return "/* XPM */\nstatic char *dot[] = {\n" + ",\n".join(DOT).replace("{colour}", colour) + "};"

    def updateData(self, obj, name):
        if name == "Verdict":
            obj.ViewObject.signalChangeIcon()

    def setupContextMenu(self, _view, menu):
        menu.addAction("Report").triggered.connect(lambda: subprocess.Popen([flank_child.find_flank(), "view", self.Object.Folder]))

    def dumps(self):
        return None

    def loads(self, _state):
        return None

    __getstate__, __setstate__ = dumps, loads


class NewOperation:
    """Makes a FlankOperation of the chosen faces and runs it."""

    def GetResources(self):
        return {"MenuText": "Flank operation", "ToolTip": "Find a tool and a five-axis motion for the chosen faces", "Pixmap": os.path.join(os.path.dirname(__file__), "openflank.svg")}

    def IsActive(self):
        return any(name.startswith("Face") for chosen in FreeCADGui.Selection.getSelectionEx() for name in chosen.SubElementNames)

    def Activated(self):
        chosen = next(one for one in FreeCADGui.Selection.getSelectionEx() if one.SubElementNames)
        document = FreeCAD.ActiveDocument
        document.openTransaction("Flank operation")
        flank_operation.make_operation(document, chosen.Object, chosen.SubElementNames)
        document.recompute()
        document.commitTransaction()


FreeCADGui.addCommand("OpenFlank_Operation", NewOperation())
