"""What a FlankOperation shows and does beside the tree: verdict, player, report, program, CAM job; and its progress while it runs."""

import os
import subprocess

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

import flank_cam
import flank_child
import flank_operation

STEPS = 1000
COLOURS = {"pass": "#1e7a46", "caution": "#c98500", "fail": "#b3241f"}


class Progress:
    """A window with stage, share, best so far and Stop; called by flank_child.run."""

    def __init__(self, label):
        self.label = label
        self.dialog = QtGui.QProgressDialog(f"{label}\n", "Stop", 0, 100, FreeCADGui.getMainWindow())
        self.dialog.setObjectName("FlankProgress")
        self.dialog.setWindowTitle("OpenFlank")
        self.dialog.setWindowModality(QtCore.Qt.ApplicationModal)
        self.dialog.setMinimumDuration(0)
        self.dialog.setMinimumWidth(380)
        self.dialog.setAutoClose(False)
        self.dialog.setAutoReset(False)
        self.dialog.setValue(0)
        self.dialog.show()

    def __call__(self, told):
        stopped = self.dialog.wasCanceled()
        if told and not stopped:
            best = told.get("best")
            found = f", best {100.0 * best['coverage']:.1f} % finished" if best else ""
            self.dialog.setLabelText(f"{self.label}: {told['stage']}\n{100.0 * told['share']:.0f} %{found}")
            # Parts of the work may be longer than was thought: what is shown never falls.
            self.dialog.setValue(max(self.dialog.value(), int(100 * told["share"])))
        QtGui.QApplication.processEvents()
        return not self.dialog.wasCanceled()

    def close(self):
        self.dialog.close()
        self.dialog.deleteLater()


def state_of(obj):
    if obj.Verdict != "meets the request":
        return "fail"
    return "caution" if obj.Cautions else "pass"


class Panel:
    """The task panel of an operation (double click)."""

    def __init__(self, obj):
        self.obj, self.strips = obj, None
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(obj.Label)
        box = QtGui.QVBoxLayout(self.form)
        self.verdict = QtGui.QLabel()
        self.reasons = QtGui.QLabel()
        for label in (self.verdict, self.reasons):
            label.setWordWrap(True)
            label.setMinimumWidth(120)
        self.again = self.button("Run again", self.run)
        box.addWidget(self.verdict)
        box.addWidget(self.reasons)
        box.addWidget(self.again)
        box.addWidget(self.player())
        box.addWidget(self.machine())
        self.message = QtGui.QLabel()
        self.message.setWordWrap(True)
        box.addWidget(self.message)
        box.addStretch()
        self.show()

    def button(self, text, act):
        made = QtGui.QPushButton(text)
        made.clicked.connect(lambda: self.guarded(act))
        return made

    def guarded(self, act):
        try:
            act()
        except (flank_child.FlankError, RuntimeError, OSError) as error:
            self.message.setText(str(error))

    def player(self):
        group = QtGui.QGroupBox("Tool on its path")
        line = QtGui.QVBoxLayout(group)
        self.slider = QtGui.QSlider(QtCore.Qt.Horizontal)
        self.slider.setRange(0, STEPS)
        self.slider.valueChanged.connect(self.move)
        self.place = QtGui.QLabel("")
        line.addWidget(self.slider)
        line.addWidget(self.place)
        return group

    def machine(self):
        group = QtGui.QGroupBox("To the machine")
        form = QtGui.QFormLayout(group)
        self.name = QtGui.QComboBox()
        # The panel is as wide as the dock, which the longest name of a machine is not.
        self.name.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        self.name.setMinimumContentsLength(8)
        for name, about in flank_operation.machines():
            self.name.addItem(name)
            self.name.setItemData(self.name.count() - 1, about, QtCore.Qt.ToolTipRole)
        self.name.setCurrentText(flank_cam.MACHINE)
        self.spindle, self.feed = self.number(8000, "1/min"), self.number(1000, "mm/min")
        form.addRow("Machine", self.name)
        form.addRow("Spindle", self.spindle)
        form.addRow("Feed", self.feed)
        form.addRow(self.button("Write program…", self.post))
        form.addRow(self.button("To CAM job", self.to_cam_job))
        form.addRow(self.button("Report", self.report))
        return group

    def number(self, value, unit):
        made = QtGui.QSpinBox()
        made.setRange(1, 200000)
        made.setValue(value)
        made.setSuffix(f" {unit}")
        return made

    def show(self):
        obj, state = self.obj, state_of(self.obj)
        self.verdict.setText(obj.Verdict)
        self.verdict.setStyleSheet(f"background: {COLOURS[state]}; color: white; font-weight: bold; padding: 6px; border-radius: 4px")
        self.reasons.setText("\n".join([*obj.Reasons, *(f"Caution: {text}" for text in obj.Cautions)]))
        self.strips = flank_operation.poses_of(obj.Folder) if obj.ToolShape else None
        self.slider.setEnabled(bool(self.strips))

    def run(self):
        self.obj.touch()
        self.obj.Document.recompute()
        self.show()

    def move(self, step):
        if self.strips:
            number, k = flank_operation.move_tool(self.obj, step / STEPS, self.strips)
            self.place.setText(f"pass {number}, point {k}")

    def post(self):
        begin = os.path.join(os.path.expanduser("~"), f"{self.obj.Document.Label}.ngc")
        file, _ = QtGui.QFileDialog.getSaveFileName(self.form, "Program", begin)
        if file:
            self.write(file)

    def write(self, file):
        code, said = flank_operation.post(self.obj, self.name.currentText(), self.spindle.value(), self.feed.value(), file)
        self.message.setText(f"{file}: {'meets' if code == flank_child.MEETS else 'does NOT meet'} the request\n{said.strip()}")

    def to_cam_job(self):
        job = flank_cam.to_cam_job(self.obj, self.spindle.value(), self.feed.value())
        self.message.setText(f"{job.Label} is in the tree, with its tool and the moves. Its post-processor writes them.")

    def report(self):
        subprocess.Popen([flank_child.find_flank(), "view", self.obj.Folder])

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Close)

    def reject(self):
        FreeCADGui.Control.closeDialog()
        FreeCADGui.ActiveDocument.resetEdit()


def open_panel(obj):
    panel = Panel(obj)
    FreeCADGui.Control.showDialog(panel)
    return panel
