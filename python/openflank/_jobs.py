"""The commands as functions. Their keywords, defaults and help texts are those of the library's table of fields."""

import inspect
import os
import re
import textwrap

from . import _core


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during fit, cover or trochoid. result: the best so far, unfinished (Result.complete is False)."""

    def __init__(self, result):
        super().__init__("stopped; the best so far is in .result")
        self.result = result


def _words(field, value):
    """The words of a command line that give a value. Faces may be a list; a part may be one that was read."""
    if isinstance(value, _core.Part):
        value = value.file
    if isinstance(value, (str, os.PathLike)):
        return [os.fspath(value)]
    if field.kind == "switch":
        if not isinstance(value, bool):
            raise TypeError(f"{field.name}: expected True or False, not {value!r}")
        return ["on" if value else "off"]
    if field.kind == "sign":
        return ["-" if value == -1 else "+" if value == 1 else str(value)]
    if field.kind == "number":
        return [repr(float(value))]
    if field.kind in ("count", "auto or count"):
        return [str(value.__index__())]
    words = [os.fspath(word) for word in value]
    return words if field.kind == "texts" else [",".join(words)]


def field_words(fields, given):
    """[(name, words)] of those that are given; None leaves a field as it is."""
    known = {field.name: field for field in fields}
    # A name that there is not is told by the library, with those that there are.
    return [(name, _words(known[name], value) if name in known else [str(value)])
            for name, value in given.items() if value is not None]


def _usual(field):
    """The default of a keyword in a signature."""
    if field.usual is None:
        return None
    if field.kind == "switch":
        return field.usual == "on"
    if field.kind == "number":
        return float(field.usual)
    if field.kind == "count" or (field.kind == "auto or count" and field.usual != "auto"):
        return int(field.usual)
    return field.usual


def is_positional(field):
    """Fields that are positional on the command line, or required, may be given without their keyword."""
    return field.needed or not field.option.startswith("-")


def _signature(fields, progress):
    """Those that must be given come first."""
    parameter = inspect.Parameter
    parameters = [parameter(f.name, parameter.POSITIONAL_OR_KEYWORD,
                            default=parameter.empty if f.needed else _usual(f))
                  for f in sorted(filter(is_positional, fields), key=lambda f: not f.needed)]
    parameters += [parameter(f.name, parameter.KEYWORD_ONLY, default=_usual(f)) for f in fields if not is_positional(f)]
    if progress:
        parameters.append(parameter("progress", parameter.KEYWORD_ONLY, default=None))
    return inspect.Signature(parameters)


def _in_python(text, fields):
    """A help text with the keywords in place of the options of the command line."""
    names = {field.option: field.name for field in fields if field.option.startswith("--")}
    return re.sub(r"--[a-z-]+", lambda option: names.get(option[0], option[0]), text)


def field_lines(fields):
    """Name, help, unit and range of each, for a docstring."""
    lines = []
    for field in fields:
        unit = f" [{field.unit}]" if field.unit else ""
        accepted = f" ({_in_python(field.accepted, fields)})" if field.accepted else ""
        text = f"{_in_python(field.help, fields)}{unit}{accepted}."
        lines += [field.name, textwrap.fill(text, 100, initial_indent="    ", subsequent_indent="    ")]
    return lines


def _document(first, fields, progress):
    lines = [first, "", *field_lines(fields)]
    if progress:
        lines += ["progress", "    Called as progress(stage, share), share in [0, 1] of all the work. An exception that it raises ends the run."]
    return "\n".join(lines)


def _function(command, first, run, progress):
    fields = _core.job_fields(command)
    signature = _signature(fields, progress)

    positional = [p for p in signature.parameters.values() if p.kind == p.POSITIONAL_OR_KEYWORD]

    def function(*args, **given):
        callback = given.pop("progress", None) if progress else None
        if len(args) > len(positional):
            raise TypeError(f"{command}() takes {len(positional)} arguments without a keyword, not {len(args)}")
        for parameter, value in zip(positional, args):
            if parameter.name in given:
                raise TypeError(f"{command}() got {parameter.name} twice")
            given[parameter.name] = value
        for parameter in positional:
            if parameter.default is parameter.empty and given.get(parameter.name) is None:
                raise TypeError(f"{command}() needs {parameter.name}")
        return run(command, field_words(fields, given), callback)

    function.__name__ = function.__qualname__ = command
    function.__signature__ = signature
    function.__doc__ = _document(first, fields, progress)
    return function


def _plan(command, fields, callback):
    result, stopped_by = _core.run(command, fields, callback)
    if stopped_by is None:
        return result
    if isinstance(stopped_by, KeyboardInterrupt):
        raise Interrupted(result) from stopped_by
    raise stopped_by


fit = _function("fit", "Finds a tool and a five-axis motion that finish a face, and checks them: a Result.", _plan, True)
cover = _function("cover", "Finds the passes with which a given or chosen tool finishes a face, and checks them: a Result.", _plan, True)
trochoid = _function(
    "trochoid", "Roughs and finishes the cavity between two sides with one tool, and checks it: a Result.", _plan, True)
verify = _function(
    "verify", "Checks the tool and path of a folder, or an NC program: a Verification.",
    lambda command, fields, callback: _core.run_verify(fields), False)
post = _function(
    "post", "Writes the program with which a machine runs the path of a folder: a Program.",
    lambda command, fields, callback: _core.run_post(fields), False)


def report(folder, file=None):
    """Writes the HTML page of a folder of results: report.html in it, or the file. The page's path. Raises InputError."""
    return _core.write_report(folder, file)
