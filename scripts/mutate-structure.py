#!/usr/bin/env python3
"""Changes entities of STEP, IGES and BREP files and looks for silent nonsense: another part than the sound file, without a note.

usage: mutate-structure.py FLANK PART... [--trials N] [--seed N] [--keep FOLDER]

Each trial changes one thing that a file says: how a number is written, a reference, an entry of a list, a count, knots, a sense, a
unit, a word, a point of a border; or takes an entity out. The answer of `flank inspect` is held against that of the sound file. Its
kinds: refused; same (faces, their areas and boxes within a thousandth, the box of all within five; the area of a sliver within what its
border makes of it by a millionth of its size); told (another part, and a note, a
face that is not read or another unit says so); valid (another part, and the file says so without contradicting itself: a control point
inside a surface, which no border follows, is elsewhere); silent, which is a find; and any exit code but 0 and 3. Exit code: 1 if there
are finds.
"""
import argparse
import collections
import json
import os
import random
import re
import subprocess
import sys
import tempfile

REAL = re.compile(rb"(?<![\w#.'])-?\d+\.\d*(?:E[+-]?\d+)?(?![\w.])")
ENTITY = re.compile(rb"#(\d+)\s*=\s*([A-Z0-9_]+)\s*\(((?:[^;']|'[^']*')*)\)\s*;")
REFERENCE = re.compile(rb"#\d+")
LIST = re.compile(rb"\([^()]+\)")
SHAPES = (b"ADVANCED_FACE", b"FACE_BOUND", b"FACE_OUTER_BOUND", b"EDGE_LOOP", b"ORIENTED_EDGE", b"EDGE_CURVE", b"VERTEX_POINT",
          b"CLOSED_SHELL", b"OPEN_SHELL", b"SURFACE_CURVE", b"LINE", b"CIRCLE", b"PLANE", b"CYLINDRICAL_SURFACE",
          b"MANIFOLD_SOLID_BREP", b"SHELL_BASED_SURFACE_MODEL")
SPLINES = (b"B_SPLINE_CURVE_WITH_KNOTS", b"B_SPLINE_SURFACE_WITH_KNOTS")
Entity = collections.namedtuple("Entity", "number word values whole")


def put(text, span, by):
    return text[: span[0]] + by + text[span[1]:]


def found(pattern, text, span):
    return [m.span() for m in pattern.finditer(text, *span)]


def entities(text, words=None):
    all_of_them = [Entity(m[1], m[2], m.span(3), m.span()) for m in ENTITY.finditer(text)]
    return [e for e in all_of_them if words is None or e.word in words]


def listed(text, span):
    """Items of the list at the span."""
    return text[span[0] + 1: span[1] - 1].split(b",")


def put_list(text, span, items):
    return put(text, span, b"(" + b",".join(items) + b")")


def step_spelling(rng, text):
    span = rng.choice(found(REAL, text, (text.find(b"DATA;"), len(text))))
    mantissa, _, exponent = text[slice(*span)].partition(b"E")
    if mantissa.endswith(b".") and rng.random() < 0.3:
        mantissa = mantissa[:-1]
    if not mantissa.startswith(b"-") and rng.random() < 0.3:
        mantissa = b"+" + mantissa
    return put(text, span, mantissa + rng.choice([b"e", b"D", b"d", b"E"]) + (exponent or b"0"))


def step_reference(rng, text):
    every = entities(text)
    words = {e.number: e.word for e in every}
    entity = rng.choice([e for e in every if e.word in SHAPES and found(REFERENCE, text, e.values)])
    span = rng.choice(found(REFERENCE, text, entity.values))
    now = text[span[0] + 1: span[1]]
    others = [e.number for e in every if e.word == words.get(now) and e.number != now]
    if not others or rng.random() < 0.2:
        others = [e.number for e in every]
    return put(text, span, b"#" + rng.choice(others))


def step_list(rng, text):
    spans = [s for e in entities(text, SHAPES + SPLINES + (b"CARTESIAN_POINT", b"DIRECTION")) for s in found(LIST, text, e.values)]
    span = rng.choice([s for s in spans if len(listed(text, s)) > 1])
    items = listed(text, span)
    k = rng.randrange(len(items))
    if rng.random() < 0.5:
        items.pop(k)
    else:
        items.insert(k, items[k])
    return put_list(text, span, items)


def step_count(rng, text):
    splines = entities(text, SPLINES)
    if not splines:
        return step_reference(rng, text)
    spans = found(re.compile(rb"(?<![\w#.'+-])\d+(?![\w.])"), text, rng.choice(splines).values)
    return put(text, rng.choice(spans), rng.choice([b"0", b"1", b"2", b"4", b"7", b"-1", b"30"]))


def step_knots(rng, text):
    splines = entities(text, SPLINES)
    if not splines:
        return step_reference(rng, text)
    span = rng.choice(found(re.compile(rb"\(\s*-?\d+\.[^()#]*\)"), text, rng.choice(splines).values))
    items = listed(text, span)
    if rng.random() < 0.5:
        items.reverse()
    else:
        i, j = rng.randrange(len(items)), rng.randrange(len(items))
        items[i], items[j] = items[j], items[i]
    return put_list(text, span, items)


def step_sense(rng, text):
    span = rng.choice([s for e in entities(text, SHAPES) for s in found(re.compile(rb"\.[TF]\."), text, e.values)])
    return put(text, span, b".F." if text[slice(*span)] == b".T." else b".T.")


def step_unit(rng, text):
    words = re.compile(rb"\.MILLI\.|\.METRE\.|\.RADIAN\.|LENGTH_UNIT\(\)|PLANE_ANGLE_UNIT\(\)")
    return put(text, rng.choice(found(words, text, (0, len(text)))), rng.choice([b".CENTI.", b"$", b".INCH.", b".KILO."]))


def step_gone(rng, text):
    return put(text, rng.choice(entities(text)).whole, b"")


def step_word(rng, text):
    entity = rng.choice(entities(text, SHAPES))
    at = text.find(entity.word, entity.whole[0])
    return put(text, (at, at + len(entity.word)), rng.choice([entity.word.lower(), entity.word + b"S", b"POINT", rng.choice(SHAPES)]))


def step_border(rng, text):
    """A vertex, or a control point of an edge's curve, somewhere else."""
    every = {e.number: e for e in entities(text)}
    points = []
    for e in every.values():
        names = [text[a + 1: b] for a, b in found(REFERENCE, text, e.values)]
        if e.word == b"VERTEX_POINT":
            points += names
        if e.word == b"EDGE_CURVE" and len(names) > 2 and names[2] in every:
            curve = every[names[2]]
            parts = [text[a + 1: b] for a, b in found(REFERENCE, text, curve.values)]
            if curve.word == b"SURFACE_CURVE" and parts[0] in every:
                parts = [text[a + 1: b] for a, b in found(REFERENCE, text, every[parts[0]].values)]
            points += parts
    point = every[rng.choice([p for p in points if p in every and every[p].word == b"CARTESIAN_POINT"])]
    span = rng.choice(found(REAL, text, point.values))
    return put(text, span, b"%.6f" % (float(text[slice(*span)]) + rng.choice([1.0, -3.0, 20.0])))


def iges_field(rng, text):
    while True:
        begin = rng.choice([m.start() for m in re.finditer(rb"(?m)^.{72}P", text)])
        spans = [m.span(1) for m in re.compile(rb"(?:^|,)\s*([-\d][\d.eEdD+-]*)\s*(?=[,;])").finditer(text[begin: begin + 64])]
        if spans:
            a, b = rng.choice(spans)
            return begin + a, begin + b


def iges_place(text, at):
    """Fields of the entity that a byte of the parameter section belongs to, and the number of the field."""
    begin = text.rfind(b"\n", 0, at) + 1
    owner = text[begin + 64: begin + 72]
    fields, number = b"", None
    for line in re.finditer(rb"(?m)^(.{64})(.{8})P", text):
        if line[2] != owner:
            continue
        if line.start() == begin:
            number = (fields + line[1][: at - begin]).count(b",")
        fields += line[1].rstrip(b" ")
    return fields.split(b","), number


def is_inner_pole(text, at):
    """Whether a byte of an IGES file is a coordinate of a control point of a spline surface that is in no outer row or column."""
    fields, number = iges_place(text, at)
    if fields[0].strip() != b"128" or number is None:
        return False
    upper_u, upper_v, degree_u, degree_v = (int(field) for field in fields[1:5])
    poles = (upper_u + 1) * (upper_v + 1)
    first = 10 + (upper_u + degree_u + 2) + (upper_v + degree_v + 2) + poles
    pole = (number - first) // 3
    return first <= number < first + 3 * poles and 0 < pole % (upper_u + 1) < upper_u and 0 < pole // (upper_u + 1) < upper_v


def is_valid(sound, text, suffix):
    """Whether a changed file says another part without contradicting itself."""
    if suffix != ".igs" or len(sound) != len(text):
        return False
    at = next(k for k, (a, b) in enumerate(zip(sound, text)) if a != b)
    begin = text.rfind(b"\n", 0, at) + 1
    return text[begin + 72: begin + 73] == b"P" and is_inner_pole(sound, at)


def iges_number(rng, text):
    span = iges_field(rng, text)
    width = span[1] - span[0]
    new = rng.choice([b"0", b"1", b"-1", b"3", b"7", b"15", b"9" * min(width, 4), b"-2.5"] if width > 1 else [b"0", b"1", b"2", b"7"])
    return put(text, span, new[:width].ljust(width))


def iges_swap(rng, text):
    span = iges_field(rng, text)
    for _ in range(200):
        other = iges_field(rng, text)
        if other[1] - other[0] == span[1] - span[0]:
            return put(text, span, text[slice(*other)])
    return iges_number(rng, text)


def iges_directory(rng, text):
    begin = rng.choice([m.start() for m in re.finditer(rb"(?m)^.{72}D", text)]) + 8 * rng.randrange(9)
    return put(text, (begin, begin + 8), rng.choice([b"0", b"1", b"144", b"128", b"10101", b"3", b"126", b"510"]).rjust(8))


def iges_spelling(rng, text):
    spans = [s for s in (iges_field(rng, text) for _ in range(500)) if b"E" in text[slice(*s)] or b"D" in text[slice(*s)]]
    if not spans:
        return iges_swap(rng, text)
    word = text[slice(*spans[0])]
    return put(text, spans[0], rng.choice([word.lower(), word.replace(b"E", b"D"), word.replace(b"D", b"E")]))


def brep_number(rng, text):
    spans = found(re.compile(rb"(?<![\w.+-])-?\d+(?![\w.])"), text, (text.find(b"Curve2ds"), len(text)))
    return put(text, rng.choice(spans), rng.choice([b"0", b"1", b"2", b"3", b"7", b"-1", b"100"]))


def brep_reference(rng, text):
    spans = found(re.compile(rb"[+-]\d+ \d+"), text, (text.find(b"TShapes"), len(text)))
    return put(text, rng.choice(spans), text[slice(*rng.choice(spans))])


def brep_line(rng, text):
    lines = text.splitlines(keepends=True)
    del lines[rng.randrange(len(lines))]
    return b"".join(lines)


CHANGES = {".step": [step_spelling, step_reference, step_reference, step_list, step_list, step_count, step_knots, step_sense, step_unit,
                     step_gone, step_word, step_border, step_border],
           ".igs": [iges_number, iges_swap, iges_directory, iges_spelling],
           ".brep": [brep_number, brep_reference, brep_line]}


def inspected(flank, file):
    done = subprocess.run([flank, "inspect", file, "--json"], capture_output=True, check=False)
    return done.returncode, json.loads(done.stdout) if done.returncode == 0 else None


def notes(answer):
    return {note.replace(answer["file"], "") for note in answer["repairs"]}


def differs(sound, answer):
    if len(sound["faces"]) != len(answer["faces"]) or sound["solids"] != answer["solids"]:
        return True
    size = sum((h - l) ** 2 for l, h in zip(sound["box"]["low"], sound["box"]["high"])) ** 0.5
    faces = [(a, b) for a, b in zip(sound["faces"], answer["faces"]) if "area" in a]
    # A border that is off by a millionth of the face's size, in or out on both of its long sides.
    def most(face):
        return max(1e-3 * face["area"], 2e-6 * sum((h - l) ** 2 for l, h in zip(face["box"]["low"], face["box"]["high"])))

    # The box of all is that of triangles, which are a hundredth of an edge off and change with the order of the edges.
    return boxes_differ(sound["box"], answer["box"], 5e-3 * size) or any(
        "area" not in b or abs(a["area"] - b["area"]) > most(a) or boxes_differ(a["box"], b["box"], 1e-3 * size)
        for a, b in faces)


def boxes_differ(first, second, most):
    return any(abs(a - b) > most for c in ("low", "high") for a, b in zip(first[c], second[c]))


def judged(sound, code, answer, valid):
    if code != 0:
        return "refused" if code == 3 else f"exit {code}"
    if not differs(sound, answer):
        return "same"
    if notes(answer) - notes(sound) or answer["unit"] != sound["unit"]:
        return "told"
    return "valid" if valid else "silent"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("flank")
    parser.add_argument("parts", nargs="+")
    parser.add_argument("--trials", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", help="folder for what is found")
    options = parser.parse_args()
    counts = collections.defaultdict(collections.Counter)
    sound = {part: inspected(options.flank, part)[1] for part in options.parts}
    finds = 0
    with tempfile.TemporaryDirectory() as folder:
        for trial in range(options.trials):
            rng = random.Random(f"{options.seed} {trial}")
            part = rng.choice(options.parts)
            suffix = os.path.splitext(part)[1]
            change = rng.choice(CHANGES[suffix])
            with open(part, "rb") as stream:
                before = stream.read()
            text = change(rng, before)
            name = f"{change.__name__}_{options.seed}_{trial}{suffix}"
            file = os.path.join(folder, name)
            with open(file, "wb") as stream:
                stream.write(text)
            verdict = judged(sound[part], *inspected(options.flank, file), text != before and is_valid(before, text, suffix))
            counts[change.__name__][verdict] += 1
            if verdict == "silent" or verdict.startswith("exit"):
                finds += 1
                print(f"{verdict}: {name} of {part}", flush=True)
                if options.keep:
                    os.makedirs(options.keep, exist_ok=True)
                    os.replace(file, os.path.join(options.keep, name))
    for change, verdicts in sorted(counts.items()):
        print(f"{change}: {dict(verdicts)}")
    print(f"{options.trials} changed files, seed {options.seed}: {dict(sum(counts.values(), collections.Counter()))}")
    return 1 if finds else 0


if __name__ == "__main__":
    sys.exit(main())
