#!/usr/bin/env python3
"""What openflank/__init__.pyi says, from the module itself: docstrings and defaults of all, and the signatures of fit, cover, trochoid,
verify and post from the library's table of fields.

usage: PYTHONPATH=build/release/python scripts/python_stubs.py [--check]   (--check: fails if the file is not what it would write)
"""

import ast
import inspect
import pathlib
import re
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


def told_defaults(thing):
    """Name and source of every default, of a function of Python or of pybind11, which tells them in its docstring alone."""
    if inspect.isfunction(thing):
        return {p.name: repr(p.default) for p in inspect.signature(thing).parameters.values() if p.default is not p.empty}
    first = (thing.__doc__ or "").split("\n")[0]
    return dict(re.findall(r"(\w+): [^=,]*? = ('[^']*'|[-\w.]+)", first))


def told_doc(thing):
    """Its docstring without the signature that pybind11 puts before it."""
    doc = inspect.cleandoc(thing.__doc__ or "")
    return re.sub(r"\A\w+\(.*\) -> .*\n*", "", doc).strip()


def literal(source):
    try:
        ast.literal_eval(source)
        return True
    except (ValueError, SyntaxError):
        return False


def quoted(doc, column):
    """A docstring as source, behind so many blanks."""
    lines = ('"""' + doc.replace("\\", "\\\\")).split("\n")
    if len(lines) == 1:
        lines[0] += '"""'
    else:
        lines.append('"""')
    return "\n".join((" " * column + line).rstrip() for line in lines)


class Edits:
    """Replaced places of a text, by lines and columns as ast gives them."""

    def __init__(self, text):
        self.lines, self.edits = text.splitlines(keepends=True), []

    def replace(self, node, new):
        self.edits.append(((node.lineno, node.col_offset), (node.end_lineno, node.end_col_offset), new))

    def text(self):
        for (row, column), (last, end), new in sorted(self.edits, reverse=True):
            after = self.lines[last - 1][end:]
            self.lines[row - 1:last] = [self.lines[row - 1][:column] + new + after]
        return "".join(self.lines)


def add_doc(edits, node, thing):
    """The docstring of a function or property in place of "...", or of the one that stands there."""
    doc = told_doc(thing)
    if not doc:
        return
    body, new = node.body[0], quoted(doc, node.col_offset + 4)
    stands_alone = edits.lines[body.lineno - 1][:body.col_offset].strip() == ""
    edits.replace(body, new.lstrip() if stands_alone else "\n" + new)


def add_to_function(edits, node, thing):
    defaults = told_defaults(thing)
    with_default = node.args.args[len(node.args.args) - len(node.args.defaults):]
    pairs = [*zip(with_default, node.args.defaults), *(pair for pair in zip(node.args.kwonlyargs, node.args.kw_defaults) if pair[1])]
    for argument, default in pairs:
        if isinstance(default, ast.Constant) and default.value is Ellipsis and literal(defaults.get(argument.arg, "<")):
            edits.replace(default, defaults[argument.arg])
    add_doc(edits, node, thing)


def complete(text):
    """The stub with docstrings and defaults of every public class and function."""
    edits = Edits(text)
    for node in ast.parse(text).body:
        thing = getattr(openflank, getattr(node, "name", ""), None)
        if isinstance(node, ast.FunctionDef) and thing is not None:
            add_to_function(edits, node, thing)
        elif isinstance(node, ast.ClassDef) and thing is not None:
            for member in node.body:
                if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                    value = inspect.getattr_static(thing, member.name)
                    add_to_function(edits, member, getattr(thing, member.name) if isinstance(value, staticmethod) else value)
    return re.sub(r":[ ]+\n", ":\n", edits.text())


def main():
    text = STUB.read_text()
    wanted = complete(text[:text.index(MARK)] + MARK + "".join(stub(command) for command in RESULTS))
    if "--check" in sys.argv[1:]:
        if text != wanted:
            sys.exit(f"{STUB} is not what the table of fields says; run scripts/python_stubs.py")
        return
    STUB.write_text(wanted)


if __name__ == "__main__":
    main()
