#!/usr/bin/env python3
"""The signatures of fit, cover, trochoid, verify and post in openflank/__init__.pyi, from the library's table of fields.

usage: PYTHONPATH=build/release/python scripts/python_stubs.py [--check]   (--check: fails if the file is not what it would write)
"""

import inspect
import pathlib
import sys

import openflank

STUB = pathlib.Path(__file__).parents[1] / "python/openflank/__init__.pyi"
MARK = "# From the library's table of fields: scripts/python_stubs.py writes what follows.\n"
TYPES = {"text": "str", "texts": "Sequence[_File]", "number": "float", "count": "int", "auto or count": "Union[int, Literal[\"auto\"]]",
         "sign": "Literal[1, -1, \"+\", \"-\"]", "switch": "bool"}
FILES = {"part", "tool", "guide", "holder", "catalogue", "folder", "nc", "machine"}
FACES = {"faces", "check_faces", "ignore_faces", "left", "right"}
RESULTS = {"fit": "Result", "cover": "Result", "trochoid": "Result", "verify": "Verification", "post": "Program"}


def type_of(field):
    if field.name == "part":
        return "Union[_File, Part]"
    if field.name in FACES:
        return "Union[str, Sequence[str]]"
    return "_File" if field.kind == "text" and field.name in FILES else TYPES[field.kind]


def stub(command):
    fields = {field.name: field for field in openflank.job_fields(command)}
    lines, keyword_only = [], False
    for parameter in inspect.signature(getattr(openflank, command)).parameters.values():
        if parameter.kind == parameter.KEYWORD_ONLY and not keyword_only:
            lines.append("*")
            keyword_only = True
        if parameter.name == "progress":
            lines.append("progress: _Progress | None = None")
            continue
        kind = type_of(fields[parameter.name])
        if parameter.default is parameter.empty:
            lines.append(f"{parameter.name}: {kind}")
        elif parameter.default is None:
            lines.append(f"{parameter.name}: {kind} | None = None")
        else:
            lines.append(f"{parameter.name}: {kind} = ...")
    return f"def {command}(\n    " + ",\n    ".join(lines) + f",\n) -> {RESULTS[command]}: ...\n"


def main():
    text = STUB.read_text()
    wanted = text[:text.index(MARK)] + MARK + "".join(stub(command) for command in RESULTS)
    if "--check" in sys.argv[1:]:
        if text != wanted:
            sys.exit(f"{STUB} is not what the table of fields says; run scripts/python_stubs.py")
        return
    STUB.write_text(wanted)


if __name__ == "__main__":
    main()
