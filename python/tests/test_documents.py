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
                                   "- `what is asked for` is code here\n- a < b, and b > c\n")
    assert code == 0, errors


def test_tables_are_those_of_their_files():
    done = subprocess.run([sys.executable, ROOT / "scripts/results.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
