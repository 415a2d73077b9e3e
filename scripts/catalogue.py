#!/usr/bin/env python3
"""Writes share/catalogue/*.json and the table of its README from figures.csv, the figures as the makers publish them.

  scripts/catalogue.py           write
  scripts/catalogue.py --check   say what differs, exit 1 if anything does

The rules (README.md of the catalogue) are the functions below; lengths in figures.csv are in the row's unit, angles in degrees a side.
"""
import csv
import json
import math
import sys
from fractions import Fraction
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "share" / "catalogue"
START, END = "<!-- table: scripts/catalogue.py -->", "<!-- end of table -->"
SYMBOLS = {"dc": "DC", "re": "R", "arc": "arc R", "angle": "angle", "apmx": "APMX", "lu": "LU", "dn": "DN", "dcon": "DCON",
           "oal": "OAL"}


def number(text):
    """\"12.5\", \"7/16\" or \"2 1/2\", exactly."""
    return sum(Fraction(part) for part in text.split())


def millimetres(row):
    scale = Fraction(254, 10) if row["unit"] == "inch" else 1
    return {key: number(row[key]) * (1 if key == "angle" else scale) for key in SYMBOLS if row[key]}


def plain(value, digits=9):
    value = round(float(value), digits)
    return int(value) if value == int(value) else value


def ball(f):
    radius = f["dc"] / 2
    if "dn" not in f:
        return "cylinder", f["apmx"] - radius, {"radius": radius}, None
    levels = [(f["apmx"], f["dn"]), (f["lu"], f["dn"]), (f["lu"], f["dcon"]), (f["oal"], f["dcon"])]
    return "cylinder", f["apmx"] - radius, {"radius": radius}, [[plain(z - radius), plain(d / 2)] for z, d in levels]


def cone(f):
    """The flank ends at the height apmx above the tip, where z = s cos^2 a - R sin a."""
    angle, radius = math.radians(f["angle"]), float(f["re"])
    length = (float(f["apmx"]) - radius * (1 - math.sin(angle))) / math.cos(angle) ** 2
    top = (radius + length * math.sin(angle)) * math.cos(angle)
    if top > 1.01 * float(f["dcon"]) / 2:
        raise ValueError(f"the cone ends at diameter {2 * top:.3f}, wider than its shank")
    return "cone", length, {"radius": radius, "angle_rad": angle}, None


def tapered_barrel(f):
    """The axis length L and the sphere R at its middle for which the arc reaches DC / 2 at the height apmx above the tip, the slope being
    `angle` at the middle and the tip the sphere at s = 0 (docs/schema/tool.md, section The radial function). Newton's method."""
    arc, angle = float(f["arc"]), math.radians(f["angle"])

    def miss(length, radius):
        across, along = (arc - radius) * math.cos(angle), (arc - radius) * math.sin(angle)
        ends = []
        for x in (-length / 2, length / 2):
            root = math.hypot(across, x - along)
            ends.append((arc - root, (along - x) / root))
        (tip, _), (r, slope) = ends
        return length - r * slope + tip - float(f["apmx"]), r * math.sqrt(1 - slope * slope) - float(f["dc"]) / 2

    length, radius, h = float(f["apmx"]), float(f["dc"]) / 3, 1e-6
    for _ in range(30):
        a, b = miss(length, radius)
        al, bl = (value / h for value in (miss(length + h, radius)[i] - (a, b)[i] for i in (0, 1)))
        ar, br = (value / h for value in (miss(length, radius + h)[i] - (a, b)[i] for i in (0, 1)))
        det = al * br - ar * bl
        length, radius = length - (a * br - b * ar) / det, radius - (b * al - a * bl) / det
    return "tapered-barrel", plain(length, 6), {"arc": arc, "radius": plain(radius, 6), "angle_rad": angle}, None


KINDS = {"ball": ball, "cone": cone, "tapered-barrel": tapered_barrel}


def tool_json(row):
    f = millimetres(row)
    family, length, parameters, profile = KINDS[row["kind"]](f)
    shank = {"profile": profile} if profile else {"diameter": plain(f["dcon"]), "length": plain(f["oal"] - f["apmx"])}
    tool = {"schema": "openflank/tool/1", "units": "mm", "name": f"{row['title']} ({row['code']})", "axis_length": plain(length),
            "family": family, "parameters": {key: plain(value) for key, value in parameters.items()}, "shank": shank}
    lines = [f"  {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}" for key, value in tool.items()]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def table_row(row):
    figures = ", ".join(f"{symbol} {row[key]}" + ("°" if key == "angle" else "") for key, symbol in SYMBOLS.items() if row[key])
    return f"| `{row['file']}` | {row['maker']}, {row['code']} | {figures} {row['unit']} | [{row['seen']}]({row['source']}) |"


def main():
    with open(FOLDER / "figures.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    text = (FOLDER / "README.md").read_text(encoding="utf-8")
    head, rest = text.split(START)
    table = ["", "| file | maker, line, code | figures | source |", "|---|---|---|---|"] + [table_row(row) for row in rows] + [""]
    files = {FOLDER / row["file"]: tool_json(row) for row in rows}
    files[FOLDER / "README.md"] = head + START + "\n".join(table) + END + rest.split(END)[1]
    stale = [path for path, content in files.items() if not path.exists() or path.read_text(encoding="utf-8") != content]
    stale += [path for path in FOLDER.glob("*.json") if path not in files]
    for path in stale:
        print(path.name)
        if "--check" not in sys.argv and path in files:
            path.write_text(files[path], encoding="utf-8")
    return 1 if stale and "--check" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
