#!/usr/bin/env python3
"""Renders the tables of docs/results.md and README.md from bench/results/*.json.

usage: results.py [--check]   (--check changes nothing and ends with 1 if a table is not the one of its file)

A table stands between `<!-- results: NAME -->` and `<!-- end -->`; NAME.json has its rows. A file has either "columns" and rows of cells, or rows
of figures by name, of which a table shows those in "show", else all below that any row has. `<!-- results: trust -->` is made from all files
that bench/run_results.py has measured; `<!-- usable: NAME -->` stands before how many rows of a file are usable,
`<!-- seconds: NAME -->` before the processor time that they take.
"""

import json
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
RESULTS = ROOT / "bench/results"
DOCUMENTS = ("docs/results.md", "README.md")
TABLE = re.compile(r"(<!-- results: ([\w-]+) -->\n).*?(<!-- end -->)", re.DOTALL)
FIGURE = re.compile(r"(<!-- (usable|seconds): ([\w-]+) -->).*?(<!-- end -->)")
NOT_MEASURED = "not measured yet"
MOST_NAMED = 5  # rows that fail, in the table of all sets


def finished(row):
    whole, accessible = row.get("finished"), row.get("of_accessible")
    if whole and accessible:
        return f"{whole} ({accessible})"
    return whole or (f"({accessible})" if accessible else "")


def gouge(row):
    return "; ".join(row[key] for key in ("gouge", "gouge_others") if row.get(key))


def plain(key):
    return lambda row: str(row.get(key, ""))


COLUMNS = {
    "part": ("part", plain("part")),
    "request": ("request", plain("request")),
    "width": ("width, mm", plain("width")),
    "reachable": ("accessible, %", plain("reachable")),
    "finished": ("finished, %", finished),
    "curve": ("L:D: finished, %", plain("curve")),
    "gouge": ("gouge, mm", gouge),
    "excess": ("excess, mm", plain("excess")),
    "ld": ("L:D", plain("ld")),
    "passes": ("passes", plain("passes")),
    "turn": ("turn, degrees", plain("turn")),
    "layers": ("layers", plain("layers")),
    "cycles": ("cycles", plain("cycles")),
    "moves": ("moves, m", plain("moves")),
    "engagement": ("engagement, degrees", plain("engagement")),
    "volume": ("removed, cm^3", plain("volume")),
    "cpu_s": ("CPU s", plain("cpu_s")),
    "verdict": ("verdict", plain("verdict")),
    "by": ("repeatable by", plain("by")),
}


def load(name):
    return json.loads((RESULTS / f"{name}.json").read_text(encoding="utf-8"))


def good(row):
    """Whether the result is usable: of several commands that of each."""
    return all(verdict in ("usable", "meets") for verdict in row["verdict"].split(", "))


def cells(results):
    """Header and rows of a table."""
    if "columns" in results:
        return results["columns"], results["rows"]
    wanted = results["show"].split() if "show" in results else COLUMNS
    rows = [row if "run" not in row or "verdict" in row else row | {"verdict": NOT_MEASURED} for row in results["rows"]]
    shown = [COLUMNS[key] for key in wanted if any(COLUMNS[key][1](row) for row in rows)]
    return [name for name, _ in shown], [[value(row) for _, value in shown] for row in rows]


def lines_of(table):
    return "".join("|" + "|".join(f" {cell} " if cell != "---" else cell for cell in line) + "|\n" for line in table)


def measured_rows(name):
    return [row for row in load(name)["rows"] if isinstance(row, dict) and "run" in row and "verdict" in row]


def failure(row):
    """A sentence: which row fails, and the first of its reasons without its details."""
    why = next(verdict for verdict in row["verdict"].split(", ") if not good({"verdict": verdict}))
    told = f"{row['part']}, {row['request']}: {re.split('[;:] ', why.removeprefix('no: ').removeprefix('meets the request but '))[0]}."
    return told[0].upper() + told[1:]


def trust():
    """How many rows of each measured file are usable, and which are not."""
    lines = [["set", "rows", "usable", "what fails, and why"], ["---"] * 4]
    for file in sorted(RESULTS.glob("*.json")):
        rows = measured_rows(file.stem) if file.stem != "first-page" else []  # the README's are rows of other sets, too
        bad = [failure(row) for row in rows if not good(row)]
        more = [f"And {len(bad) - MOST_NAMED} more, below."] if len(bad) > MOST_NAMED else []
        if rows:
            lines.append([load(file.stem)["title"], str(len(rows)), str(len(rows) - len(bad)), " ".join(bad[:MOST_NAMED] + more)])
    return lines_of(lines)


def usable(name):
    rows = measured_rows(name)
    return f"{sum(map(good, rows))} of {len(rows)}"


def seconds(name):
    """The least and the most of its commands, and the median."""
    times = sorted(float(time) for row in measured_rows(name) for time in row["cpu_s"].split(", "))
    return f"{times[0]:g} to {times[-1]:g} s (median {statistics.median(times):.0f} s)" if times else "an unknown time"


def when(results):
    """Day and commit of the rows; where they are of several runs, the rows of each but the largest by their numbers."""
    runs = {}
    for number, row in enumerate(results["rows"], 1):
        if "verdict" not in row:
            continue
        runs.setdefault((row.get("measured", results["measured"]), row.get("commit", results["commit"])), []).append(number)
    most = max(runs, key=lambda run: len(runs[run]))
    others = sorted(run for run in runs if run != most)
    told = "{} at {}".format(*most)
    for run in others:
        numbers = [str(number) for number in runs[run]]
        listed = ", ".join(numbers[:-1]) + " and " + numbers[-1] if len(numbers) > 1 else numbers[0]
        told += ", row{} {} {} at {}".format("s" if len(numbers) > 1 else "", listed, *run)
    return told


def table(name):
    if name == "trust":
        return trust()
    results = load(name)
    header, rows = cells(results)
    if "source" not in results:
        return "Not measured yet.\n"
    source = f" {when(results)}" if results["source"] == "measured" else f" {results['measured']}, {results['source']}"
    command = f"`{results['command']}`" if "--" in results["command"] else results["command"]
    told = f"Measured{source}: {command}; {results['machine']}.\n\n"
    return told + lines_of([header, ["---"] * len(header), *rows])


def main():
    stale = []
    for name in DOCUMENTS:
        file = ROOT / name
        text = file.read_text(encoding="utf-8")
        rendered = TABLE.sub(lambda match: match[1] + table(match[2]) + match[3], text)
        rendered = FIGURE.sub(lambda match: match[1] + {"usable": usable, "seconds": seconds}[match[2]](match[3]) + match[4], rendered)
        if rendered != text:
            stale.append(name)
            if "--check" not in sys.argv[1:]:
                file.write_text(rendered, encoding="utf-8")
    if stale and "--check" in sys.argv[1:]:
        sys.exit(f"{', '.join(stale)}: not the figures of bench/results; run scripts/results.py")
    print(", ".join(stale) + " written" if stale else "all tables are those of bench/results")


if __name__ == "__main__":
    main()
