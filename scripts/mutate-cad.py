#!/usr/bin/env python3
"""Damages STEP, IGES and BREP files and holds `flank inspect` to its promise: an answer, or exit 3 with one line.

usage: mutate-cad.py FLANK [PART...] [--trials N] [--seed N] [--keep FOLDER]

Without parts, those of $FLANK_DATA (and its zoo) up to 600 kB are taken, else an example. Each trial is made from the
seed and its number alone, so a find can be made again. A find is a crash, more than 30 s of processor time, more than
2 GB, another exit code or more than one line, an answer that holds a number that is none, or an answer from a STEP file
one of whose numbers is none. Finds are kept in FOLDER. Exit code: 1 if there are finds.
"""
import argparse
import json
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import time

MOST_SECONDS = 30.0
MOST_BYTES = 2e9
MOST_WALL = 600.0  # for machines that do other things besides
LARGEST_PART = 600_000
KINDS = {".step": "step", ".stp": "step", ".igs": "iges", ".iges": "iges", ".brep": "brep"}

NUMBER = re.compile(rb"(?<![\w#.'])-?\d+\.\d*(?:[EDed][+-]?\d+)?")
INTEGER = re.compile(rb"(?<![\w#.'+-])\d+(?![\w.])")
REFERENCE = re.compile(rb"#\d+")
NO_NUMBERS = [b"0x1p5", b"--3.", b"nan", b"inf", b"1.E400", b"", b"1.2.3", b"1.e", b"+-1.", b"1,,2."]
OTHER_NUMBERS = [b"0.", b"-1.", b"1.E308", b"-1.E30", b"1.E-320", b"1.E7", b"1.E-9", b"99999999999999999999."]
OTHER_INTEGERS = [b"0", b"1", b"2", b"-1", b"25", b"1000", b"2147483647", b"2147483648", b"4294967296", b"99999999999"]


def pick(rng, pattern, text):
    found = [m.span() for m in pattern.finditer(text)]
    return rng.choice(found) if found else None


def replaced(text, span, by):
    return text[: span[0]] + by + text[span[1]:]


def flip(rng, text):
    at = rng.randrange(len(text))
    return text[:at] + bytes([text[at] ^ (1 << rng.randrange(8))]) + text[at + 1:]


def no_number(rng, text):
    span = pick(rng, NUMBER, text)
    return replaced(text, span, rng.choice(NO_NUMBERS)) if span else flip(rng, text)


def other_number(rng, text):
    span = pick(rng, NUMBER, text)
    return replaced(text, span, rng.choice(OTHER_NUMBERS)) if span else flip(rng, text)


def other_integer(rng, text):
    span = pick(rng, INTEGER, text)
    return replaced(text, span, rng.choice(OTHER_INTEGERS)) if span else flip(rng, text)


def other_reference(rng, text):
    spans = [m.span() for m in REFERENCE.finditer(text)]
    if len(spans) < 2:
        return other_integer(rng, text)
    a, b = rng.choice(spans), rng.choice(spans)
    return replaced(text, a, text[b[0]: b[1]] if rng.random() < 0.8 else b"#999999999")


def truncated(rng, text):
    return text[: rng.randrange(1, len(text))]


def lines_of(text):
    return text.splitlines(keepends=True)


def line_twice(rng, text):
    lines = lines_of(text)
    lines.insert(rng.randrange(len(lines)), rng.choice(lines))
    return b"".join(lines)


def line_gone(rng, text):
    lines = lines_of(text)
    del lines[rng.randrange(len(lines))]
    return b"".join(lines)


def lines_swapped(rng, text):
    lines = lines_of(text)
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]
    return b"".join(lines)


DAMAGES = [flip, no_number, other_number, other_integer, other_reference, truncated, line_twice, line_gone, lines_swapped]


def damaged(seed, trial, parts):
    rng = random.Random(f"{seed} {trial}")
    name, text = rng.choice(parts)
    damage = rng.choice(DAMAGES)
    return name, damage.__name__, damage(rng, text)


def bytes_of(usage):
    return usage.ru_maxrss * 1024.0


def run(command):
    """Exit code (negative: signal; None: took too long), output, messages, processor seconds, peak bytes."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen(command, stdout=out, stderr=err, start_new_session=True)
        end = time.monotonic() + MOST_WALL
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                process.returncode = os.waitstatus_to_exitcode(status)
                break
            if time.monotonic() > end:
                os.killpg(process.pid, 9)
                _, _, usage = os.wait4(process.pid, 0)
                process.returncode = None
                break
            time.sleep(0.01)
        out.seek(0)
        err.seek(0)
        seconds = usage.ru_utime + usage.ru_stime
        return process.returncode, out.read(), err.read(), seconds, bytes_of(usage)


def numbers_in(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            yield from numbers_in(item)
    elif isinstance(value, float):
        yield value


def answer_is_sound(text):
    """Figures that are none cannot be written as JSON numbers; texts may name what was read and refused."""
    try:
        return all(abs(x) < 1e16 for x in numbers_in(json.loads(text)))
    except ValueError:
        return False


def find(name, kind, damage, code, out, err, seconds, peak):
    """What is wrong, or None."""
    if code is None or seconds > MOST_SECONDS:
        return "over time"
    if peak > MOST_BYTES:
        return "over memory"
    if code < 0 or code not in (0, 3):
        return "crash" if code < 0 else f"exit {code}"
    if code == 3:
        lines = err.strip().splitlines()
        return None if len(lines) == 1 and name.encode() in lines[0] else "not one line that names the file"
    if not answer_is_sound(out):
        return "wrong answer"
    if kind == "step" and damage == "no_number":
        return "wrong answer"
    return None


def default_parts(flank, folder):
    data = os.environ.get("FLANK_DATA", "")
    files = []
    for place in (data, os.path.join(data, "zoo")):
        if data and os.path.isdir(place):
            files += [os.path.join(place, f) for f in sorted(os.listdir(place)) if not f.startswith("nasty")]
    files = [f for f in files if os.path.splitext(f)[1] in KINDS and os.path.getsize(f) <= LARGEST_PART]
    if files:
        return files
    example = os.path.join(folder, "example.step")
    subprocess.run([flank, "example", "twisted-blade", "-o", example, "--quiet"], check=True)
    return [example]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("flank")
    parser.add_argument("parts", nargs="*")
    parser.add_argument("--trials", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="number of the first trial")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", help="folder for what is found")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory() as folder:
        parts = []
        for file in options.parts or default_parts(options.flank, folder):
            with open(file, "rb") as stream:
                parts.append((file, stream.read()))
        finds, read, most_seconds, most_bytes = {}, 0, 0.0, 0.0
        for trial in range(options.first, options.first + options.trials):
            source, damage, text = damaged(options.seed, trial, parts)
            suffix = os.path.splitext(source)[1]
            name = f"{os.path.splitext(os.path.basename(source))[0]}_{damage}_{options.seed}_{trial}{suffix}"
            file = os.path.join(folder, name)
            with open(file, "wb") as stream:
                stream.write(text)
            code, out, err, seconds, peak = run([options.flank, "inspect", file, "--json", "--threads", "1"])
            read += code == 0
            most_seconds, most_bytes = max(most_seconds, seconds), max(most_bytes, peak)
            wrong = find(name, KINDS[suffix], damage, code, out, err, seconds, peak)
            if wrong:
                finds[wrong] = finds.get(wrong, 0) + 1
                print(f"{wrong}: {name}: {seconds:.1f} s, {peak / 1e6:.0f} MB, {err[-200:].decode(errors='replace')}", flush=True)
                if options.keep:
                    os.makedirs(options.keep, exist_ok=True)
                    os.replace(file, os.path.join(options.keep, name))
                    continue
            os.remove(file)
        print(f"{options.trials} damaged files of {len(parts)} parts, seed {options.seed}: {read} read, {sum(finds.values())} "
              f"finds {finds}; at most {most_seconds:.1f} s of processor time, {most_bytes / 1e6:.0f} MB")
    return 1 if finds else 0


if __name__ == "__main__":
    sys.exit(main())
