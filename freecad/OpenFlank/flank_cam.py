"""A result as a job of FreeCAD's own CAM workbench (Path before 1.0): a tool bit, its controller, and an operation with the moves."""

import contextlib
import importlib
import os
import re

import FreeCAD
import Path

import flank_operation

#: What the job's tool controller, its post-processor and its own end of the program say.
LEFT_OUT = re.compile(r"^(M0?[2-6]|M30|T\d+|S\d+|G43|G49|%)\b|^$", re.IGNORECASE)
WORD = re.compile(r"([A-Z])(-?[\d.]+)")
#: A machine whose program has linear and rotary words that any post-processor passes on.
MACHINE = "linuxcnc-xyzac-trt"
SECONDS = 60.0


def module(*names):
    """The first of these modules that this FreeCAD has: they moved in 0.21 and in 1.0."""
    for name in names:
        try:
            return importlib.import_module(name)
        except ImportError:
            continue
    raise RuntimeError(f"this FreeCAD has no {names[0]}")


def words_of(line):
    """The words of a line of a program, without its comments and its number."""
    return WORD.findall(re.sub(r"\(.*?\)|;.*", "", line).upper())


def gcode(program):
    """Lines of a program as commands of FreeCAD: one code each, feeds in mm/s. The moves keep their rotary words."""
    lines = []
    for line in program.splitlines():
        words = [(letter, value) for letter, value in words_of(line) if letter != "N"]
        codes = [f"{letter}{float(value):g}" for letter, value in words if letter in "GM"]
        # FreeCAD multiplies every feed by 60 when it writes a program: it takes it for mm/s.
        rest = [f"{letter}{float(value) / SECONDS:.9g}" if letter == "F" else f"{letter}{value}" for letter, value in words if letter not in "GMSTH"]
        kept = [code for code in codes if not LEFT_OUT.match(code)]
        moves = [code for code in kept if code in ("G0", "G1", "G2", "G3")]
        lines += [code for code in kept if code not in moves and code != "G53"]
        if "G53" in kept and rest:
            # In the machine's own coordinates: one command has one code, and the one before it says how it moves.
            lines += [*moves, " ".join(["G53", *rest])]
        elif rest:
            lines.append(" ".join([*(moves or [""]), *rest]).strip())
    return with_codes(lines)


def with_codes(lines):
    """A line without a code repeats the one before: FreeCAD's commands have each their own."""
    out, last = [], "G0"
    for line in lines:
        if re.match(r"G[0-3]( |$)", line):
            last = line.split()[0]
        out.append(line if line[0] in "GM" else f"{last} {line}")
    return out


def require_one_tool(program):
    """Its moves become one operation, which has one tool: those of a wheel's others would be cut with the wrong one."""
    tools = {float(value) for line in program.splitlines() for letter, value in words_of(line) if letter == "T"}
    if len(tools) > 1:
        raise RuntimeError(f"the program has {len(tools)} tools, and the CAM job would have one: write the program instead")


@contextlib.contextmanager
def one_step(document, bits):
    """All that is done in it is one step of undo: with a window FreeCAD's maker of tool bits would begin and end steps of its own."""
    usual, bits.Factory = bits.Factory, bits.ToolBitFactory()
    document.openTransaction("CAM job")
    try:
        yield
    finally:
        bits.Factory = usual
        document.commitTransaction()


def to_cam_job(obj, spindle, feed, machine=MACHINE):
    """Makes the job of a FlankOperation; its operation has the moves of the program for `machine`."""
    file = os.path.join(os.path.dirname(obj.Folder), "cam.ngc")
    flank_operation.post(obj, machine, spindle, feed, file)
    with open(file, encoding="utf-8") as stream:
        program = stream.read()
    require_one_tool(program)
    lines = gcode(program)
    jobs = module("Path.Main.Job", "PathScripts.PathJob")
    bits = module("Path.Tool.Bit", "PathScripts.PathToolBit")
    controllers = module("Path.Tool.Controller", "PathScripts.PathToolController")
    with one_step(obj.Document, bits):
        job = jobs.Create(f"{obj.Label} job", [obj.Proxy.part(obj)])
        for old in list(job.Tools.Group):
            job.Document.removeObject(old.Name)
        tool = bits.Factory.CreateFrom(os.path.join(obj.Folder, "tool.fctb"))
        if FreeCAD.GuiUp:
            module("Path.Base.Gui.IconViewProvider", "PathScripts.PathIconViewProvider").Attach(tool.ViewObject, "ToolBit")
            tool.ViewObject.Visibility = False  # it would stand at the origin
        add_moves(obj, job, controllers.Create(f"{obj.Label} tool", tool=tool, toolNumber=1), lines, (spindle, feed / SECONDS))
    return job


def add_moves(obj, job, controller, lines, rates):
    """The controller of the tool and the operation with the moves; `rates`: of the spindle, 1/min, and of the feed, mm/s."""
    controller.SpindleSpeed, controller.HorizFeed, controller.VertFeed = rates[0], rates[1], rates[1]
    job.Proxy.addToolController(controller)
    operation = module("Path.Op.Custom", "PathScripts.PathCustom").Create(f"{obj.Label} path", parentJob=job)
    operation.ToolController, operation.Gcode = controller, lines
    job.PostProcessor = "linuxcnc"
    job.PostProcessorArgs = "--no-show-editor --precision 5"
    job.Document.recompute()
