"""sweep and design: the command does each of their tasks in a process of its own, and is run here as one."""

import json
import os
import shutil
import signal
import subprocess

from . import _core
from ._jobs import field_words, field_lines

_ERRORS = {2: _core.UsageError, 3: _core.InputError, 4: _core.InternalError}


def _command():
    name = os.environ.get("FLANK_COMMAND", "flank")
    found = shutil.which(name)
    if found is None:
        raise _core.InputError(f"{name}: is no command on the path; install flank, or name its file by FLANK_COMMAND")
    return found


def _told(line):
    """What a line of --progress json tells, or None for a message."""
    try:
        told = json.loads(line)
    except ValueError:
        return None
    return (told["stage"], told["share"]) if isinstance(told, dict) and "share" in told else None


def _answer(words, progress):
    """What the command prints with --json. `progress` is told of its stages; what it raises ends the command."""
    with subprocess.Popen([_command(), *words, "--json", "--progress", "json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True) as child:
        messages = []
        try:
            # The answer is printed at the end, when nothing more is told.
            for line in child.stderr:
                told = _told(line)
                if told is None:
                    messages.append(line.strip())
                elif progress is not None:
                    progress(*told)
            answer = child.stdout.read()
        except BaseException:
            child.send_signal(signal.SIGINT)
            raise
    if child.returncode in (0, 1):
        return json.loads(answer)
    text = "\n".join(filter(None, messages)).removeprefix("flank: ")
    raise _ERRORS.get(child.returncode, _core.InternalError)(text or f"flank ended with {child.returncode}")


def _batch(folder, processes, resume):
    return ["-o", os.fspath(folder), "--processes", str(processes)] + (["--resume"] if resume else [])


def sweep(plan, folder, *, processes=0, resume=False, progress=None):
    """Runs fit or cover on many faces with many tools, as flank sweep does: sweep.json as a dict (docs/schema/sweep.md).

    plan
        A file NAME.toml.
    folder
        For all results; made if there is none.
    processes
        Tasks at a time; 0: one for each core. The results do not depend on it.
    resume
        True keeps the finished tasks of an earlier run.
    progress
        Called as progress(stage, share) with the share in [0, 1] of all the work. What it raises ends the work.

    The command flank must be on the path, or FLANK_COMMAND name its file. Raises UsageError and InputError.
    """
    return _answer(["sweep", os.fspath(plan), *_batch(folder, processes, resume)], progress)


_FIELDS = {field.name: field for field in _core.job_fields("design")}


def design(part, folder, *, processes=0, resume=False, progress=None, **fields):
    """Finds the set of tools that finishes several faces in the least time, as flank design does: design.json as a dict.

    part, folder, processes, resume, progress
        As of sweep; the part is a file, or one that was read.
    """
    given = []
    for name, words in field_words(_FIELDS.values(), fields):
        if name not in _FIELDS:
            raise _core.UsageError(f"{name}: is no field of design; expected {', '.join(_FIELDS)}")
        given += [f"{_FIELDS[name].option}={word}" for word in words]
    file = part.file if isinstance(part, _core.Part) else os.fspath(part)
    return _answer(["design", file, *given, *_batch(folder, processes, resume)], progress)


design.__doc__ += "\n".join(["", *field_lines([field for field in _FIELDS.values() if field.name != "part"])])
