"""The command `flank` as a child process: found, run, watched, stopped. Links nothing, and needs no FreeCAD."""

import json
import os
import queue
import shutil
import signal
import subprocess
import tempfile
import threading

#: Exit codes of the command.
MEETS, FALLS_SHORT = 0, 1
#: Seconds between two calls of a progress while the command says nothing: a Stop is heard that soon.
TICK = 0.05


class FlankError(Exception):
    """The command refused, failed or is not there; the message is its own."""


def find_flank():
    """The command: named by FLANK_BINARY, else in PATH."""
    program = os.environ.get("FLANK_BINARY") or shutil.which("flank")
    if not program:
        raise FlankError("flank is not in PATH; install OpenFlank, or name it by FLANK_BINARY")
    return program


def _read(stream, lines):
    for line in stream:
        lines.put(line)
    lines.put(None)


def run(words, progress=None):
    """Runs `flank WORDS`; (exit code, standard output). progress(told) is called with every line of progress, a dict with stage and share, and
    with None from time to time; it may return False, which stops the child: its best so far is kept. Raises FlankError with the
    command's own line for anything but a verdict."""
    words = [find_flank(), *words]
    # What is printed may be more than a pipe holds while the progress is read from the other one.
    with tempfile.TemporaryFile("w+", encoding="utf-8") as printed:
        child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.PIPE, text=True, encoding="utf-8")
        message, lines, stopped = "", queue.Queue(), False
        threading.Thread(target=_read, args=(child.stderr, lines), daemon=True).start()
        while True:
            told = None
            try:
                line = lines.get(timeout=TICK)
                if line is None:
                    break
                told = json.loads(line)
            except queue.Empty:
                pass
            except ValueError:
                message = line.strip() or message
            if progress and progress(told) is False and not stopped:
                child.send_signal(signal.SIGINT)
                stopped = True
        code = child.wait()
        printed.seek(0)
        said = printed.read()
    if stopped and code == -signal.SIGINT:
        # Before it could answer: then there was nothing to keep.
        return FALLS_SHORT, ""
    if code not in (MEETS, FALLS_SHORT):
        raise FlankError(message.removeprefix("flank: ") or f"flank ended with {code}")
    return code, said
