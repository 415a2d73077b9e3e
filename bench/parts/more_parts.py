#!/usr/bin/env python3
"""A second batch of parts that the methods were not made on, of kinds that make_parts.py lacks (FreeCAD 0.20 or newer).

usage: more_parts.py FOLDER

Runners of water turbines, a blade of one closed spline with platform and fillets, a wing with winglet, a rotor of a Roots blower, a
scroll, a spiral bevel gear, a worm, a mould, a closed impeller, a dense blisk, a swept fan; of 5 mm to 1.8 m, as STEP, IGES, BREP and
as STL in metres and in inches. Nothing is random.
"""
import math
import pathlib
import sys

from make_parts import Part, Vector, aerofoil, curve, rad, turned, wire
import FreeCAD

AXIS = Vector(0, 0, 1)
ORIGIN = Vector(0, 0, 0)


def shell_of(left, right):
    """The solid between the splines through two grids of points of the same shape, joined along their borders by ruled surfaces."""
    sides, borders = [], []
    for grid in (left, right):
        side = Part.BSplineSurface()
        side.interpolate(grid)
        u0, u1, v0, v1 = side.bounds()
        sides.append(side.toShape())
        borders.append([side.uIso(u0), side.vIso(v1), side.uIso(u1), side.vIso(v0)])
    joined = [Part.makeRuledSurface(a.toShape(), b.toShape()) for a, b in zip(*borders)
              if a.value(a.FirstParameter / 2 + a.LastParameter / 2).distanceToPoint(b.value(b.FirstParameter / 2 + b.LastParameter / 2)) > 1e-6]
    shell = Part.makeShell(sides + joined)
    shell.sewShape()
    solid = Part.makeSolid(shell)
    if solid.Volume < 0:
        solid.reverse()
    return solid


def polar(r, angle, z):
    return Vector(r * math.cos(angle), r * math.sin(angle), z)


def revolved(*lines):
    """The solid of revolution about the axis Z of a closed outline: lines of (radius, height), splines where they have more than two points."""
    ends = [[Vector(r, 0, z) for r, z in line] for line in lines]
    edges = []
    for line, after in zip(ends, ends[1:] + ends[:1]):
        edges += [curve(line)] if len(line) > 2 else [Part.makeLine(*line)] if len(line) == 2 else []
        edges.append(Part.makeLine(line[-1], after[0]))
    out = Part.Face(Part.Wire(edges)).revolve(ORIGIN, AXIS, 360)
    if out.Volume < 0:
        out.reverse()
    return out


def wrapped_blade(stations):
    """As round_blade, but its two sides are splines through points, and the solid is closed."""
    upper, lower = [], []
    for radius, chord, pitch, camber, thickness, skew in stations:
        c, s = math.cos(rad(pitch)), math.sin(rad(pitch))

        def place(q):
            x, y = chord * (q[0] - 0.5), chord * q[1]
            return polar(radius, (x * c - y * s + skew) / radius, x * s + y * c)
        for side, out in zip(aerofoil(camber, 0.45, thickness, 0.008), (upper, lower)):
            out.append([place(q) for q in side])
    return shell_of(upper, lower)


def kaplan():
    """One blade of a runner of 600 mm on its hub: wide, flat towards the tip."""
    blade = wrapped_blade([(115, 180, 52, .05, .13, 0), (150, 225, 42, .045, .10, 0), (190, 265, 34, .035, .075, 0),
                         (235, 300, 27, .025, .05, 0), (298, 330, 21, .02, .035, 0)])
    return Part.makeSphere(130).fuse(blade)


def francis_grid(side, rows=9, columns=13):
    """One side of a runner blade: from a radial inlet to an outlet along the axis, wrapped by 70 degrees, leaning."""
    grid = []
    for j in range(rows):
        h, row = j / (rows - 1), []
        for i in range(columns):
            s = i / (columns - 1)
            hub = (70 + 130 * (1 - s)**1.4, 20 + 90 * (1 - s**1.8) - 55 * s)
            band = (165 + 40 * (1 - s)**2, 5 + 40 * (1 - s)**1.5 - 70 * s)
            r, z = (a + (b - a) * h for a, b in zip(hub, band))
            angle = rad(70) * (0.35 * s + 0.65 * s * s) * (1 - 0.35 * h) + rad(14) * (1 - s) * h * h
            half = 0.5 + 4.5 * math.sqrt(s) * (1 - s) * 2.2
            row.append(polar(r, angle + side * half / r, z))
        grid.append(row)
    return grid


def francis():
    return shell_of(francis_grid(1), francis_grid(-1))


def closed_blade():
    """A turbine blade whose section is one closed periodic spline, on a platform with a fillet along its root."""
    poles = []
    for k in range(6):
        z, chord, turn = 11 * k - 4, 40 - 2.2 * k, rad(25 + 6 * k)
        points = []
        for i in range(32):
            a = 2 * math.pi * i / 32
            x = 0.5 * math.cos(a)
            half = 0.115 * (1 - 0.08 * k) * math.sin(a) * (1 - 0.25 * math.cos(a)) * (1.2 - 0.55 * math.cos(a))
            y = 0.55 * (0.25 - x * x) + half
            points.append(Vector(chord * (x * math.cos(turn) - y * math.sin(turn)), chord * (x * math.sin(turn) + y * math.cos(turn)), z))
        section = Part.BSplineCurve()
        section.interpolate(points, PeriodicFlag=True, Parameters=[i / 32 for i in range(33)])
        poles.append(section.getPoles())
    skin = Part.BSplineSurface()
    skin.buildFromPolesMultsKnots(poles, [4, 1, 1, 4], section.getMultiplicities(), [0, 1, 2, 3], section.getKnots(), False, True, 3, section.Degree)
    caps = [Part.Face(Part.Wire(skin.uIso(u).toShape())) for u in (0, 3)]
    shell = Part.makeShell([skin.toShape()] + caps)
    shell.sewShape()
    solid = Part.makeSolid(shell)
    if solid.Volume < 0:
        solid.reverse()
    solid = solid.fuse(Part.makeBox(60, 60, 12, Vector(-30, -28, -12)))
    foot = [e for e in solid.Edges if abs(e.BoundBox.ZMin) < 1e-3 and abs(e.BoundBox.ZMax) < 1e-3 and e.Curve.TypeId.endswith("BSplineCurve")]
    return solid.makeFillet(2.5, foot)


def winglet():
    """Half a wing of 1.8 m, its last fifth bent upwards into a winglet; two splines through points."""
    upper, lower = [], []
    y, z, count = 0.0, 0.0, 18
    for k in range(count + 1):
        along = 1800 * k / count
        bend = rad(70) * min(1, max(0, (along - 1350) / 300))**2 * (3 - 2 * min(1, max(0, (along - 1350) / 300)))
        chord, turn = 420 - 0.16 * along - 0.00003 * max(0, along - 900)**2, rad(2 - along / 900)
        if k:
            y, z = y + 1800 / count * math.cos(bend), z + 1800 / count * math.sin(bend)

        def place(q):
            u, v = chord * (q[0] - 0.25), chord * q[1]
            up = v * math.cos(turn) - u * math.sin(turn)
            return Vector(0.22 * along + u * math.cos(turn) + v * math.sin(turn), y - up * math.sin(bend), z + up * math.cos(bend))
        for side, out in zip(aerofoil(0.03, 0.4, 0.12, 0.003), (upper, lower)):
            out.append([place(q) for q in side])
    return shell_of(upper, lower)


def roots_rotor(radius=30.0, length=110.0, twist=60.0):
    """A rotor of a Roots blower: two convex and two hollow cycloids, twisted."""
    small, wires = radius / 4, []
    for k in range(6):
        turn, edges = rad(twist) * k / 5, []
        for quarter in range(4):
            points = []
            for i in range(17):
                a = quarter * math.pi / 2 + math.pi / 2 * i / 16
                if quarter % 2 == 0:
                    x = (radius + small) * math.cos(a) - small * math.cos((radius + small) / small * a)
                    y = (radius + small) * math.sin(a) - small * math.sin((radius + small) / small * a)
                else:
                    x = (radius - small) * math.cos(a) + small * math.cos((radius - small) / small * a)
                    y = (radius - small) * math.sin(a) - small * math.sin((radius - small) / small * a)
                c, s = math.cos(turn), math.sin(turn)
                points.append(Vector(x * c - y * s, x * s + y * c, length * k / 5))
            edges.append(curve(points))
        wires.append(Part.Wire(edges))
    return Part.makeLoft(wires, True, False)


def scroll(base=3.2, thickness=4.0, height=28.0):
    """The spiral wall of a scroll compressor on its plate: two involutes of a circle, one turn and a half."""
    def involute(shift):
        points = []
        for i in range(49):
            a = math.pi * (1.0 + 3.0 * i / 48)
            points.append(Vector(base * (math.cos(a) + (a - shift) * math.sin(a)), base * (math.sin(a) - (a - shift) * math.cos(a)), 0))
        return points
    outer, inner = involute(0), involute(thickness / base)
    edges = [curve(outer), Part.makeLine(outer[-1], inner[-1]), curve(inner[::-1]), Part.makeLine(inner[0], outer[0])]
    return Part.makeCylinder(52, 8, Vector(0, 0, -8)).fuse(Part.Face(Part.Wire(edges)).extrude(Vector(0, 0, height)))


def bevel_gear(teeth=16, module=5.0, cone=40.0, width=26.0, spiral=30.0):
    """Three teeth of a spiral bevel gear on a cone: involute sections that shrink towards the apex and turn."""
    pitch = module * teeth / 2
    apart = pitch / math.sin(rad(cone))
    base, tip, root = pitch * math.cos(rad(20)), pitch + module, pitch - 1.25 * module

    def involute(angle):
        return math.tan(angle) - angle
    half = math.pi / (2 * teeth) + involute(rad(20))
    low = root - 1.5
    flank = [(r, half - involute(math.acos(min(1, base / r)))) for r in (low + (tip - low) * i / 12 for i in range(13))]
    grids = [], []
    for k in range(7):
        scale = 1 - width * k / 6 / apart
        turn = math.tan(rad(spiral)) * math.log(1 / scale) / math.sin(rad(cone))

        def place(r, angle):
            """The section lies across the pitch cone."""
            out = (r - pitch) * scale
            return polar(pitch * scale + out * math.cos(rad(cone)), angle + turn, (1 - scale) * pitch / math.tan(rad(cone)) + out * math.sin(rad(cone)))
        for side, grid in zip((1, -1), grids):
            grid.append([place(r, side * a) for r, a in flank])
    tooth = shell_of(*grids)
    inner, high = 1 - width / apart, pitch / math.tan(rad(cone))
    down = 1.25 * module
    body = [(pitch - down * math.cos(rad(cone)), -down * math.sin(rad(cone))),
            (inner * (pitch - down * math.cos(rad(cone))), (1 - inner) * high - inner * down * math.sin(rad(cone)))]
    out = revolved(body, [(8, body[1][1]), (8, body[0][1])])
    for k in range(3):
        out = out.fuse(turned(tooth, 360 / teeth * k))
    return out


def worm(turns=1.5, pitch=14.0, outside=22.0, root=13.0):
    """One and a half threads of a worm: two helicoids, straight in the axial section, on a shaft."""
    def grid(side):
        rows = []
        for j in range(5):
            r = root - 0.5 + (outside - root + 0.5) * j / 4
            half = 0.5 * pitch * 0.5 + (0.5 * (outside + root) - r) * math.tan(rad(20))
            rows.append([polar(r, 2 * math.pi * turns * i / 40, pitch * turns * i / 40 + side * half) for i in range(41)])
        return rows
    return Part.makeCylinder(root, 60, Vector(0, 0, -18)).fuse(shell_of(grid(1), grid(-1)))


def mould():
    """A cavity with four wavy walls of changing draft, round corners and a fillet along the floor."""
    def outline(z, out, wave):
        a, b, r = 55 + out, 35 + out, 12 + 0.5 * out
        def side(p, q):
            along = q - p
            across = Vector(along.y, -along.x, 0).normalize()
            points = [p + along * (i / 12) + across * (wave * math.sin(math.pi * i / 12)**2 * math.cos(2 * math.pi * i / 12)) for i in range(13)]
            spline = Part.BSplineCurve()
            spline.interpolate(points, InitialTangent=along * (1 / 12), FinalTangent=along * (1 / 12))
            return spline.toShape()
        edges, centres = [], ((a - r, b - r), (-a + r, b - r), (-a + r, -b + r), (a - r, -b + r))
        for k in range(4):
            turn, after = rad(90 * k), rad(90 * (k + 1))
            x, y = centres[k]
            at = [Vector(x + r * math.cos(t), y + r * math.sin(t), z) for t in (turn, (turn + after) / 2, after)]
            u, v = centres[(k + 1) % 4]
            edges += [Part.Arc(*at).toShape(), side(at[2], Vector(u + r * math.cos(after), v + r * math.sin(after), z))]
        return Part.Wire(edges)
    cavity = Part.makeLoft([outline(8, 0, 2.5), outline(22, 1.5, 3.5), outline(38, 5, 3)], True, False)
    solid = Part.makeBox(150, 110, 36, Vector(-75, -55, 0)).cut(cavity)
    floor = [e for e in solid.Edges if abs(e.BoundBox.ZMin - 8) < 1e-6 and abs(e.BoundBox.ZMax - 8) < 1e-6]
    try:
        return solid.makeFillet(4, floor)
    except Part.OCCError:
        return solid


def bowed_blade(hub, shroud, wrap, lean, thickness, bow=0.0, rows=5, columns=13):
    """A blade between two lines (radius, height) of s in 0..1: wrapped by an angle, leaning from hub to shroud, bowed between them."""
    def grid(side):
        out = []
        for j in range(rows):
            h, row = -0.06 + 1.06 * j / (rows - 1), []
            for i in range(columns):
                s = i / (columns - 1)
                r, z = (a + (b - a) * h for a, b in zip(hub(s), shroud(s)))
                angle = rad(wrap) * s * (1.2 - 0.2 * s) + rad(lean) * (1 - s) * h + rad(bow) * h * (1 - h)
                row.append(polar(r, angle + side * thickness / 2 / r, z))
            out.append(row)
        return out
    return shell_of(grid(1), grid(-1))


def closed_impeller():
    """A pump's impeller with a shroud: five blades wrapped by 110 degrees in channels that are open at the eye and the rim only."""
    hub = lambda s: (22 + 58 * s, 26 * (1 - s)**2)  # noqa: E731
    shroud = lambda s: (40 + 40 * s, 14 + 28 * (1 - s)**2.2)  # noqa: E731
    blade = bowed_blade(hub, lambda s: (shroud(s)[0], shroud(s)[1] + 1), -110, 10, 3)
    steps = [i / 12 for i in range(13)]
    plate = revolved([hub(s) for s in steps], [(80, -6), (8, -6)], [(8, 26)])
    cover = revolved([shroud(s) for s in steps], [(shroud(s)[0] + 3 * (1 - s), shroud(s)[1] + 4) for s in steps[::-1]])
    out = plate
    for k in range(5):
        out = out.fuse(turned(blade, 72 * k))
    return out.fuse(cover)


def dense_blisk():
    """Three of 40 thin blades, 13 mm apart at the hub."""
    blade = wrapped_blade([(r, 19, 55 - 6 * k, 0.06, 0.055 - 0.006 * k, 1.5 * k) for k, r in enumerate((84, 90, 98, 106, 112))])
    out = Part.makeCylinder(86, 26, Vector(0, 0, -13)).cut(Part.makeCylinder(76, 26, Vector(0, 0, -13)))
    for k in (-1, 0, 1):
        out = out.fuse(turned(blade, 9 * k))
    return out


def swept_fan():
    """A fan of seven blades, swept forward."""
    blade = wrapped_blade([(38, 46, 48, .07, .10, 0), (60, 56, 40, .06, .08, 4), (85, 64, 32, .05, .07, 14), (110, 66, 26, .045, .06, 30),
                         (132, 58, 22, .04, .06, 50)])
    out = Part.makeCylinder(45, 52, Vector(0, 0, -26))
    for k in range(7):
        out = out.fuse(turned(blade, 360 / 7 * k))
    return out


def tiny_impeller():
    """A wheel of 5 mm with six bowed blades."""
    hub = lambda s: (0.7 + 1.8 * s**1.5, 1.5 * (1 - s)**1.6)  # noqa: E731
    shroud = lambda s: (1.6 + 0.9 * s * s, 1.6 * (1 - s)**1.2 + 0.4 * s)  # noqa: E731
    line = [hub(i / 20) for i in range(21)]
    out = revolved(line, [(2.5, -0.3), (0.25, -0.3)], [(0.25, 1.5)])
    for k in range(6):
        out = out.fuse(turned(bowed_blade(hub, shroud, -50, 12, 0.08, bow=8), 60 * k))
    return out


def drone_blade():
    """One blade of a propeller of 130 mm, thin."""
    return wrapped_blade([(r, chord, pitch, .05, t, 0) for r, chord, pitch, t in
                        ((9, 9, 34, .16), (18, 13, 28, .12), (32, 14, 20, .09), (48, 11, 14, .08), (64, 6, 10, .08))])


def guide_vane():
    """A guide vane of 90 mm, twisted and bowed."""
    wires = []
    for k in range(5):
        turn = rad(8 * k)

        def place(q):
            x, y = 64 * (q[0] - 0.4), 64 * q[1]
            return Vector(x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn) + 1.2 * k * (4 - k), 22.5 * k)
        wires.append(wire(place, aerofoil(0.08, 0.4, 0.13, 0.004)))
    return Part.makeLoft(wires, True, False)


def mesh_of(shape, unit, fineness):
    """The shape in triangles, in a unit of so many mm."""
    import Mesh
    points, triangles = shape.tessellate(fineness)
    scaled = [(p.x / unit, p.y / unit, p.z / unit) for p in points]
    return Mesh.Mesh([[scaled[i] for i in t] for t in triangles])


PARTS = {
    "kaplan_runner.step": kaplan, "francis_blade.brep": francis, "closed_blade.step": closed_blade, "winglet.step": winglet,
    "roots_rotor.step": roots_rotor, "scroll.step": scroll, "bevel_gear.step": bevel_gear, "worm.step": worm, "mould.step": mould,
    "closed_impeller.step": closed_impeller, "dense_blisk.step": dense_blisk, "swept_fan.step": swept_fan,
    "tiny_impeller.step": tiny_impeller, "drone_blade.iges": drone_blade,
    "francis_blade_m.stl": lambda: mesh_of(francis(), 1000, 0.05), "guide_vane_in.stl": lambda: mesh_of(guide_vane(), 25.4, 0.03),
}


def write(shape, path):
    if path.suffix == ".stl":
        shape.write(str(path))
        return f"{shape.CountFacets} triangles"
    {".step": shape.exportStep, ".iges": shape.exportIges, ".brep": shape.exportBrep}[path.suffix](str(path))
    return f"{len(shape.Faces)} faces{'' if shape.isValid() else ', not a valid solid'}"


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in PARTS.items():
        if len(sys.argv) == 2 or any(name.startswith(word) for word in sys.argv[2:]):
            print(f"{name}: {write(make(), folder / name)}", flush=True)
