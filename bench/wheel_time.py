#!/usr/bin/env python3
"""How long a wheel's finishing takes beside a ball of the fillet's radius in iso-scallop passes: the same surface, scallop and feed.

usage: wheel_time.py FOLDER [PROGRAM_MINUTES FEED_MM_MIN]

FOLDER is what `flank wheel` wrote. The reference finishes the accessible area of the verdict's faces by a ball, in passes that leave the
scallop that our own passes of the tip may leave, half of the tolerance: on a plane they are 2 sqrt(2 R h - h^2) apart, R the radius of the
ball, h the scallop. It has no links, no entries and no edge that is passed twice, so it is shorter than any program of that kind; the bend of
faces is left out, which helps the side that is convex and harms the other one. Ours is the length of all passes of all finishing operations
and copies, and, where it is given, the time of the program with all of its links (of `flank post`, without roughing).
"""
import json
import math
import sys
from pathlib import Path

SCALLOP_SHARE = 0.5  # of the tolerance: PointOptions::scallop_share


def length_of(path):
    return sum(math.dist(a[:3], b[:3]) for strip in path["strips"] for a, b in zip(strip["poses"], strip["poses"][1:]))


def main():
    folder = Path(sys.argv[1])
    plan, verdict = (json.loads((folder / name).read_text()) for name in ("plan.json", "verify.json"))
    hub = {face for op in plan["operations"] if op["kind"] == "floor" for face in op["faces"]}
    radius = min(row[1] for row in json.loads((folder / "tool.json").read_text())["samples"][:1])
    scallop = SCALLOP_SHARE * verdict["tolerance_mm"]
    apart = 2.0 * math.sqrt(2.0 * radius * scallop - scallop**2)
    sectors = plan["sectors"]
    # The verdict's faces are all that the part has of the hub, and blades that stand for their copies.
    own = 1 if plan["whole"] else sectors
    area = sum(face["area_mm2"] * face.get("reachable_share", 0.0) * (sectors / plan["hub_sectors"] if face["face"] in hub else face.get("copies", own))
               for face in verdict["faces"] if face["target"])
    ours = sum(length_of(json.loads((folder / op["folder"] / "path.json").read_text())) * op["copies"]
               for op in plan["operations"] if op["done"] and op["kind"] != "rough")
    reference = area / apart
    print(f"ball of {radius:.3g} mm, scallop {scallop:.3g} mm: {area:.0f} mm2 in passes {apart:.3f} mm apart, {reference / 1000:.1f} m")
    print(f"ours: {ours / 1000:.1f} m, {ours / reference:.2f} of it")
    if len(sys.argv) > 3:
        minutes, feed = float(sys.argv[2]), float(sys.argv[3])
        print(f"program with links: {minutes:.1f} min, {minutes / (reference / feed):.2f} of the {reference / feed:.1f} min of the reference without any")


main()
