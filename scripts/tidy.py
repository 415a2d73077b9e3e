#!/usr/bin/env python3
"""Lints the sources of the library and of the command with .clang-tidy, and fails on any finding.

usage: tidy.py BUILD_DIR [--deep] [--last COMMITS | FILE...]

Most of clang-tidy's time goes into the headers of third parties, which it walks through anew for every source. So sources
are put together in batches, each of which is read as one: only sources whose unnamed namespaces share no name go together.
A batch that does not compile is done source by source. --deep adds the static analyser (clang-analyzer-*), which looks at
one source at a time and takes many times as long; so does naming the files. --last 40 lints what the last 40 commits changed,
a source for its header, too; of more than 48 sources those that were changed last.

A source includes its own header first, which proves that header complete, because nothing is precompiled here. Headers without
a source are compiled alone.
"""
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from unity import groups_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("src/flank", "apps")
BATCH = 20
MOST = 48  # sources of --last: a merge of many branches would take longer than all tests; `make tidy` reads all
TIDY = next((name for name in ("clang-tidy-14", "clang-tidy") if subprocess.run(
    ["which", name], capture_output=True).returncode == 0), None)


def compile_arguments(build):
    """Of each source of ours what clang must know: definitions, folders of headers, language. No precompiled headers."""
    arguments = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        if not any(file.is_relative_to(ROOT / folder) for folder in FOLDERS):
            continue
        words, kept = iter(shlex.split(entry["command"])), []
        for word in words:
            if word == "-include" or word == "-o" or word == "-c":
                next(words)
            elif word.startswith(("-I", "-D", "-std=", "-fPI")):
                kept.append(word)
            elif word == "-isystem":
                kept += [word, next(words)]
        arguments[file] = kept
    return arguments


def changed_files(commits):
    """Names of what is not committed and of what the last commits changed, the newest first; None, if there are not so many commits."""
    names = []
    for words in (["diff", "--name-only", "HEAD"], ["log", "--format=", "--name-only", f"HEAD~{commits}..HEAD"]):
        done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            return None
        names += filter(None, done.stdout.splitlines())
    return list(dict.fromkeys(names))


def changed_sources(changed, arguments):
    """Sources that were changed, or whose header was: those that were changed last."""
    stems = [name.rsplit(".", 1)[0].removeprefix("include/").removeprefix("src/") for name in changed]
    place = {stem: k for k, stem in reversed(list(enumerate(stems)))}
    own = {file: str(file.relative_to(ROOT).with_suffix("")).removeprefix("src/") for file in arguments}
    newest = sorted((file for file in arguments if own[file] in place), key=lambda file: (place[own[file]], file))
    if len(newest) > MOST:
        print(f"{len(newest) - MOST} sources that were changed before are left to a lint of all", flush=True)
    return sorted(newest[:MOST])


def lone_headers():
    """Headers of ours without a source beside them, but for those that show types of third parties."""
    headers = [*(ROOT / "src/flank").rglob("*.h"), *(ROOT / "include/flank").rglob("*.h")]
    return sorted(header for header in headers if not header.with_suffix(".cpp").exists()
                  and "occt" not in header.name and "json" not in header.name)


def complete(header, arguments):
    """Whether a header compiles alone, and what the compiler says."""
    words = ["c++", "-fsyntax-only", *arguments, "-include", str(header), "-x", "c++", os.devnull]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    return done.returncode, done.stderr


def tidy(file, arguments, deep):
    """Exit status and findings of one file."""
    options = ["--quiet", f"--config-file={ROOT / '.clang-tidy'}"] + ([] if deep else ["--checks=-clang-analyzer-*,-bugprone-suspicious-include"])
    words = [TIDY, *options, r"--header-filter=/(include/flank|src/flank|apps)/.*\.(h|cpp)$", str(file), "--", *arguments,
             "-w"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    return done.returncode, done.stdout


def lint(batch, arguments, folder, number, deep):
    """Findings of a batch."""
    if len(batch) > 1:
        source = folder / f"batch_{number}.cpp"
        source.write_text("".join(f'#include "{file}"\n' for file in batch))
        together = list(dict.fromkeys(word for file in batch for word in arguments[file] if word != "-isystem"
                                      and not word.startswith("/")))
        for file in batch:
            system = [w for w in arguments[file] if w.startswith("/")]
            together += [word for path in system for word in ("-isystem", path)]
        status, text = tidy(source, together, deep)
        if "clang-diagnostic-error" not in text:
            return status, text
        print(f"batch {number} does not compile as one; its {len(batch)} sources are read one by one", flush=True)
    results = [tidy(file, arguments[file], deep) for file in batch]
    return max(status for status, _ in results), "".join(text for _, text in results)


def main():
    if TIDY is None:
        sys.exit("tidy.py: clang-tidy is not installed (on Debian 12, scripts/install-deps.sh dev installs it)")
    words = [word for word in sys.argv[1:] if word != "--deep"]
    deep = "--deep" in sys.argv
    last = int(words[2]) if len(words) == 3 and words[1] == "--last" else 0
    if not words:
        sys.exit(__doc__)
    arguments = compile_arguments(pathlib.Path(words[0]).resolve())
    named = [] if last else [pathlib.Path(word).resolve() for word in words[1:]]
    changed = changed_files(last) if last else None
    files = named or (sorted(arguments) if changed is None else changed_sources(changed, arguments))
    headers = [] if named else [header for header in lone_headers()
                                if changed is None or str(header.relative_to(ROOT)) in changed]
    if changed is not None and not files and not headers:
        print(f"the last {last} commits changed no source")
        return
    if not (files or headers) or any(file not in arguments for file in files):
        sys.exit(f"tidy.py: {words[0]} does not say how to compile {[str(f) for f in files if f not in arguments]}")
    batches = [[file] for file in files] if deep or named else groups_of(files, BATCH)
    failed = False
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
        jobs = [pool.submit(lint, batch, arguments, pathlib.Path(folder), number, deep)
                for number, batch in enumerate(batches)]
        # All sources are compiled with the same options, but for the headers of third parties that they may see.
        jobs += [pool.submit(complete, header, arguments[min(arguments)]) for header in headers]
        for job in jobs:
            status, text = job.result()
            failed = failed or status != 0
            sys.stdout.write(text)
    if failed:
        sys.exit(1)
    print(f"{len(files)} files are tidy ({len(batches)} batches), {len(headers)} headers compile alone")


if __name__ == "__main__":
    main()
