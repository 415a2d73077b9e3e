#!/usr/bin/env python3
"""Renders the tables of docs/results.md and README.md from bench/results/*.json.

usage: results.py [--check]   (--check changes nothing and ends with 1 if a table is not the one of its file)

A table stands between `<!-- results: NAME -->` and `<!-- end -->`; NAME.json has its rows. A file has either "columns" and rows of cells, or rows
of figures by name, of which a table shows the columns below that any row has.
"""

import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
RESULTS = ROOT / "bench/results"
DOCUMENTS = ("docs/results.md", "README.md")
TABLE = re.compile(r"(<!-- results: ([\w-]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def finished(row):
    whole, accessible = row.get("finished"), row.get("of_accessible")
    if whole and accessible:
        return f"{whole} ({accessible})"
    return whole or (f"({accessible})" if accessible else "")


def gouge(row):
    return "; ".join(row[key] for key in ("gouge", "gouge_others") if row.get(key))


COLUMNS = (
    ("part", lambda row: row.get("part", "")),
    ("request", lambda row: row.get("request", "")),
    ("finished, %", finished),
    ("gouge, mm", gouge),
    ("L:D", lambda row: row.get("ld", "")),
    ("passes", lambda row: row.get("passes", "")),
    ("CPU s", lambda row: row.get("cpu_s", "")),
    ("verdict", lambda row: row.get("verdict", "")),
    ("repeatable by", lambda row: row.get("by", "")),
)


def cells(results):
    """Header and rows of a table."""
    if "columns" in results:
        return results["columns"], results["rows"]
    shown = [(name, value) for name, value in COLUMNS if any(value(row) for row in results["rows"])]
    return [name for name, _ in shown], [[value(row) for _, value in shown] for row in results["rows"]]


def table(name):
    results = json.loads((RESULTS / f"{name}.json").read_text(encoding="utf-8"))
    header, rows = cells(results)
    lines = [header, ["---"] * len(header), *rows]
    source = f" at {results['commit']}" if results["source"] == "measured" else f", {results['source']}"
    command = f"`{results['command']}`" if "--" in results["command"] else results["command"]
    told = f"Measured {results['measured']}{source}: {command}; {results['machine']}.\n\n"
    return told + "".join("|" + "|".join(f" {cell} " if cell != "---" else cell for cell in line) + "|\n" for line in lines)


def main():
    stale = []
    for name in DOCUMENTS:
        file = ROOT / name
        text = file.read_text(encoding="utf-8")
        rendered = TABLE.sub(lambda match: match[1] + table(match[2]) + match[3], text)
        if rendered != text:
            stale.append(name)
            if "--check" not in sys.argv[1:]:
                file.write_text(rendered, encoding="utf-8")
    if stale and "--check" in sys.argv[1:]:
        sys.exit(f"{', '.join(stale)}: not the figures of bench/results; run scripts/results.py")
    print(", ".join(stale) + " written" if stale else "all tables are those of bench/results")


if __name__ == "__main__":
    main()
