#!/usr/bin/env python3
"""Fits faces of the parts of $FLANK_DATA/zoo, a thousandth of their diagonal as the tolerance, and again with something made easier: that
must not be worse.

usage: monotone.py FLANK ZOO OUT [RELATION,...] [PART or PART:FACE...]

RELATION: double (twice the tolerance), looser (1.25 times), ignore (the face that is entered deepest is not checked), strips (one strip more
than the first run took); none: the faces as they are. Worse is: coverage falls by more than half a percent, something is cut beyond the
tolerance, or the result is not within what was asked, where it was. What lies below OUT from an earlier call is not fitted again.
"""
import json
import math
import os
import pathlib
import subprocess
import sys

FACES = {
    "asitus_blade.igs": "F1 F5", "clarkyeah_blade.igs": "F1a F1b", "occt_bug25994_wing.brep": "F1a F4a", "occt_bug26264_blade.brep": "F1a F1b",
    "turbo3d_compressor_export.step": "F231 F232 F251 F252", "seeddrone_propeller_blade.stp": "F8 F23 F13 F28",
    "autogiro_prop1045.step": "F15 F22 F17 F24", "asitus_hpdc.stp": "F105 F107 F163 F164", "hecc_main_blade.step": "F1 F3",
    "screw_male_rotor_4lobe.step": "F1 F2 F3 F4",
}
SAME = 0.005  # of coverage: less is no difference


def boxes(flank, part):
    """The diagonal of every face and piece."""
    text = subprocess.run([flank, "inspect", part, "--json"], capture_output=True, text=True, check=True).stdout
    found = {}
    for face in json.loads(text)["faces"]:
        for piece in [face] + face.get("pieces", []):
            found[piece["id"]] = math.dist(piece["box"]["low"], piece["box"]["high"])
    return found


def fit(flank, part, face, tolerance, out, more):
    """Summary and processor time, both kept in the folder."""
    figures = out / "figures.json"
    if not figures.exists():
        out.mkdir(parents=True, exist_ok=True)
        command = [flank, "fit", part, "--face", face, "--tolerance", f"{tolerance:.3g}", "--threads", "1", "-o", out] + more
        with open(out.with_suffix(".log"), "w") as log:
            child = subprocess.Popen([str(word) for word in command], stdout=log, stderr=log)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        summary = json.loads((out / "summary.json").read_text()) if (out / "summary.json").exists() else {}
        figures.write_text(json.dumps({"exit": child.returncode, "seconds": usage.ru_utime + usage.ru_stime, "peak_mb": usage.ru_maxrss / 1024,
                                       "summary": summary}))
    return json.loads(figures.read_text())


def row(name, found):
    s = found["summary"]
    if not s:
        return f"{name:44} no result, exit {found['exit']}, {found['seconds']:.0f} s"
    usable = s["within"] and s["slenderness"] <= 8 and s["largest_c"] < 1 and s["largest_turn"] <= 10
    return (f"{name:44} {100 * s['coverage']:6.2f} ({100 * (s['coverage_reachable'] or 0):6.2f}) over {s['overcut']:.4f} others {s['other_faces_overcut']:.4f} "
            f"of {s['tolerance']:.3g} c {s['largest_c']:.2f} lambda {s['slenderness']:.1f} turn {s['largest_turn']:.1f} strips {s['strips']} "
            f"{found['seconds']:.1f} s {found['peak_mb']:.0f} MB {'usable' if usable else 'within' if s['within'] else 'NO'}")


def is_worse(plain, easier):
    a, b = plain["summary"], easier["summary"]
    if not a or not b:
        return bool(a) and not b

    def beyond(s):
        return max(s["overcut"], s["other_faces_overcut"]) > s["tolerance"]

    return b["coverage"] < a["coverage"] - SAME or (a["within"] and not b["within"]) or (beyond(b) and not beyond(a))


def deepest_other(out):
    """The name of the face, not machined, that the tool enters deepest."""
    faces = json.loads((out / "verify.json").read_text())["faces"]
    others = [f for f in faces if not f["target"]]
    return max(others, key=lambda f: f["overcut_mm"])["face"] if others else None


def changed(relation, tolerance, out, summary):
    """The tolerance and the words of the easier run; None if there is none."""
    if relation in ("double", "looser"):
        return tolerance * (2.0 if relation == "double" else 1.25), []
    if relation == "strips":
        return tolerance, ["--strips", str(summary["strips"] + 1)]
    other = deepest_other(out)
    return (tolerance, ["--ignore-faces", other]) if other else None


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    flank, zoo, root = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    relations = [word for word in sys.argv[4].split(",") if word != "none"] if len(sys.argv) > 4 else []
    names, seconds, worse = sys.argv[5:], [], 0
    for part, faces in FACES.items():
        chosen = [f for f in faces.split() if not names or part in names or f"{part}:{f}" in names]
        if not chosen:
            continue
        sizes = boxes(flank, zoo / part)
        for face in chosen:
            tolerance = float(f"{1e-3 * sizes[face]:.2g}")
            stem = f"{part.split('.')[0]}-{face}"
            plain = fit(flank, zoo / part, face, tolerance, root / stem, [])
            seconds.append(plain["seconds"])
            print(row(stem, plain), flush=True)
            for relation in relations:
                change = plain["summary"] and changed(relation, tolerance, root / stem, plain["summary"])
                if not change:
                    continue
                easier = fit(flank, zoo / part, face, change[0], root / f"{stem}-{relation}", change[1])
                bad = is_worse(plain, easier)
                worse += bad
                print(row(f"  {relation} {' '.join(change[1])}", easier), "WORSE" if bad else "", flush=True)
    seconds.sort()
    print(f"median {seconds[len(seconds) // 2]:.1f} s, {worse} worse" if seconds else "no such face")


if __name__ == "__main__":
    main()
