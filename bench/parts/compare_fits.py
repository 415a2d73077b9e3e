#!/usr/bin/env python3
"""Fits faces of parts that no method was made on, and compares what two programs make of them.

usage: compare_fits.py run FLANK OUT.json [--list zoo] [--only NAME] [--jobs 2] [--parts FOLDER] [--results FOLDER] [--timeout 600]
                       [--option=--shank=none]...
       compare_fits.py show A.json
       compare_fits.py diff BEFORE.json AFTER.json

`run` reads faces.txt beside this file and writes a row for each face, with one thread each. FLANK_DATA: where zoo, faults and peer lie;
--parts: where make_parts.py and more_parts.py wrote theirs. `diff` exits with 1 if a verdict is lost, or if more than 0.3 % of a whole face is.

Every figure is the judge's but `turn`, which this script works out from path.json alone: the largest turn, in degrees, within any stretch of 1 %
of the face's diagonal, of the motion as one curve of six numbers (tip and upper end of the axis). "usable": it meets the request, slenderness at
most 8, |c| below 1, a turn of at most 15 degrees.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
COLUMNS = ("pass", "usable", "coverage", "coverage_reachable", "overcut", "turn", "largest_c", "slenderness", "strips", "seconds", "megabytes")
LOST = 0.003  # of the whole face


def largest_turn(folder, diagonal):
    length = json.loads((folder / "tool.json").read_text())["samples"][-1][0]
    window, largest = .01 * diagonal * math.sqrt(2), 0.0
    for strip in json.loads((folder / "path.json").read_text())["strips"]:
        ends = [list(p[:3]) + [p[k] + p[k + 3] * length for k in range(3)] for p in strip["poses"]]
        directions, at, way, first = [], [], 0.0, 0
        for a, b in zip(ends, ends[1:]):
            step = math.dist(a, b)
            if step > 1e-7:
                directions.append([(y - x) / step for x, y in zip(a, b)])
                at.append(way + step / 2)
            way += step
        for i, d in enumerate(directions):
            while at[i] - at[first] > window:
                first += 1
            least = min((sum(x * y for x, y in zip(d, e)) for e in directions[first:i]), default=1.0)
            largest = max(largest, math.degrees(math.acos(max(-1.0, min(1.0, least)))))
    return largest


def faces(name, only):
    for line in (HERE / "faces.txt").read_text().splitlines():
        words = line.split()
        if words and not line.startswith("#") and name in ("all", words[0]) and (not only or only in line):
            yield words


def fit(flank, words, parts, results, timeout, more):
    name, file, face, tolerance, *options = words
    data = pathlib.Path(os.environ.get("FLANK_DATA", HERE / "../../../shared/data"))
    part = (parts if name == "made" else data) / file
    row = {"face": " ".join([file, face, tolerance, *options]), "list": name}
    if not part.exists():
        return row | {"missing": True}
    out = results / "-".join([pathlib.Path(file).stem, face, tolerance, *options]).replace(" ", "")
    log = results / (out.name + ".log")
    command = [flank, "fit", part, "--face", face, "--tolerance", tolerance, "--threads", "1", "--quiet", *options, *more, "-o", out]
    with open(log, "w") as text:
        child = subprocess.Popen(["timeout", "-s", "INT", "-k", "60", str(timeout), *command], stdout=text, stderr=text)
        _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    row |= {"exit": child.returncode, "seconds": round(usage.ru_utime + usage.ru_stime, 1), "megabytes": usage.ru_maxrss // 1024}
    if not (out / "summary.json").exists():
        return row | {"pass": False, "usable": False}
    s = json.loads((out / "summary.json").read_text())
    row |= {key: s.get(key) for key in ("coverage", "coverage_reachable", "overcut", "largest_c", "slenderness", "strips", "axis_length")}
    row |= {"pass": s["pass"] and s["complete"], "turn": round(largest_turn(out, s["diagonal"]), 1),
            "reasons": [reason["figure"] for reason in s["reasons"]]}
    row["usable"] = row["pass"] and s["slenderness"] <= 8 and s["largest_c"] < 1 and row["turn"] <= 15
    return row


def run(arguments):
    rows, results = [], pathlib.Path(arguments.results or tempfile.mkdtemp())
    results.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        tasks = [pool.submit(fit, arguments.flank, words, arguments.parts, results, arguments.timeout, arguments.option)
                 for words in faces(arguments.list, arguments.only)]
        for task in tasks:
            rows.append(task.result())
            print(line(rows[-1]), flush=True)
            arguments.out.write_text(json.dumps(rows, indent=1))
    summary(rows)


def text(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def line(row):
    shares = {key: 100 * row[key] for key in ("coverage", "coverage_reachable") if row.get(key) is not None}
    return "| " + " | ".join([row["face"], *(text((row | shares).get(key)) for key in COLUMNS), ", ".join(row.get("reasons", []))]) + " |"


def summary(rows):
    rows = [row for row in rows if not row.get("missing")]
    seconds = sorted(row["seconds"] for row in rows)
    print(f"\n{len(rows)} faces: {sum(row['pass'] for row in rows)} meet the request, {sum(row['usable'] for row in rows)} are usable; "
          f"{statistics.median(seconds):.1f} s of one processor in the median, {seconds[int(.9 * (len(seconds) - 1))]:.1f} s at 90 %; "
          f"at most {max(row['megabytes'] for row in rows)} MB; turn above 15 degrees of {sum(row.get('turn', 0) > 15 and row['pass'] for row in rows)} that meet it")


def show(path):
    rows = json.loads(path.read_text())
    print("| face | " + " | ".join(COLUMNS) + " | reasons |\n|" + "---|" * (len(COLUMNS) + 2))
    for row in rows:
        print(line(row))
    summary(rows)


def diff(before, after):
    old, lost = {row["face"]: row for row in json.loads(before.read_text())}, 0
    print("| face | meets | usable | whole face, % | turn | slenderness | strips | s |\n|" + "---|" * 8)
    for row in json.loads(after.read_text()):
        was = old.get(row["face"], {"missing": True})
        if row.get("missing") or was.get("missing"):
            continue
        worse = (was["pass"] and not row["pass"]) or (row.get("coverage") or 0) < (was.get("coverage") or 0) - LOST
        lost += worse
        pairs = [f"{text(was.get(key))} -> {text(row.get(key))}" for key in ("pass", "usable", "coverage", "turn", "slenderness", "strips", "seconds")]
        print(f"| {row['face']}{' **worse**' if worse else ''} | " + " | ".join(pairs) + " |")
    for name in (before, after):
        summary(json.loads(name.read_text()))
    return lost > 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("run")
    one.add_argument("flank")
    one.add_argument("out", type=pathlib.Path)
    one.add_argument("--list", default="zoo")
    one.add_argument("--only")
    one.add_argument("--jobs", type=int, default=2)
    one.add_argument("--parts", type=pathlib.Path, default=pathlib.Path("build/parts"))
    one.add_argument("--results")
    one.add_argument("--timeout", type=int, default=900)
    one.add_argument("--option", action="append", default=[], help="for every fit, as --option=--shank=none; diff tells what it does")
    commands.add_parser("show").add_argument("rows", type=pathlib.Path)
    two = commands.add_parser("diff")
    two.add_argument("before", type=pathlib.Path)
    two.add_argument("after", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.command == "run":
        run(arguments)
    elif arguments.command == "show":
        show(arguments.rows)
    else:
        sys.exit(diff(arguments.before, arguments.after))


if __name__ == "__main__":
    main()
