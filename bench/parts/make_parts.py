#!/usr/bin/env python3
"""Parts that the methods were not made on, built by another program (FreeCAD 0.20 or newer) as its users build them.

usage: make_parts.py FOLDER

Lofted blades from thick and cambered to flat and twisted, of 5 to 500 mm; a propeller and a blisk sector whose solids come
out open; an impeller with splitters; a gear; a pocket and a channel with curved walls of changing draft. Nothing is random.
"""
import math
import pathlib
import sys

for place in ("/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"):
    sys.path.append(place)
import FreeCAD  # noqa: E402  (Part needs it first)
import Part  # noqa: E402

Vector = FreeCAD.Vector
rad = math.radians


def aerofoil(camber, place, thickness, edge):
    """Upper and lower side of a four-digit section of chord 1 with a blunt trailing edge, dense at both ends."""
    upper, lower = [], []
    for i in range(26):
        x = 0.5 * (1 - math.cos(math.pi * i / 25))
        half = 5 * thickness * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4) + edge * x
        before = x < place
        scale = camber / (place**2 if before else (1 - place)**2)
        middle = scale * (2 * place * x - x * x) if before else scale * (1 - 2 * place + 2 * place * x - x * x)
        slope = math.atan(2 * scale * (place - x))
        upper.append((x - half * math.sin(slope), middle + half * math.cos(slope)))
        lower.append((x + half * math.sin(slope), middle - half * math.cos(slope)))
    return upper, lower


def curve(points):
    spline = Part.BSplineCurve()
    spline.interpolate(points)
    return spline.toShape()


def wire(place, section):
    """The section as three edges: two sides and the blunt end."""
    upper, lower = ([place(q) for q in side] for side in section)
    return Part.Wire([curve(upper), Part.makeLine(upper[-1], lower[-1]), curve(lower[::-1])])


def straight_blade(sections, ruled=False):
    """Lofted through (chord, twist in degrees, height, camber, thickness, shift x, shift y)."""
    wires = []
    for chord, twist, height, camber, thickness, dx, dy in sections:
        c, s = math.cos(rad(twist)), math.sin(rad(twist))

        def place(q):
            x, y = chord * (q[0] - 0.4), chord * q[1]
            return Vector(dx + x * c - y * s, dy + x * s + y * c, height)
        wires.append(wire(place, aerofoil(camber, 0.4, thickness, 0.004)))
    return Part.makeLoft(wires, True, ruled)


def round_blade(stations):
    """Lofted through sections wrapped round the axis Z: (radius, chord, pitch in degrees, camber, thickness, skew in mm)."""
    wires = []
    for radius, chord, pitch, camber, thickness, skew in stations:
        c, s = math.cos(rad(pitch)), math.sin(rad(pitch))

        def place(q):
            x, y = chord * (q[0] - 0.5), chord * q[1]
            angle = (x * c - y * s + skew) / radius
            return Vector(radius * math.cos(angle), radius * math.sin(angle), x * s + y * c)
        wires.append(wire(place, aerofoil(camber, 0.45, thickness, 0.008)))
    return Part.makeLoft(wires, True, False)


def turned(shape, degrees):
    copy = shape.copy()
    copy.rotate(Vector(0, 0, 0), Vector(0, 0, 1), degrees)
    return copy


def propeller():
    stations = [(r, chord, math.degrees(math.atan(180 / (2 * math.pi * r))), 0.03, t, skew) for r, chord, t, skew in
                ((18, 42, .16, 0), (35, 55, .11, 2), (52, 62, .08, 6), (70, 60, .06, 12), (85, 46, .05, 20), (96, 22, .05, 28))]
    blade, out = round_blade(stations), Part.makeCylinder(25, 70, Vector(0, 0, -35))
    for k in range(4):
        out = out.fuse(turned(blade, 90 * k))
    return out


def blisk():
    blade = round_blade([(r, 34 - 1.2 * k, 62 - 5 * k, 0.08 - 0.012 * k, 0.10 - 0.01 * k, 0)
                         for k, r in enumerate((58, 66, 76, 86, 95))])
    out = Part.makeCylinder(62, 44, Vector(0, 0, -22)).cut(Part.makeCylinder(48, 44, Vector(0, 0, -22)))
    for k in (-1, 0, 1):
        out = out.fuse(turned(blade, 22 * k))
    return out


def impeller():
    def hub_line(s):
        return Vector(12 + 33 * s**1.6, 0, 28 * (1 - s)**1.5)

    def blade(begin, thickness=1.2):
        def rail(height, off):
            points = []
            for i in range(15):
                s = begin + (1 - begin) * i / 14
                hub, shroud = hub_line(s), Vector(28 + 17 * s * s, 0, 30 * (1 - s)**1.2 + 7 * s)
                r, z = hub.x + (shroud.x - hub.x) * height, hub.z + (shroud.z - hub.z) * height
                angle = rad(-55) * s * (1 - 0.25 * s) + rad(12) * (1 - s) * height + off / r
                points.append(Vector(r * math.cos(angle), r * math.sin(angle), z))
            spline = Part.BSplineCurve()
            spline.interpolate(points)
            return spline
        a, b = ([rail(h, off) for h in (-0.05, 1.0)] for off in (thickness / 2, -thickness / 2))
        faces = [Part.makeRuledSurface(p.toShape(), q.toShape()) for p, q in ((a[0], a[1]), (b[0], b[1]), (a[1], b[1]), (a[0], b[0]))]
        for end in ("StartPoint", "EndPoint"):
            at = [[getattr(rail_, end) for rail_ in side] for side in (a, b)]
            faces.append(Part.makeRuledSurface(Part.makeLine(*at[0]), Part.makeLine(*at[1])))
        shell = Part.makeShell(faces)
        shell.sewShape()
        return Part.makeSolid(shell)
    line = [hub_line(i / 20) for i in range(21)]
    corners = [line[-1], Vector(45, 0, -4), Vector(4, 0, -4), Vector(4, 0, 28), line[0]]
    edges = [curve(line)] + [Part.makeLine(p, q) for p, q in zip(corners, corners[1:])]
    out = Part.Face(Part.Wire(edges)).revolve(Vector(0, 0, 0), Vector(0, 0, 1), 360)
    for k in range(6):
        out = out.fuse(turned(blade(0.0), 60 * k)).fuse(turned(blade(0.3), 60 * k + 30))
    return out


def gear(teeth=18, module=3.0, helix=25, width=30):
    """Three teeth of a helical gear with involute flanks."""
    pitch = module / math.cos(rad(helix)) * teeth / 2
    base = pitch * math.cos(math.atan(math.tan(rad(20)) / math.cos(rad(helix))))
    tip, root = pitch + module, pitch - 1.25 * module
    involute = lambda angle: math.tan(angle) - angle  # noqa: E731
    half = math.pi / (2 * teeth) + involute(math.acos(base / pitch))
    flank = [(r, half - involute(math.acos(min(1, base / r)))) for r in
             (max(base, root) + (tip - max(base, root)) * i / 12 for i in range(13))]
    wires = []
    for k in range(7):
        z = width * k / 6
        turn = z * math.tan(rad(helix)) / pitch
        left, right = ([Vector(r * math.cos(side * a + turn), r * math.sin(side * a + turn), z) for r, a in flank] for side in (1, -1))
        foot = [Vector((root - 0.5) * math.cos(side * flank[0][1] + turn), (root - 0.5) * math.sin(side * flank[0][1] + turn), z)
                for side in (1, -1)]
        wires.append(Part.Wire([Part.makeLine(foot[0], left[0]), curve(left), Part.makeLine(left[-1], right[-1]),
                                curve(right[::-1]), Part.makeLine(right[0], foot[1]), Part.makeLine(foot[1], foot[0])]))
    tooth, out = Part.makeLoft(wires, True, False), Part.makeCylinder(root, width)
    for k in range(3):
        out = out.fuse(turned(tooth, 360 / teeth * k))
    return out


def pocket():
    def outline(z, o):
        spline = Part.BSplineCurve()
        spline.interpolate([Vector(x, y, z) for x, y in ((20 - o, 20 - o), (60, 14 - o), (100 + o, 20 - o), (108 + o, 45),
                                                        (100 + o, 70 + o), (60, 62 + o), (20 - o, 70 + o), (12 - o, 45))],
                           PeriodicFlag=True)
        return Part.Wire(spline.toShape())
    return Part.makeBox(120, 90, 40).cut(Part.makeLoft([outline(10, 0), outline(25, 1.5), outline(42, 4)], True, False))


def channel():
    wires = []
    for z, o in ((8, 0), (22, 1.2), (36, 3.0)):
        far = [Vector(x, 48 + o + 9 * math.sin(x / 26.0), z) for x in range(-5, 160, 11)]
        near = [Vector(x, 30 - o + 7 * math.sin(x / 26.0 + 0.3), z) for x in range(-5, 160, 11)]
        wires.append(Part.Wire([curve(far), Part.makeLine(far[-1], near[-1]), curve(near[::-1]), Part.makeLine(near[0], far[0])]))
    return Part.makeBox(150, 80, 35).cut(Part.makeLoft(wires, True, False))


PARTS = {
    "turbine_blade": lambda: straight_blade([(60, 20 + 6 * k, 25 * k, 0.14 - 0.02 * k, 0.16 - 0.02 * k, 0, 0) for k in range(5)]),
    "fan_blade": lambda: straight_blade([(160 - 10 * k, 55 - 8 * k, 100 * k, 0.05, 0.10 - 0.01 * k, 8 * k, 3 * k * k) for k in range(6)]),
    "micro_blade": lambda: straight_blade([(5, 10 * k, 2 * k, 0.06, 0.12, 0, 0) for k in range(3)]),
    "ruled_vane": lambda: straight_blade([(40, 0, 0, 0.09, 0.12, 0, 0), (30, 35, 45, 0.05, 0.09, 4, 2)], ruled=True),
    "marine_propeller": propeller,
    "blisk3": blisk,
    "splitter_impeller": impeller,
    "helical_gear": gear,
    "pocket": pocket,
    "channel": channel,
}

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in PARTS.items():
        shape = make()
        shape.exportStep(str(folder / f"{name}.step"))
        print(f"{name}.step: {len(shape.Faces)} faces{'' if shape.isValid() else ', not a valid solid'}")
