#!/usr/bin/env python3
"""Fits a tool to faces of the parts of make_parts.py and more_parts.py, nothing given but a thousandth of the face's size as the tolerance, and prints a table.

usage: fit_parts.py FLANK FOLDER [NAME...]   (FOLDER: where the parts are; what is not there is left out; results go below it)

Every figure is the judge's. "usable": within what was asked, slenderness at most 8, |c| below 1, no turn above 10 degrees.
"""
import json
import pathlib
import resource
import subprocess
import sys

FACES = {  # file (a STEP file's without its ending), faces, a thousandth of their diagonal
    "turbine_blade": (("F1", "F3"), 0.12), "fan_blade": (("F1", "F3"), 0.52), "micro_blade": (("F1", "F3"), 0.0066),
    "ruled_vane": (("F1", "F3"), 0.057), "marine_propeller": (("F2", "F3"), 0.1), "blisk3": (("F8", "F10"), 0.045),
    "splitter_impeller": (("F1", "F7"), 0.047), "helical_gear": (("F5", "F7"), 0.033), "pocket": (("F7a",), 0.28),
    "channel": (("F3", "F5"), 0.155),
    "kaplan_runner": (("F2", "F4"), 0.38), "francis_blade.brep": (("F1", "F3"), 0.28), "closed_blade": (("F1",), 0.065),
    "winglet": (("F1", "F3"), 1.7), "roots_rotor": (("F1", "F2"), 0.13), "scroll": (("F4", "F6"), 0.09),
    "bevel_gear": (("F5", "F8"), 0.037), "worm": (("F2", "F4"), 0.067), "mould": (("F1", "F14"), 0.057),
    "closed_impeller": (("F3", "F5"), 0.12), "dense_blisk": (("F6", "F8"), 0.036), "swept_fan": (("F1", "F7"), 0.13),
    "tiny_impeller": (("F1", "F8"), 0.0031), "drone_blade.iges": (("F1", "F3"), 0.058),
    "francis_blade_m.stl": (("F1", "F2"), 0.28), "guide_vane_in.stl": (("F1", "F2"), 0.12),
}
UNITS = {"_m.stl": "m", "_in.stl": "in"}  # of a mesh, by the end of its name


def file_of(folder, part):
    return folder / (part if "." in part else f"{part}.step")


def fit(flank, folder, part, face, tolerance):
    out, unit = folder / f"{part}-{face}", [unit for end, unit in UNITS.items() if part.endswith(end)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([flank, "fit", file_of(folder, part), "--face", face, "--tolerance", str(tolerance), "--threads", "1",
                    "--quiet", "-o", out] + (["--unit", *unit] if unit else []), check=False)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if not (out / "summary.json").exists():
        return f"| {part} {face} | {tolerance} | no result | | | | | | {seconds:.0f} | no |", False
    s = json.loads((out / "summary.json").read_text())
    usable = s["within"] and s["slenderness"] <= 8 and s["largest_c"] < 1 and s["largest_turn"] <= 10
    return (f"| {part} {face} | {tolerance} | {100 * s['coverage']:.2f} ({100 * s['coverage_reachable']:.2f}) | {s['overcut']:.4f} | "
            f"{s['other_faces_overcut']:.4f} | {s['largest_c']:.2f} | {s['slenderness']:.1f} | {s['strips']} | {seconds:.0f} | "
            f"{'yes' if usable else 'within' if s['within'] else 'no'} |"), usable


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    flank, folder, names = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
    print("| face | tolerance, mm | coverage (of what is reachable), % | overcut, mm | other faces, mm | abs(c) | slenderness | strips | CPU s | usable |")
    print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
    usable = []
    for part, (faces, tolerance) in FACES.items():
        for face in faces if file_of(folder, part).exists() and (not names or part in names) else ():
            row, good = fit(flank, folder, part, face, tolerance)
            print(row, flush=True)
            usable.append(good)
    print(f"\n{sum(usable)} of {len(usable)} usable")


if __name__ == "__main__":
    main()
