"""A part that the program makes itself, and one result of it: made once, because a fit takes seconds."""

import os
import pathlib
import subprocess

import pytest

import openflank

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def flank():
    """Runs the command; the exit code is that of a result, good or not."""
    def run(*words, codes=(0, 1)):
        done = subprocess.run([os.environ["FLANK_BINARY"], *map(str, words)], capture_output=True, text=True)
        assert done.returncode in codes, done.stderr
        return done.stdout
    return run


@pytest.fixture(scope="session")
def blade(flank, tmp_path_factory):
    file = tmp_path_factory.mktemp("part") / "blade.step"
    flank("example", "twisted-blade", "-o", file)
    return file


@pytest.fixture(scope="session")
def fitted(blade):
    return openflank.fit(blade, faces="F1", side="+", tolerance_mm=0.1)


@pytest.fixture(scope="session")
def folder(fitted, tmp_path_factory):
    """What fit wrote; tests leave it as it is."""
    folder = tmp_path_factory.mktemp("results") / "out"
    fitted.write(folder)
    return folder
