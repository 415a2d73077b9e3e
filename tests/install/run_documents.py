#!/usr/bin/env python3
"""Runs the commands of a document as they are printed, in a new folder, one after the other.

usage: run_documents.py FLANK FILE
       run_documents.py FLANK help COMMAND...   (the examples in the help of these commands, one after the other in one folder)

Of blocks marked `sh`, each line that begins with `flank` is run, but for those whose comment begins with "long" or "needs". A comment that
begins with "exit N" names the exit code; else it is 0. A block marked `toml` is what the document calls plan.toml. Each command of the
README must end within 15 s of one processor, and none of them is called long.
"""

import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

README_S = 15.0  # of one processor, each command of the README
LONGEST_S = 120.0  # a command that takes more belongs to those marked as long


def blocks(text):
    return re.findall(r"^```(\w+)\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def commands(block):
    """(the line, its exit code) of what is to be run."""
    for line in block.splitlines():
        command, _, comment = line.partition(" #")
        comment = comment.strip()
        if not command.startswith("flank ") or comment.startswith(("long", "needs")):
            continue
        code = re.match(r"exit (\d)", comment)
        yield command.strip(), int(code[1]) if code else 0


def processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(command, code, most_s, folder, path):
    begin = processor_s()
    done = subprocess.run(["bash", "-c", command], cwd=folder, env={**os.environ, "PATH": path, "FLANK_CACHE": "off"}, capture_output=True, text=True)
    took = processor_s() - begin
    print(f"{took:6.1f} s  exit {done.returncode}  {command}", flush=True)
    if done.returncode != code:
        return f"{command}: exit {done.returncode}, not {code}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
    return f"{command}: {took:.1f} s of a processor; at most {most_s:g}" if took > most_s else None


def help_examples(flank, names):
    """The examples of these commands as a block of commands: lines of the help that begin with flank, each with what a backslash joins to it."""
    lines = []
    for name in names:
        text = subprocess.run([flank, name, "--help"], check=True, capture_output=True, text=True).stdout.replace("\\\n", "")
        lines += [" ".join(line.split()) for line in text.splitlines() if line.startswith("  flank ")]
    return "\n".join(lines)


def main():
    flank, document = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    path = f"{flank.parent}:{os.environ['PATH']}"
    texts = [("sh", help_examples(flank, sys.argv[3:]))] if document.name == "help" else blocks(document.read_text(encoding="utf-8"))
    readme, number, faults = document.name == "README.md", 0, []
    if readme and any("# long" in block for _, block in texts):
        faults.append(f"{document}: a command is called long; docs/longer-runs.md is for those")
    with tempfile.TemporaryDirectory() as folder:
        for language, block in texts:
            if language == "toml":
                (pathlib.Path(folder) / "plan.toml").write_text(block, encoding="utf-8")
            if language != "sh":
                continue
            lines = list(commands(block))
            for command, code in lines:
                fault = run(command, code, README_S if readme else LONGEST_S, folder, path)
                faults += [fault] if fault else []
            number += len(lines)
    if number == 0:
        faults.append(f"{document}: no command was run")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
