#!/usr/bin/env python3
"""Proves what no tool does better on the faces of faces.txt, and compares it with what fits reached.

usage: compare_bounds.py FLANK FITS [--list zoo] [--only TEXT] [--timeout 60] [--as-thick]

FITS: the folder of results of `compare_fits.py run --results`. A line for each face: the bound of `flank bound` without a tool, the largest error of
the fit on the whole face (gouge, gouge of other faces, material left), their ratio, processor seconds. --as-thick: of tools that are nowhere
thinner than the one that the fit found; else of all that its bounds on the radius allow. FLANK_DATA: where the files lie. Ends with 1 if
a bound is above what was reached: a false proof.
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


def bound(flank, file, face, tolerance, timeout, radius):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = ["timeout", "-s", "INT", str(timeout), flank, "bound", file, "--face", face, "--tolerance", tolerance, "--threads", "1", "--json", *radius]
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("flank")
    parser.add_argument("fits", type=pathlib.Path)
    parser.add_argument("--list", default="zoo")
    parser.add_argument("--only", default="")
    parser.add_argument("--timeout", type=int, default=60)
    parser.add_argument("--as-thick", action="store_true")
    arguments = parser.parse_args()
    data = pathlib.Path(os.environ.get("FLANK_DATA", HERE / "../../../shared/data"))
    false, ratios, times = 0, [], []
    for _, file, face, tolerance, *options in faces(arguments.list, arguments.only):
        name = "-".join([pathlib.Path(file).stem, face, tolerance, *options]).replace(" ", "")
        error = reached(arguments.fits / name)
        if error is None or not (data / file).exists():
            continue
        radius = ["--radius-min", repr(thinnest(arguments.fits / name))] if arguments.as_thick else []
        result, seconds = bound(arguments.flank, data / file, face, tolerance, arguments.timeout, radius)
        if result is None:
            print(f"{name:<44} no bound ({seconds:.1f} s)", flush=True)
            continue
        least = result["least_error"]
        ratio = error / least if least > 0 else float("inf")
        wrong = least > error * (1 + SAMPLING)
        false += wrong
        ratios.append(ratio)
        times.append(seconds)
        whole = all(target["complete"] for target in result["targets"])
        print(f"{name:<44} bound {least:8.4f}  reached {error:8.4f}  factor {ratio:7.1f}  {seconds:6.1f} s"
              f"{'' if whole else '  stopped early'}{'  FALSE' if wrong else ''}", flush=True)
    if ratios:
        print(f"{len(ratios)} faces: {sum(r <= 5 for r in ratios)} within a factor of 5, {sum(r <= 2 for r in ratios)} of 2, {false} false; "
              f"{statistics.median(times):.1f} s in the median, {max(times):.1f} s at most")
    sys.exit(false > 0)


if __name__ == "__main__":
    main()
