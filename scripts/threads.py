#!/usr/bin/env python3
"""Names those of the given test sources that reach a loop over several threads: the thread sanitizer has nothing to say of others.

usage: threads.py SOURCE...

A test reaches what it includes, and what is included there: of a header of ours, also the sources of its name (for the front door: in
any layer) and those of its room that include it, because they may define what it declares. Lines are read, no compiler is asked, so
a test may be named that starts no thread. Of the tests that run the command only those are named that stop it at work: what it does
on several threads is tested in the folders of its layers.
"""
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = sorted((ROOT / "src").rglob("*.cpp"))
FOLDERS = (ROOT / "src", ROOT / "include", ROOT / "tests")
# The last is of a test that stops the command while its threads work.
LOOP = re.compile(r"\b(?:parallel_for|parallel_blocks|journaled_for)\(|std::j?thread\b|std::async\b|\bstopped_at\(")
BASE = ROOT / "src/flank/base"  # defines the loops; what only includes it runs none


@functools.cache
def read(file):
    return file.read_text()


@functools.cache
def included(file):
    """Our own files that a file includes itself."""
    names = re.findall(r'^#include "(.+)"', read(file), re.MULTILINE)
    places = ([folder / name for folder in (*FOLDERS, file.parent) if (folder / name).is_file()] for name in names)
    return [found[0].resolve() for found in places if found]


@functools.cache
def includers():
    """Of each header, the sources of the library that include it."""
    found = {}
    for source in SOURCES:
        for header in included(source):
            found.setdefault(header, []).append(source)
    return found


@functools.cache
def sources_behind(header):
    """Sources that may define what a header of ours declares."""
    front = header.is_relative_to(ROOT / "include")
    named = [source for source in SOURCES if source.stem == header.stem and (front or source.parent == header.parent)]
    return named + [source for source in includers().get(header, ()) if source.parent == header.parent]


def reaches_a_loop(test):
    seen, left = {test}, [test]
    while left:
        file = left.pop()
        if LOOP.search(read(file)) and not file.is_relative_to(BASE):
            return True
        for other in (*included(file), *sources_behind(file)):
            if other not in seen:
                seen.add(other)
                left.append(other)
    return False


def main():
    for name in sys.argv[1:]:
        if reaches_a_loop(pathlib.Path(name).resolve()):
            print(name)


if __name__ == "__main__":
    main()
