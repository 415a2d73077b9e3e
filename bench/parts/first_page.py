#!/usr/bin/env python3
"""Measures the rows of README.md in one run and writes bench/results/first-page.json; scripts/results.py then renders the table.

usage: first_page.py FLANK OUT [NUMBER...]   (OUT: a folder for parts and results; NUMBER: these rows alone, from 1, and no file is written)

Every figure is the judge's. One thread; seconds are processor time of the whole command.
"""
import datetime
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("FLANK_DATA", ROOT / "../shared/data"))
ROTOR, BLISK = ["rotor37"], ["rotor37-blisk"]
CAVITY = ["cavity", "--width", "35", "--depth", "42", "--length", "50", "--twist", "16"]
ROWS = (  # what, example or file, request in words, command, for each of: arguments
    ("NASA Rotor 37 blade F1, F3", ROTOR, "free tool, one pass over the full height, 0.1 mm", "fit --strips 1 --tolerance 0.1", ("--face F1", "--face F3")),
    ("NASA Rotor 37 blade F1, F3", ROTOR, "given cylinder of radius 5 mm, 0.05 mm", "cover --tool cylinder:radius=5 --axis-length 20 --tolerance 0.05",
     ("--face F1", "--face F3")),
    ("Rotor 37 blisk sector F9, F11, beside hub and neighbour", BLISK, "free tool, 0.1 mm, no collision", "fit --strips 1 --tolerance 0.1",
     ("--face F9", "--face F11")),
    ("KJ66 compressor wheel F1, F3, alone", "kj66_impeller.step", "free tool, 0.01 mm", "fit --avoid off --strips 1 --tolerance 0.01",
     ("--face F1", "--face F3")),
    ("cavity between the two blades of Rotor 37", BLISK, "`flank trochoid`, two layers, one free tool, engagement at most 60 degrees, 0.1 mm",
     "trochoid --left F9 --right F11 --floor F1 --layers 2 --tolerance 0.1", ("",)),
    ("cavity of 35 x 42 x 50 mm", CAVITY, "`flank trochoid`, one layer, 0.02 mm", "trochoid --left F1 --right F2 --tolerance 0.02", ("",)),
)


def part_of(flank, out, source):
    """The file of a part, made if it is an example; none if it is not there."""
    if isinstance(source, str):
        return next(DATA.rglob(source), None)
    file = out / f"{source[0]}.step"
    if not file.exists():
        subprocess.run([flank, "example", *source, "-o", file, "--quiet"], check=True)
    return file


def run(flank, part, words, folder):
    """The summary, and processor time in seconds."""
    child = subprocess.Popen([flank, words[0], part, *words[1:], "--threads", "1", "--quiet", "-o", folder])
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return json.loads((folder / "summary.json").read_text()), usage.ru_utime + usage.ru_stime


def row(flank, out, number):
    what, source, request, command, each = ROWS[number]
    part = part_of(flank, out, source)
    if part is None:
        return None
    found = [run(flank, part, (command + " " + more).split(), out / f"row-{number + 1}-{k}") for k, more in enumerate(each)]

    def figures(form, *keys):
        values = [next((s[key] for key in keys if s.get(key) is not None), None) for s, _ in found]
        return ", ".join("" if value is None else form.format(value) for value in values)

    percent = [{key: 100 * s[key] for key in ("coverage", "coverage_reachable") if s.get(key) is not None} for s, _ in found]
    return {"part": what, "request": request, "finished": ", ".join(f"{p['coverage']:.2f}" for p in percent),
            "of_accessible": ", ".join(f"{p.get('coverage_reachable', p['coverage']):.2f}" for p in percent),
            "gouge": figures("{:.4f}", "overcut"), "gouge_others": figures("{:.4f}", "other_faces_overcut"), "slip": figures("{:.2f}", "largest_c"),
            "ld": figures("{:.1f}", "slenderness"), "passes": "" if command.startswith("trochoid") else figures("{}", "strips"), "cpu_s": ", ".join(f"{seconds:.0f}" for _, seconds in found),
            "verdict": ", ".join("meets" if s.get("pass") else "no" for s, _ in found), "by": "data folder" if isinstance(source, str) else "anyone"}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    flank, out, chosen = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), [int(number) - 1 for number in sys.argv[3:]]
    out.mkdir(parents=True, exist_ok=True)
    rows = []
    for number in chosen or range(len(ROWS)):
        rows.append(row(flank, out, number))
        print(json.dumps(rows[-1]), flush=True)
    if chosen or None in rows:
        return
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    head = {"schema": "openflank/bench-results/1", "measured": datetime.date.today().isoformat(), "source": "measured", "commit": commit,
            "command": "bench/parts/first_page.py", "machine": "one thread"}
    lines = ",\n".join("  " + json.dumps(one, ensure_ascii=False) for one in rows)
    (ROOT / "bench/results/first-page.json").write_text(json.dumps(head, indent=1)[:-2] + ',\n "rows": [\n' + lines + "\n ]\n}\n")


if __name__ == "__main__":
    main()
