# Drives the workbench in FreeCAD with a window, as a user does: chooses a face, runs the command, looks. Writes down what it finds, as JSON;
# freecad_window_test.mjs judges it. FLANK_PART names a part, FLANK_RESULT the file to write; pictures of the window lie beside it.
import json
import os
import re
import time
import traceback

import FreeCAD
import FreeCADGui
import Part
from PySide2 import QtCore, QtWidgets

folder = os.path.dirname(os.environ["FLANK_RESULT"])
window = FreeCADGui.getMainWindow()
SIZE = (1160, 760)
DOCKS_LEFT_OUT = ("Report view", "Python console", "Selection view", "DAG View")
BARS_LEFT_OUT = ("Macro", "Structure", "Workbench", "File", "Clipboard")


def settle(seconds=3.0):
    """The tree of the document and its icons are drawn a while after a change, by a timer."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QtWidgets.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 50)
        time.sleep(0.02)
    FreeCADGui.updateGui()


def picture(name):
    """The window as the screen shows it, the 3D view too: the size of the picture's file."""
    window.statusBar().clearMessage()
    settle()
    file = os.path.join(folder, f"{name}.png")
    corner = window.mapToGlobal(QtCore.QPoint(0, 0))
    QtWidgets.QApplication.primaryScreen().grabWindow(0, corner.x(), corner.y(), window.width(), window.height()).save(file)
    return os.path.getsize(file)


def icon_in_tree(label):
    """The colour in the middle of an object's icon in the tree, as "#rrggbb"."""
    for tree in window.findChildren(QtWidgets.QTreeWidget):
        for item in tree.findItems(label, QtCore.Qt.MatchExactly | QtCore.Qt.MatchRecursive, 0):
            image = item.icon(0).pixmap(16, 16).toImage()
            return image.pixelColor(image.width() // 2, image.height() // 2).name()
    return None


def tidy():
    """A window with what a user of the workbench needs, in a size that a page can show."""
    for dock in window.findChildren(QtWidgets.QDockWidget):
        if dock.windowTitle() in DOCKS_LEFT_OUT:
            dock.hide()
    for bar in window.findChildren(QtWidgets.QToolBar):
        if bar.windowTitle() in BARS_LEFT_OUT:
            bar.hide()
    for page in window.findChild(QtWidgets.QMdiArea).subWindowList():
        page.close()
    window.showNormal()
    window.resize(*SIZE)
    window.move(0, 0)


def drive():
    FreeCADGui.activateWorkbench("OpenFlankWorkbench")
    settle()
    tidy()
    document = FreeCAD.newDocument("Blade")
    part = document.addObject("Part::Feature", "Blade")
    part.Shape = Part.read(os.environ["FLANK_PART"])
    document.recompute()
    view = FreeCADGui.activeDocument().activeView()
    view.setAnimationEnabled(False)
    view.setCameraType("Orthographic")
    view.viewIsometric()
    view.fitAll()
    found = {"active_without_choice": FreeCADGui.Command.get("OpenFlank_Operation").isActive()}
    FreeCADGui.Selection.addSelection(document.Name, part.Name, "Face1")
    found["chosen_picture"] = picture("workbench-chosen")
    found["active"] = FreeCADGui.Command.get("OpenFlank_Operation").isActive()
    FreeCADGui.runCommand("OpenFlank_Operation")
    FreeCADGui.Selection.clearSelection()
    operation = document.getObject("FlankOperation")
    part.ViewObject.Visibility = False
    view.fitAll()
    view.getCameraNode().height.setValue(0.6 * view.getCameraNode().height.getValue())  # fitAll leaves room for any turn
    FreeCADGui.Selection.addSelection(document.Name, operation.Name)
    settle()
    for tree in window.findChildren(QtWidgets.QTreeWidget):
        tree.expandAll()
    for table in window.findChildren(QtWidgets.QTreeView):
        if table.metaObject().className().endswith("PropertyEditor"):
            table.scrollToBottom()
    found.update(verdict=operation.Verdict, exit=operation.ExitCode, children=[child.Name for child in operation.ViewObject.Proxy.claimChildren()],
                 coloured=operation.ErrorMap.ViewObject.Coloring, reasons=list(operation.Reasons), icon=re.findall("#[0-9a-f]{6}", operation.ViewObject.Proxy.getIcon()),
                 tree=icon_in_tree(operation.Label))
    found["result_picture"] = picture("workbench-result")
    return found


try:
    result = drive()
except Exception as error:  # the test shows it
    result = {"error": f"{error}\n{traceback.format_exc()}"}
with open(os.environ["FLANK_RESULT"], "w", encoding="utf-8") as stream:
    json.dump(result, stream)
# Without the question whether to save.
os._exit(0)
