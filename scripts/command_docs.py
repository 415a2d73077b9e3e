#!/usr/bin/env python3
"""Man pages and the completion of bash for the command, from its own help texts.

usage: command_docs.py FLANK FOLDER   (FOLDER/man/flank.1.gz, flank-fit.1.gz, ...; FOLDER/completions/flank)
"""

import gzip
import json
import pathlib
import re
import subprocess
import sys

COMPLETION = """# Completion of bash for flank.
_flank() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options= words=
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W "%(commands)s help --help --version" -- "$word"))
        return
    fi
    case ${COMP_WORDS[1]} in
        help) words="%(commands)s" ;;
%(cases)s
    esac
    case ${COMP_WORDS[1]}:$before in
%(values)s
    esac
    if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
    else
        # A value may be the name of a file as well.
        COMPREPLY=($(compgen -W "$words" -- "$word") $(compgen -f -- "$word"))
    fi
}
complete -o filenames -F _flank flank
"""


def ask(program, *words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


class Help:
    """A help text in pieces: what it does, how it is used, headings with (entry, text), and what follows them."""

    def __init__(self, text):
        lines = text.splitlines()
        begin = next(k for k, line in enumerate(lines) if line.startswith("Usage: "))
        self.does = " ".join(lines[:begin])
        self.usage = lines[begin].removeprefix("Usage: ")
        self.sections, self.rest = [], []
        in_sentence = False  # the line before belongs to one that goes on
        for line in lines[begin + 1:]:
            before, in_sentence = in_sentence, False
            if re.fullmatch(r"\S.*:", line):
                self.sections.append((line[:-1], []))
            elif line.startswith("   ") and self.sections:
                self.add(line.strip())
            elif line.startswith("  ") and self.sections:
                entry, _, told = line.strip().partition("  ")
                self.sections[-1][1].append((entry, [told.strip()] if told.strip() else []))
            elif line.strip():
                self.rest[-1:] = [f"{self.rest[-1]} {line.strip()}"] if before else [*self.rest[-1:], line.strip()]
                in_sentence = True

    def add(self, line):
        """The next line of an entry: of its text, or of a command that ends with a backslash."""
        entry, told = self.sections[-1][1][-1]
        if entry.endswith(" \\"):
            self.sections[-1][1][-1] = (entry[:-1] + line, told)
        else:
            told.append(line)

    def options(self):
        return [name for _, entries in self.sections for entry, _ in entries if entry.startswith("-")
                for name in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", entry.split(" ")[0])]

    def commands(self):
        """Of the whole program's help: all entries that are no options."""
        return [entry for _, entries in self.sections for entry, _ in entries if not entry.startswith("-")]


def names_of_machines(program):
    return [machine["name"] for machine in json.loads(ask(program, "machine", "--list", "--json"))["machines"]]


def listed(program, command, before, after):
    """The words of a list that stands in a help text."""
    text = " ".join(ask(program, command, "--help").split())
    found = re.search(re.escape(before) + r"([^()]*?)" + re.escape(after), text)
    if found is None:
        sys.exit(f"command_docs: the help of {command} has no list behind '{before}'")
    return found[1].replace(",", " ").split()


def values(program, pages):
    """(command, option or position, words): what a user may write there."""
    families = listed(program, "tool", "A family (", ")")
    words = {"machine": names_of_machines(program), "tool": ["free", "catalogue", *families], "unit": ["mm", "cm", "m", "in"]}
    for command in pages:
        if command in ("fit", "cover", "trochoid", "verify", "post"):
            for field in json.loads(ask(program, "fields", command))["fields"]:
                given = {"switch": ["on", "off"], "sign": ["+", "-"]}.get(field["kind"], field.get("choices", []))
                if given and not field.get("flag"):
                    yield command, field["option"], given
        for option in pages[command].options():
            if option.removeprefix("--") in words:
                yield command, option, words[option.removeprefix("--")]
    yield "example", "example", listed(program, "example", "One of: ", " Options:")
    yield "machine", "machine", words["machine"]
    yield "tool", "tool", families
    yield "fields", "fields", ["fit", "cover", "trochoid", "verify", "post"]


def roff(text):
    """Text that means itself: a backslash, a minus, and a point or quote at the beginning of a line."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def man_page(name, help_text, version, others):
    parts = [f'.TH {name.upper()} 1 "" "OpenFlank {version}"', ".SH NAME", f"{roff(name)} \\- {roff(help_text.does)}", ".SH SYNOPSIS",
             f".B {roff(help_text.usage)}"]
    for heading, entries in help_text.sections:
        if heading == "Example":
            heading = "Examples"
        parts.append(f'.SH "{roff(heading.upper())}"')
        for entry, told in entries:
            parts += [".TP", f".B {roff(entry)}", *([roff(" ".join(told))] if told else [])]
    for line in help_text.rest:
        heading, colon, told = line.partition(": ")
        if colon and heading == "Exit status":
            parts += [".SH \"EXIT STATUS\"", roff(told)]
        else:
            parts += [".PP", roff(line)]
    parts += ['.SH "SEE ALSO"', ", ".join(f"{roff(other)}(1)" for other in others)]
    return "\n".join(parts) + "\n"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    (folder / "man").mkdir(parents=True, exist_ok=True)
    (folder / "completions").mkdir(exist_ok=True)
    version = ask(program, "--version").strip()
    whole = Help(ask(program, "--help"))
    helps = {command: Help(ask(program, command, "--help-all")) for command in whole.commands()}
    cases = [f"        {command}) options=\"{' '.join(page.options())}\" ;;" for command, page in helps.items()]
    known = [f"        {command}:{before}) words=\"{' '.join(words)}\" ;;" for command, before, words in values(program, helps)]
    pages = {"flank": whole, **{"flank-" + command: page for command, page in helps.items()}}
    for name, page in pages.items():
        text = man_page(name, page, version, [other for other in pages if other != name])
        # Without a time: the same help, the same bytes.
        (folder / "man" / f"{name}.1.gz").write_bytes(gzip.compress(text.encode(), mtime=0))
    text = COMPLETION % {"commands": " ".join(helps), "cases": "\n".join(cases), "values": "\n".join(known)}
    (folder / "completions/flank").write_text(text)


if __name__ == "__main__":
    main()
