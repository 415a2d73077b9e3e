"""What needs a window: the command of the workbench, and the look of a FlankOperation in the tree."""

import os
import subprocess

import FreeCAD
import FreeCADGui

import flank_child
import flank_operation
import flank_panel

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
        colour = flank_panel.COLOURS[flank_panel.state_of(self.Object)] if verdict else "#9aa6b3"
        return "/* XPM */\nstatic char *dot[] = {\n" + ",\n".join(DOT).replace("{colour}", colour) + "};"

    def updateData(self, obj, name):
        if name == "Verdict":
            obj.ViewObject.signalChangeIcon()

    def doubleClicked(self, _view):
        FreeCADGui.Control.closeDialog()
        flank_panel.open_panel(self.Object)
        return True

    def setupContextMenu(self, _view, menu):
        menu.addAction("Report").triggered.connect(lambda: subprocess.Popen([flank_child.find_flank(), "view", self.Object.Folder]))

    def dumps(self):
        return None

    def loads(self, _state):
        return None

    __getstate__, __setstate__ = dumps, loads


def icon():
    return os.path.join(os.path.dirname(__file__), "openflank.svg")


def recomputed(document, name, make):
    """Makes an operation and runs it, as one step of undo."""
    document.openTransaction(name)
    make()
    document.recompute()
    document.commitTransaction()


class NewOperation:
    """Makes a FlankOperation of the chosen faces and runs it."""

    def GetResources(self):
        return {"MenuText": "Flank operation", "ToolTip": "Find a tool and a five-axis motion for the chosen faces", "Pixmap": icon()}

    def IsActive(self):
        return any(name.startswith("Face") for chosen in FreeCADGui.Selection.getSelectionEx() for name in chosen.SubElementNames)

    def Activated(self):
        chosen = next(one for one in FreeCADGui.Selection.getSelectionEx() if one.SubElementNames)
        document = FreeCAD.ActiveDocument
        recomputed(document, "Flank operation", lambda: flank_operation.make_operation(document, chosen.Object, chosen.SubElementNames))


class NewWheel:
    """Makes a WheelOperation of the chosen object and runs it."""

    def GetResources(self):
        return {"MenuText": "Wheel", "ToolTip": "All operations of the chosen compressor or turbine wheel, and one verdict", "Pixmap": icon()}

    def IsActive(self):
        return len(FreeCADGui.Selection.getSelection()) == 1 and hasattr(FreeCADGui.Selection.getSelection()[0], "Shape")

    def Activated(self):
        part, document = FreeCADGui.Selection.getSelection()[0], FreeCAD.ActiveDocument
        recomputed(document, "Wheel", lambda: flank_operation.make_wheel(document, part))


class ShowOperation:
    """Opens the panel of the chosen operation: verdict, player, program, CAM job, report."""

    def GetResources(self):
        return {"MenuText": "Result and machine", "ToolTip": "Verdict, player, program and CAM job of the chosen operation", "Pixmap": "document-properties"}

    def IsActive(self):
        chosen = FreeCADGui.Selection.getSelection()
        return len(chosen) == 1 and isinstance(getattr(chosen[0], "Proxy", None), flank_operation.FlankOperation)

    def Activated(self):
        FreeCADGui.Control.closeDialog()
        flank_panel.open_panel(FreeCADGui.Selection.getSelection()[0])


COMMANDS = {"OpenFlank_Operation": NewOperation, "OpenFlank_Wheel": NewWheel, "OpenFlank_Show": ShowOperation}
for name, command in COMMANDS.items():
    FreeCADGui.addCommand(name, command())
