#!/usr/bin/env python3
"""Measures rows of bench/results/SET.json by the flank command alone; scripts/results.py then writes the tables.

usage: run_results.py FLANK [SET...] [--only WORD] [--again] [--limit S] [--work FOLDER] [--commit NAME]

A row that can be repeated has "run", the arguments of one or more commands without part and folder, and either "example", the arguments of
`flank example`, or "file", a name below $FLANK_DATA; "{part}" in "run" is that file without its ending. Figures come from summary.json and verify.json, the verdict from the exit code and the
reasons. A row is written as soon as it is measured, and is left out when the same commit has measured it; so a run that was stopped goes on.
--limit is the processor time of one command; a command that needs more is stopped by SIGINT, and its verdict says so. One command runs at a time.
"""
import argparse
import datetime
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
RESULTS = ROOT / "bench/results"
DATA = pathlib.Path(os.environ.get("FLANK_DATA", ROOT / "../shared/data"))
KEPT = ("part", "request", "file", "example", "run", "by")  # of a row: what is run; all else is measured
SLENDEREST, SHARPEST = 8.0, 15.0  # "usable": L:D, and degrees within 1 % of the face's diagonal
PLACE = re.compile(r",? (?:tip )?(?:at|near) \(.*|, (?:pass \d+|largest unproved).*|;.*")  # of a reason: where, and what to do


def part_of(flank, work, row):
    if "file" in row:
        return DATA / row["file"]
    words = row["example"].split()
    file = work / ("_".join(words).replace("--", "") + ".step")
    if not file.exists():
        subprocess.run([flank, "example", *words, "-o", file, "--quiet"], check=True)
    return file


def processor_seconds(pid):
    """Of a process that runs; 0 once it has ended."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def finish(child, limit):
    """Waits for the process, which is interrupted at the limit and killed at twice the limit: resources used, and whether it was stopped."""
    stopped = False
    while True:
        pid, status, usage = os.wait4(child.pid, os.WNOHANG)
        if pid:
            child.returncode = os.waitstatus_to_exitcode(status)
            return usage, stopped
        seconds = processor_seconds(child.pid)
        if seconds > limit:
            child.send_signal(signal.SIGKILL if seconds > 2 * limit else signal.SIGINT)
            stopped = True
        time.sleep(1.0 if stopped else 0.2)


def run(flank, part, words, folder, limit):
    """Summary, verdict file, how it ended, and seconds of one processor; both files are empty where there is no result."""
    shutil.rmtree(folder, ignore_errors=True)  # an older result must not be read for this one
    command = [flank, words[0], part, *words[1:], "--threads", "1", "--quiet", "-o", folder]
    with open(folder.with_suffix(".log"), "w", encoding="utf-8") as log:
        child = subprocess.Popen(command, stdout=log, stderr=log)
        usage, stopped = finish(child, limit)
    files = [folder / name for name in ("summary.json", "verify.json")]
    summary, verify = [json.loads(file.read_text(encoding="utf-8")) if file.exists() else {} for file in files]
    return summary, verify, "stopped" if stopped else child.returncode, usage.ru_utime + usage.ru_stime


def reasons(summary):
    texts = list(dict.fromkeys(PLACE.sub("", reason["text"]) for reason in summary["reasons"]))
    return "; ".join(texts[:2]) + (f"; and {len(texts) - 2} more" if len(texts) > 2 else "")


def verdict(summary, end, limit):
    """`end`: the exit code, or "stopped"."""
    if end == "stopped":
        return f"no: stopped after {limit} s"
    if not summary:
        return f"no result, exit code {end}"
    if (end == 0) != summary["pass"]:
        return f"exit code {end} does not agree with the summary"
    if not summary["pass"]:
        return "no: " + reasons(summary)
    if "cavity" in summary:
        return "meets"
    beyond = [text for text, bad in ((f"L:D is {summary['slenderness']:.1f}", summary["slenderness"] > SLENDEREST),
                                     (f"axial slip is {summary['largest_c']:.2f}", summary["largest_c"] >= 1.0),
                                     (f"it turns by {summary.get('largest_turn', 0):.0f} degrees", summary.get("largest_turn", 0) > SHARPEST)) if bad]
    return "meets the request but " + " and ".join(beyond) if beyond else "usable"


def cavity_figures(summary, verify):
    cavity, stock = summary["cavity"], verify.get("stock") or {}
    layers = cavity["layers"]
    figures = {"layers": len(layers), "cycles": sum(layer["cycles"] for layer in layers),
               "moves": f"{sum(layer['fronts'] + layer['backs'] for layer in layers) / 1000:.2f}", "width": f"{cavity['narrowest']:.3g}"}
    volume = sum(layer["volume"] + layer["side_volume"] + layer["entry_volume"] for layer in layers)
    figures |= {"engagement": f"{cavity['engagement']:.1f}", "volume": f"{volume / 1000:.2f}"}
    if stock.get("kinds"):
        figures["engagement"] += f", {stock['engagement_deg']:.1f}"
        figures["volume"] += f", {sum(kind['volume_mm3'] for kind in stock['kinds']) / 1000:.2f}"
    return figures


def figures_of(summary, verify):
    """The cells of one command by their column's name."""
    def percent(key):
        return f"{100 * summary[key]:.2f}" if summary.get(key) is not None else None

    def length(key):
        return f"{summary[key]:.4f}" if summary.get(key) is not None else None

    figures = {"finished": percent("coverage"), "of_accessible": percent("coverage_reachable"), "reachable": percent("reachable_share"), "gouge": length("overcut"),
               "gouge_others": length("other_faces_overcut"), "excess": length("undercut_covered"), "ld": f"{summary['slenderness']:.1f}"}
    if "cavity" in summary:
        return figures | cavity_figures(summary, verify)
    figures |= {"slip": f"{summary['largest_c']:.2f}", "passes": str(summary["strips"])}
    if summary.get("largest_turn") is not None:
        figures["turn"] = f"{summary['largest_turn']:.1f}"
    tools = [tool for tool in summary.get("stiffness", []) if tool["judged"]]
    if len(tools) > 1:
        share = [(tool["slenderness"], 100 * (tool.get("coverage_reachable") or tool["coverage"]), tool["chosen"]) for tool in tools]
        figures["curve"] = ", ".join(f"**{ld:.1f}: {part:.2f}**" if chosen else f"{ld:.1f}: {part:.2f}" for ld, part, chosen in share)
    return figures


def measure(flank, row, work, name, limit):
    """The row with all its cells anew; several commands stand in one cell in their order."""
    part, cells = part_of(flank, work, row), []
    for number, words in enumerate(row["run"]):
        summary, verify, end, seconds = run(flank, part, words.replace("{part}", str(part.with_suffix(""))).split(), work / f"{name}-{number + 1}", limit)
        told = {"cpu_s": f"{seconds:.0f}", "verdict": verdict(summary, end, limit)}
        cells.append((figures_of(summary, verify) if summary and summary.get("judged", True) else {}) | told)
    merged = {key: row[key] for key in KEPT if key in row}
    for key in dict.fromkeys(key for cell in cells for key in cell):
        values = [str(cell.get(key) or "") for cell in cells]
        merged[key] = values[0] if len(set(values)) == 1 and key in ("verdict", "passes") else ", ".join(values)
    return merged


def save(file, results):
    head = json.dumps({key: value for key, value in results.items() if key != "rows"}, indent=1)
    rows = ",\n".join("  " + json.dumps(row, ensure_ascii=False) for row in results["rows"])
    file.write_text(head[:-2] + ',\n "rows": [\n' + rows + "\n ]\n}\n", encoding="utf-8")


def processor():
    found = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    return f"one thread on a busy machine, {found[1].strip()}" if found else "one thread on a busy machine"


def measure_set(arguments, name):
    file = RESULTS / f"{name}.json"
    results = json.loads(file.read_text(encoding="utf-8"))
    for number, row in enumerate(results["rows"]):
        done = row.get("commit") == arguments.commit and not arguments.again
        if "run" not in row or done or (arguments.only and arguments.only not in json.dumps(row)):
            continue
        row = measure(arguments.flank, row, arguments.work, f"{name}-{number + 1}", arguments.limit) | {"commit": arguments.commit, "measured": datetime.date.today().isoformat()}
        results = json.loads(file.read_text(encoding="utf-8"))  # another row may have been changed by hand meanwhile
        results["rows"][number] = row
        results |= {"measured": row["measured"], "source": "measured", "commit": arguments.commit,
                    "command": f"bench/run_results.py FLANK {name}", "machine": processor()}
        save(file, results)
        print(f"{name}: {row['part']}, {row['request']}: {row['finished'] if 'finished' in row else ''} in {row['cpu_s']} s, {row['verdict']}", flush=True)


def main():
    head = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False).stdout.strip()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("flank", type=pathlib.Path)
    parser.add_argument("sets", nargs="*", metavar="SET", help="default: every set that has rows to run")
    parser.add_argument("--only", help="rows that hold this word")
    parser.add_argument("--again", action="store_true", help="also rows that this commit has measured")
    parser.add_argument("--limit", type=int, default=600, help="seconds of one processor for a command; default: 600")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build/results")
    parser.add_argument("--commit", default=head, help="the commit that FLANK was built from; default: that of the tree")
    arguments = parser.parse_intermixed_args()
    arguments.flank = arguments.flank.resolve()
    arguments.work = arguments.work.resolve()
    arguments.work.mkdir(parents=True, exist_ok=True)
    for name in arguments.sets or sorted(file.stem for file in RESULTS.glob("*.json")):
        measure_set(arguments, name)


if __name__ == "__main__":
    main()
