"""Reads view.json (docs/schema/view.md): triangles with their error. Needs no FreeCAD."""

import base64
import struct

#: Ends of the error's colours: cut too deep, right, material left (red, white, blue: told apart without green).
OVER, RIGHT, UNDER, UNREACHED = (0.70, 0.09, 0.17), (0.97, 0.96, 0.95), (0.18, 0.45, 0.68), (0.48, 0.50, 0.53)


def points(text, box):
    """Points (x, y, z) of 16-bit steps of a box, mm."""
    raw = base64.b64decode(text)
    steps = struct.unpack(f"<{len(raw) // 2}H", raw)
    low, high = box
    return [tuple(low[k] + steps[i + k] / 65535.0 * (high[k] - low[k]) for k in range(3)) for i in range(0, len(steps), 3)]


def indices(text):
    """Indices of zigzag differences, 7 bits a byte."""
    out, before, value, shift = [], 0, 0, 0
    for byte in base64.b64decode(text):
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            before += -(value + 1) // 2 if value % 2 else value // 2
            out.append(before)
            value, shift = 0, 0
    return out


def floats(text):
    raw = base64.b64decode(text)
    return list(struct.unpack(f"<{len(raw) // 4}f", raw))


def colour(error_mm, tolerance_mm):
    """(r, g, b) of 0 to 1: white at zero, full at the tolerance, grey where nothing reached (beyond four)."""
    share = error_mm / tolerance_mm
    if share > 4.0:
        return UNREACHED
    end, share = (OVER if share < 0 else UNDER), min(1.0, abs(share))
    return tuple(a + share * (b - a) for a, b in zip(RIGHT, end))


def targets(view):
    """Of every machined face: (name, points, triangles, colours of the points)."""
    for body in view["bodies"]:
        if not body["target"] or "f_mm" not in body:
            continue
        corner = points(body["positions"], body["box"])
        index = indices(body["indices"])
        colours = [colour(f, view["tolerance_mm"]) for f in floats(body["f_mm"])]
        yield body["face"], corner, [tuple(index[i : i + 3]) for i in range(0, len(index), 3)], colours
