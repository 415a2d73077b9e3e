"""The command `flank` as a child process: found, run, watched, stopped. Links nothing, and needs no FreeCAD."""

import json
import os
import shutil
import signal
import subprocess
import tempfile

#: Exit codes of the command.
MEETS, FALLS_SHORT = 0, 1


class FlankError(Exception):
    """The command refused, failed or is not there; the message is its own."""


def find_flank():
    """The command: named by FLANK_BINARY, else in PATH."""
    program = os.environ.get("FLANK_BINARY") or shutil.which("flank")
    if not program:
        raise FlankError("flank is not in PATH; install OpenFlank, or name it by FLANK_BINARY")
    return program


def run(words, progress=None):
    """Runs `flank WORDS`; (exit code, standard output). progress(stage, share) may return False, which stops the child: its best so far is
    kept. Raises FlankError with the command's own line for anything but a verdict."""
    words = [find_flank(), *words]
    # What is printed may be more than a pipe holds while the progress is read from the other one.
    with tempfile.TemporaryFile("w+", encoding="utf-8") as printed:
        child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.PIPE, text=True, encoding="utf-8")
        message = ""
        for line in child.stderr:
            try:
                told = json.loads(line)
            except ValueError:
                message = line.strip() or message
                continue
            if progress and progress(told["stage"], told["share"]) is False:
                child.send_signal(signal.SIGINT)
        code = child.wait()
        printed.seek(0)
        said = printed.read()
    if code not in (MEETS, FALLS_SHORT):
        raise FlankError(message.removeprefix("flank: ") or f"flank ended with {code}")
    return code, said
