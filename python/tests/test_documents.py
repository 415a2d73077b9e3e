"""scripts/check-words finds what it is there to find, and scripts/results.py a table that was changed by hand."""

import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHORT = "This sentence is short. "


def check(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    done = subprocess.run([sys.executable, ROOT / "scripts/check-words", page], capture_output=True, text=True)
    return done.returncode, done.stderr


@pytest.mark.parametrize(
    "text, fault",
    [
        (SHORT * 20 + "And " + "so on " * 31 + "it goes.", "a sentence of 65 words"),
        (("Words " + "go on " * 10 + "here. ") * 3, "words in the median"),
        (SHORT * 8 + ("One of ten sentences is so long that nobody who reads it " * 3 + "knows its end. "), "one sentence in ten"),
        (SHORT * 31, "a paragraph of 124 words"),
        (f"- {SHORT * 8}\n" * 4, "a list of 128 words without a blank line"),
        ("Since then it is faster.", '"Since then"'),
        ("| table |\n|---|\n| covers 99 % of what is reachable |\n", "of what is reachable"),
        ("See [there](missing.md).", "no file missing.md"),
        ("# One heading\n\nSee [there](#another-heading).", "no heading #another-heading"),
        ("```sh\nflank fitt blade.step\n```\n", "flank has no command fitt"),
        ("```sh\nflank fit blade.step --tolernce 0.1\n```\n", "flank fit has no option --tolernce"),
    ],
)
def test_a_fault_is_found(tmp_path, text, fault):
    code, errors = check(tmp_path, text)
    assert code == 1 and fault in errors, errors


def test_what_is_well_written_passes(tmp_path):
    code, errors = check(tmp_path, "# A page\n\nIt is short: see [above](#a-page).\n\n```sh\nflank fit blade.step --tolerance 0.1 -o out   # a comment\n```\n\n"
                                   "- `what is asked for` is code here\n- a < b, and b > c\n\n"
                                   + f"- {SHORT * 8}\n\n" * 4 + f"- {SHORT * 4}\n" * 8)
    assert code == 0, errors


def test_tables_are_those_of_their_files():
    done = subprocess.run([sys.executable, ROOT / "scripts/results.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def script(folder, name):
    path = sys.path[:]
    sys.path.insert(0, str(ROOT / folder))
    module = __import__(name)
    sys.path[:] = path
    return module


@pytest.fixture
def results():
    return script("bench", "run_results")


def test_rows_of_another_run_are_named():
    rows = [{"verdict": "usable", "commit": commit, "measured": day} for commit, day in (("aa", "2026-01-02"), ("bb", "2026-01-01"), ("aa", "2026-01-02"), ("bb", "2026-01-01"), ("aa", "2026-01-02"))]
    when = script("scripts", "results").when
    assert when({"measured": "2026-01-02", "commit": "aa", "rows": rows}) == "2026-01-02 at aa, rows 2 and 4 2026-01-01 at bb"
    assert when({"measured": "2026-01-02", "commit": "aa", "rows": rows[:1]}) == "2026-01-02 at aa"


def summary(**more):
    return {"pass": True, "complete": True, "slenderness": 3.0, "largest_c": 0.2, "largest_turn": 4.0, "reasons": []} | more


@pytest.mark.parametrize(
    "found, end, told",
    [
        (summary(), 0, "usable"),
        (summary(slenderness=8.2), 0, "meets the request but L:D is 8.2"),
        (summary(largest_c=1.07), 0, "meets the request but axial slip is 1.07"),
        (summary(cavity={}), 0, "meets"),
        (summary(), 1, "exit code 1 does not agree with the summary"),
        (summary(**{"pass": False}), "stopped", "no: stopped after 600 s"),
        ({}, 3, "no result, exit code 3"),
    ],
)
def test_a_row_is_called_usable_only_if_it_is(results, found, end, told):
    assert results.verdict(found, end, 600) == told


def test_a_reason_is_told_without_its_place(results):
    texts = ("nothing could hold the tool: above the flank its axis runs through F46 at (1.000, 2.000, 3.000), pass 2",
             "the motion changes direction by 21.3 degrees > 15 within 1 % of the face's diagonal, pass 1, tip at (0.000, 0.000, 0.000)",
             "F2 is gouged by 0.1000 mm > 0.05 mm at (0.000, 0.000, 0.000), pass 1")
    found = summary(**{"pass": False}, reasons=[{"figure": "", "text": text} for text in texts])
    assert results.verdict(found, 1, 600) == ("no: nothing could hold the tool: above the flank its axis runs through F46; "
                                              "the motion changes direction by 21.3 degrees > 15 within 1 % of the face's diagonal; and 1 more")


def test_a_command_is_measured_stopped_at_its_limit_and_never_read_from_an_older_folder(results, tmp_path):
    flank = tmp_path / "flank"
    flank.write_text(f"#!{sys.executable}\nimport json, pathlib, sys\nout = pathlib.Path(sys.argv[-1])\nout.mkdir()\n"
                     "if 'slow' in sys.argv:\n    while True: pass\n"
                     "out.joinpath('summary.json').write_text(json.dumps({'words': sys.argv[1:]}))\n")
    flank.chmod(0o755)
    found, _, end, seconds = results.run(flank, "part.step", ["fit", "--face", "F1"], tmp_path / "out", 60)
    assert found["words"][:4] == ["fit", "part.step", "--face", "F1"] and end == 0 and seconds > 0
    found, _, end, _ = results.run(flank, "part.step", ["fit", "slow"], tmp_path / "out", 0.3)
    assert found == {} and end == "stopped"
