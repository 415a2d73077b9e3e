#!/usr/bin/env python3
"""Man pages and the completion of bash for the command, from its own help texts.

usage: command_docs.py FLANK FOLDER   (FOLDER/man/flank.1.gz, flank-fit.1.gz, ...; FOLDER/completions/flank)
"""

import gzip
import pathlib
import re
import subprocess
import sys

COMPLETION = """# Completion of bash for flank.
_flank() {
    local word=${COMP_WORDS[COMP_CWORD]} options
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W "%(commands)s --help --version" -- "$word"))
        return
    fi
    case ${COMP_WORDS[1]} in
%(cases)s
    esac
    if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
    else
        COMPREPLY=($(compgen -f -- "$word"))
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
        self.does = lines[0]
        self.usage = next(line for line in lines if line.startswith("Usage: ")).removeprefix("Usage: ")
        self.sections, self.rest = [], []
        for line in lines[lines.index("Usage: " + self.usage) + 1:]:
            if re.fullmatch(r"\S.*:", line):
                self.sections.append((line[:-1], []))
            elif line.startswith("   ") and self.sections:
                self.sections[-1][1][-1][1].append(line.strip())
            elif line.startswith("  ") and self.sections:
                entry, _, told = line.strip().partition("  ")
                self.sections[-1][1].append((entry, [told.strip()] if told.strip() else []))
            elif line.strip():
                self.rest.append(line.strip())

    def options(self):
        return [name for _, entries in self.sections for entry, _ in entries
                for name in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", entry.split(" ")[0])]


def roff(text):
    """Text that means itself: a backslash, a minus, and a point or quote at the beginning of a line."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def man_page(name, help_text, version, others):
    parts = [f'.TH {name.upper()} 1 "" "OpenFlank {version}"', ".SH NAME", f"{roff(name)} \\- {roff(help_text.does)}", ".SH SYNOPSIS",
             f".B {roff(help_text.usage)}"]
    for heading, entries in help_text.sections:
        parts.append(f'.SH "{roff(heading.upper())}"')
        for entry, told in entries:
            parts += [".TP", f".B {roff(entry)}", roff(" ".join(told))]
    for line in help_text.rest:
        heading, colon, told = line.partition(": ")
        if colon and heading in ("Example", "Examples", "Exit"):
            parts += [f'.SH "{ {"Exit": "EXIT STATUS"}.get(heading, "EXAMPLES") }"', roff(told)]
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
    commands = [entry for heading, entries in whole.sections if heading == "Subcommands" for entry, _ in entries]
    pages, cases = {"flank": whole}, []
    for command in commands:
        pages["flank-" + command] = Help(ask(program, command, "--help"))
        cases.append(f"        {command}) options=\"{' '.join(pages['flank-' + command].options())}\" ;;")
    for name, page in pages.items():
        text = man_page(name, page, version, [other for other in pages if other != name])
        # Without a time: the same help, the same bytes.
        (folder / "man" / f"{name}.1.gz").write_bytes(gzip.compress(text.encode(), mtime=0))
    (folder / "completions/flank").write_text(COMPLETION % {"commands": " ".join(commands), "cases": "\n".join(cases)})


if __name__ == "__main__":
    main()
