#!/usr/bin/env python3
"""Proves what no tool does better on the faces of faces.txt, and compares it with what fits reached.

usage: compare_bounds.py FLANK FITS... [--list zoo] [--only TEXT] [--timeout 60] [--gap 0.01] [--as-thick]

FITS: folders of results of `compare_fits.py run --results`; of several, as with --option=--radius-min=6, the one with the least ratio counts for a
face. A line for each fit: the bound of `flank bound` without a tool, the largest error of the fit on the whole face (gouge, gouge of other
faces, material left), their ratio, processor seconds. --as-thick: of tools that are nowhere thinner than the one that the fit found; else of
all that its bounds on the radius allow. FLANK_DATA: where the files lie. Ends with 1 if a bound is above what was reached: a false proof.
"""
import argparse
import json
import math
import os
import pathlib
import resource
import statistics
import subprocess
import sys

from compare_fits import HERE, faces

SAMPLING = 1e-3  # of the bound: the largest error of a fit is that of samples


def bound(flank, file, face, tolerance, timeout, more):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = ["timeout", "-s", "INT", str(timeout), flank, "bound", file, "--face", face, "--tolerance", tolerance, "--threads", "1", "--json", *more]
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (json.loads(done.stdout) if done.stdout.startswith("{") else None), seconds


def reached(folder):
    """The largest error of a fit; None where it has no verdict."""
    summary = folder / "summary.json"
    if not summary.exists():
        return None
    figures = json.loads(summary.read_text())
    return max(figures.get(key) or 0.0 for key in ("overcut", "other_faces_overcut", "undercut"))


def thinnest(folder):
    """The smallest radius of a fit's tool, rounded down."""
    return math.floor(1e6 * min(r for _, r, *_ in json.loads((folder / "tool.json").read_text())["samples"])) / 1e6


def compared(flank, file, face, tolerance, timeout, more, error, name):
    """The ratio, the processor seconds, and whether the bound is false; None without a bound. Prints the line."""
    result, seconds = bound(flank, file, face, tolerance, timeout, more)
    if result is None:
        print(f"{name:<44} no bound ({seconds:.1f} s)", flush=True)
        return None
    least = result["least_error"]
    ratio = error / least if least > 0 else float("inf")
    wrong = least > error * (1 + SAMPLING)
    whole = all(target["complete"] for target in result["targets"])
    radius = min(target["radius_min"] for target in result["targets"])
    print(f"{name:<44} radii from {radius:7.3f}  bound {least:8.4f}  reached {error:8.4f}  factor {ratio:7.2f}  {seconds:6.1f} s"
          f"{'' if whole else '  stopped early'}{'  FALSE' if wrong else ''}", flush=True)
    return ratio, seconds, wrong


def arguments_of():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("flank")
    parser.add_argument("fits", type=pathlib.Path, nargs="+")
    parser.add_argument("--list", default="zoo")
    parser.add_argument("--only", default="")
    parser.add_argument("--timeout", type=int, default=60)
    parser.add_argument("--gap", default="0.01")
    parser.add_argument("--as-thick", action="store_true")
    return parser.parse_args()


def main():
    arguments = arguments_of()
    data = pathlib.Path(os.environ.get("FLANK_DATA", HERE / "../../../shared/data"))
    false, ratios, times = 0, [], []
    for _, file, face, tolerance, *options in faces(arguments.list, arguments.only):
        name = "-".join([pathlib.Path(file).stem, face, tolerance, *options]).replace(" ", "")
        least = None
        for folder in (fits / name for fits in arguments.fits):
            error = reached(folder)
            if error is None or not (data / file).exists():
                continue
            more = ["--gap", arguments.gap] + (["--radius-min", repr(thinnest(folder))] if arguments.as_thick else [])
            row = compared(arguments.flank, data / file, face, tolerance, arguments.timeout, more, error, name)
            if row is None:
                continue
            least = min(row[0], least or row[0])
            times.append(row[1])
            false += row[2]
        if least is not None:
            ratios.append(least)
    if ratios:
        print(f"{len(ratios)} faces: {sum(r <= 5 for r in ratios)} within a factor of 5, {sum(r <= 2 for r in ratios)} of 2, {false} false; "
              f"{statistics.median(times):.1f} s in the median, {max(times):.1f} s at most")
    sys.exit(false > 0)


if __name__ == "__main__":
    main()
