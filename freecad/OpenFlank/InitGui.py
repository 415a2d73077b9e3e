# FreeCAD reads this file when it starts with a window.
import FreeCADGui


class OpenFlankWorkbench(FreeCADGui.Workbench):
    """Flank milling with the command `flank`."""

    MenuText = "OpenFlank"
    ToolTip = "A tool shaped for a face, its five-axis motion, and a verdict"

    def Initialize(self):
        import flank_gui  # registers the commands

        self.Icon = flank_gui.icon()
        self.appendToolbar("OpenFlank", list(flank_gui.COMMANDS))
        self.appendMenu("OpenFlank", list(flank_gui.COMMANDS))

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(OpenFlankWorkbench())
