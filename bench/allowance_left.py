#!/usr/bin/env python3
"""What a roughed cavity has left on its walls, read by others: walls by FreeCAD, material from stock.stl of the replay.

usage: allowance_left.py FLANK FOLDER   (FOLDER is made; FreeCAD's Python modules and scipy are needed)

Makes the example cavity of 35 x 42 x 50 mm, roughs it with an allowance of 0.2 mm, and measures from 24 x 24 places of either wall along
the wall's normal to the first triangle of the material. Prints least, median and most, and the share within 0.05 mm of the allowance.
"""
import pathlib
import struct
import subprocess
import sys

import numpy as np
from scipy.spatial import cKDTree

sys.path.append("/usr/lib/freecad-python3/lib")
import FreeCAD  # noqa: E402, F401  (Part needs it first)
import Part  # noqa: E402

ALLOWANCE, WITHIN, PLACES, NEAR = 0.2, 0.05, 24, 200


def triangles_of(path):
    data = path.read_bytes()
    record = np.dtype([("normal", "<3f4"), ("corners", "<9f4"), ("attribute", "<u2")])
    count = struct.unpack("<I", data[80:84])[0]
    return np.frombuffer(data[84:], dtype=record, count=count)["corners"].reshape(-1, 3, 3).astype(float)


def first_hit(point, direction, triangles):
    """The least way > 0 along a direction to one of the triangles (Moeller and Trumbore); infinite: none."""
    one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(direction, two)
    volume = (one * across).sum(1)
    crossed = np.abs(volume) > 1e-12
    volume = np.where(crossed, volume, 1.0)
    off = point - triangles[:, 0]
    u = (off * across).sum(1) / volume
    turned = np.cross(off, one)
    v, way = (direction * turned).sum(1) / volume, (two * turned).sum(1) / volume
    inside = crossed & (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6) & (way > 0)
    return way[inside].min() if inside.any() else np.inf


def main(flank, folder):
    folder.mkdir(parents=True, exist_ok=True)
    part, out = folder / "cavity.step", folder / "cavity"
    subprocess.run([flank, "example", "cavity", "--width", "35", "--depth", "42", "--length", "50", "--twist", "16", "-o", part], check=True)
    subprocess.run([flank, "trochoid", part, "--left", "F1", "--right", "F2", "--tolerance", "0.02", "--allowance", str(ALLOWANCE), "-o", out],
                   check=True)
    triangles = triangles_of(out / "stock.stl")
    tree = cKDTree(triangles.mean(1))
    shape = Part.Shape()
    shape.read(str(part))
    for number, face in enumerate(shape.Faces[:2], 1):
        u0, u1, v0, v1 = face.ParameterRange
        left = []
        for u in np.linspace(u0, u1, PLACES + 2)[1:-1]:
            for v in np.linspace(v0, v1, PLACES + 2)[1:-1]:
                point, normal = np.array(face.valueAt(u, v)), np.array(face.normalAt(u, v))
                near = triangles[tree.query(point, NEAR)[1]]
                left.append(min(first_hit(point, normal, near), first_hit(point, -normal, near)))
        left = np.array(left)
        print(f"F{number}: {left.min():.4f} to {left.max():.4f} mm, median {np.median(left):.4f}; "
              f"within {WITHIN} mm of {ALLOWANCE} mm: {100 * np.mean(np.abs(left - ALLOWANCE) <= WITHIN):.1f} % of {left.size} places")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
