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


def look(view, close=1.0):
    """The whole part from a corner; `close` below 1 comes nearer: fitAll leaves room for any turn."""
    view.viewIsometric()
    view.fitAll()
    view.getCameraNode().height.setValue(close * view.getCameraNode().height.getValue())
    settle()


def widget(kind, name):
    """The widget of that class and name which is seen, or None."""
    return next((one for one in QtWidgets.QApplication.allWidgets() if isinstance(one, kind) and one.objectName() == name and one.isVisible()), None)


def buttons():
    """The buttons of the open task panel, by their text."""
    return {one.text(): one for one in window.findChildren(QtWidgets.QPushButton) if one.isVisible()}


def state(operation):
    return {"verdict": operation.Verdict, "exit": operation.ExitCode, "icon": re.findall("#[0-9a-f]{6}", operation.ViewObject.Proxy.getIcon())[0]}


def run_on_face(document, part):
    """What a user does: a face is chosen, the command is run."""
    view = FreeCADGui.activeDocument().activeView()
    look(view)
    found = {"active_without_choice": FreeCADGui.Command.get("OpenFlank_Operation").isActive()}
    FreeCADGui.Selection.addSelection(document.Name, part.Name, "Face1")
    found["chosen_picture"] = picture("workbench-chosen")
    found["active"] = FreeCADGui.Command.get("OpenFlank_Operation").isActive()
    FreeCADGui.runCommand("OpenFlank_Operation")
    FreeCADGui.Selection.clearSelection()
    operation = document.getObject("FlankOperation")
    part.ViewObject.Visibility = False
    look(view, 0.6)
    FreeCADGui.Selection.addSelection(document.Name, operation.Name)
    settle()
    for tree in window.findChildren(QtWidgets.QTreeWidget):
        tree.expandAll()
    for table in window.findChildren(QtWidgets.QTreeView):
        if table.metaObject().className().endswith("PropertyEditor"):
            table.scrollToBottom()
    found.update(verdict=operation.Verdict, exit=operation.ExitCode, children=[child.Name for child in operation.ViewObject.Proxy.claimChildren()],
                 coloured=operation.ErrorMap.ViewObject.Coloring, reasons=list(operation.Reasons), icon=state(operation)["icon"], tree=icon_in_tree(operation.Label))
    found["result_picture"] = picture("workbench-result")
    return found


def panel(operation):
    """Its task panel: the verdict, the player, a program, a job for FreeCAD's own CAM workbench."""
    import flank_panel

    document = operation.Document
    operation.ViewObject.Proxy.doubleClicked(operation.ViewObject)
    settle(1.0)
    slider = next(one for one in window.findChildren(QtWidgets.QSlider) if one.isVisible())
    before = list(operation.ToolShape.Placement.Base)
    slider.setValue(500)
    found = {"moved": (operation.ToolShape.Placement.Base - FreeCAD.Vector(*before)).Length, "buttons": sorted(buttons()), "panel_picture": picture("workbench-panel")}
    objects, steps, made = len(document.Objects), document.UndoCount, operation.Folder
    buttons()["To CAM job"].click()
    settle(1.0)
    found["job_objects"] = len(document.Objects) - objects
    found.update(posted(document))
    found["job_picture"] = picture("workbench-job")
    FreeCADGui.Control.closeDialog()
    while document.UndoCount > steps:
        document.undo()
    found["undone_job"] = len(document.Objects) - objects
    found["planned_again"] = operation.Folder != made
    shown = flank_panel.open_panel(operation)
    shown.write(os.path.join(folder, "written.ngc"))
    found["written"] = shown.message.text().splitlines()[0]
    FreeCADGui.Control.closeDialog()
    return found


def posted(document):
    """The program that FreeCAD's own post-processor for LinuxCNC writes of the job."""
    import PathScripts.PathJob as PathJob
    import PathScripts.PathPost as PathPost

    job = PathJob.Instances()[0]
    command = PathPost.CommandPathPost()
    programs = [command.exportObjectsWith(part, job, False)[1] for part in command.buildPostList(job)]
    with open(os.path.join(folder, "freecad.ngc"), "w", encoding="utf-8") as stream:
        stream.write("".join(programs))
    return {"operations": [(one.Label, one.Path.Size) for one in job.Operations.Group], "programs": len(programs)}


def stopped(operation):
    """A request that takes minutes is stopped as soon as there is a best so far."""
    seen = {"shares": []}

    def watch():
        dialog = widget(QtWidgets.QProgressDialog, "FlankProgress")
        if dialog is None:
            return
        seen["shares"].append(dialog.value())
        if "best" in dialog.labelText():
            seen.setdefault("label", dialog.labelText())
            if "picture" not in seen:
                seen["picture"] = 0
                dialog.grab().save(os.path.join(folder, "workbench-progress.png"))
            dialog.findChild(QtWidgets.QPushButton).click()

    timer = QtCore.QTimer()
    timer.timeout.connect(watch)
    timer.start(100)
    operation.Tolerance, operation.Effort = 0.0001, "thorough"
    begin = time.monotonic()
    operation.Document.recompute()
    timer.stop()
    return {**state(operation), **seen, "seconds": time.monotonic() - begin, "picture": os.path.getsize(os.path.join(folder, "workbench-progress.png"))}


def edited():
    """A part made of features: one of them is changed, and the operation follows; then undo, save and load."""
    import flank_operation

    document = FreeCAD.newDocument("Ruled")
    document.UndoMode = 1
    low, high = document.addObject("Part::Line", "Low"), document.addObject("Part::Line", "High")
    low.X1, low.X2, high.X1, high.X2, high.Y2, high.Z1, high.Z2 = 0, 40, 0, 40, 6, 15, 15
    loft = document.addObject("Part::Loft", "Loft")
    loft.Sections, loft.Solid, loft.Ruled = [low, high], False, True
    document.recompute()
    operation = flank_operation.make_operation(document, loft, ["Face1"])
    operation.Label, operation.Tolerance, operation.Effort = "Ruled face", 0.05, "quick"
    document.recompute()
    found = {"first": {**state(operation), "length": operation.PathShape.Shape.Length}}
    document.openTransaction("longer")
    low.X2, high.X2 = 60, 60
    document.recompute()
    document.commitTransaction()
    found["longer"] = {**state(operation), "length": operation.PathShape.Shape.Length}
    document.undo()
    document.recompute()
    found["undone"] = {**state(operation), "length": operation.PathShape.Shape.Length, "x2": low.X2.Value}
    file = os.path.join(folder, "ruled.FCStd")
    document.saveAs(file)
    FreeCAD.closeDocument(document.Name)
    loaded = FreeCAD.openDocument(file)
    again = loaded.getObject("FlankOperation")
    settle(1.0)
    found["loaded"] = {**state(again), "tree": icon_in_tree(again.Label), "facets": again.ErrorMap.Mesh.CountFacets, "children": len(again.ViewObject.Proxy.claimChildren())}
    loaded.getObject("Low").X2 = 50
    loaded.recompute()
    found["recomputed"] = {**state(again), "length": again.PathShape.Shape.Length}
    return found


def stopping_at_once(act):
    """Does something during which the Stop of the progress is clicked as soon as it is there."""
    def watch():
        dialog = widget(QtWidgets.QProgressDialog, "FlankProgress")
        if dialog is not None:
            dialog.findChild(QtWidgets.QPushButton).click()

    timer = QtCore.QTimer()
    timer.timeout.connect(watch)
    timer.start(20)
    act()
    timer.stop()


def wheel():
    """All operations of a wheel: the part is chosen, the command is run and stopped; then a cheap request, its panel, and the same again."""
    import flank_operation
    import flank_panel

    document = FreeCAD.newDocument("Wheel")
    document.UndoMode = 1
    part = document.addObject("Part::Feature", "Impeller")
    part.Shape = Part.read(os.environ["FLANK_WHEEL"])
    document.recompute()
    FreeCADGui.Selection.clearSelection()
    found = {"active_without_choice": FreeCADGui.Command.get("OpenFlank_Wheel").isActive()}
    FreeCADGui.Selection.addSelection(document.Name, part.Name)
    found["active"] = FreeCADGui.Command.get("OpenFlank_Wheel").isActive()
    stopping_at_once(lambda: FreeCADGui.runCommand("OpenFlank_Wheel"))
    operation = document.getObject("WheelOperation")
    found["stopped"] = state(operation)
    # What a wheel takes most of its time for is left out.
    operation.Roughing, operation.Edges, operation.Sample = "off", "off", 0.5
    document.recompute()
    found["first"] = {**state(operation), "operations": list(operation.Operations), "reasons": list(operation.Reasons), "facets": operation.ErrorMap.Mesh.CountFacets,
                      "length": operation.PathShape.Shape.Length, "children": len(operation.ViewObject.Proxy.claimChildren())}
    found["folder"] = operation.Folder
    settle(1.0)
    found["tree"] = icon_in_tree(operation.Label)
    shown = flank_panel.open_panel(operation)
    shown.slider.setValue(500)
    found["place"] = shown.place.text()
    for name, act in (("posted", lambda: shown.write(os.path.join(folder, "wheel.ngc"))), ("job", shown.to_cam_job)):
        shown.guarded(act)
        found[name] = shown.message.text()
    found["picture"] = picture("workbench-wheel")
    FreeCADGui.Control.closeDialog()
    file = os.path.join(folder, "wheel.FCStd")
    document.saveAs(file)
    FreeCAD.closeDocument(document.Name)
    again = FreeCAD.openDocument(file).getObject("WheelOperation")
    found["loaded"] = {**state(again), "proxy": type(again.Proxy).__name__, "operations": list(again.Operations)}
    return found


def drive():
    FreeCADGui.activateWorkbench("OpenFlankWorkbench")
    settle()
    tidy()
    document = FreeCAD.newDocument("Blade")
    document.UndoMode = 1
    part = document.addObject("Part::Feature", "Blade")
    part.Shape = Part.read(os.environ["FLANK_PART"])
    document.recompute()
    view = FreeCADGui.activeDocument().activeView()
    view.setAnimationEnabled(False)
    view.setCameraType("Orthographic")
    found = run_on_face(document, part)
    operation = document.getObject("FlankOperation")
    found["panel"] = panel(operation)
    found["folder"] = operation.Folder
    found["stopped"] = stopped(operation)
    found["edited"] = edited()
    found["wheel"] = wheel()
    return found


try:
    result = drive()
except Exception as error:  # the test shows it
    result = {"error": f"{error}\n{traceback.format_exc()}"}
with open(os.environ["FLANK_RESULT"], "w", encoding="utf-8") as stream:
    json.dump(result, stream)
# Without the question whether to save.
os._exit(0)
