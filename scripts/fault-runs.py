#!/usr/bin/env python3
"""Whole commands in which every call that changes the disk fails once, in turn, or is the last one before a kill.

usage: fault-runs.py FLANK FAULT_SHIM [--commands verify,report,fit,cover] [--every N] [--allocations N]

FAULT_SHIM is tests/libfault_shim.so of the build. After each run the folder must hold the old result whole or the new
one whole, by the hashes of its manifest, and nothing may lie about once the next command has opened it; the exit code
must be one that the README names. Then each command runs with ever less memory, and with single allocations that fail,
so many of them, spread over the run: it ends, or says what is missing, and does not crash. Exit code: 1 if anything is
found.
"""
import argparse
import errno
import hashlib
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile

HOWS = [str(errno.ENOSPC), "always " + str(errno.EIO), "kill"]
OURS = (".flank-", ".part-")
MEMORY_STEPS_MB = [4000, 1500, 800, 500, 350, 250, 180, 130, 90, 60, 40, 25]


class Runs:
    def __init__(self, flank, shim, folder):
        self.flank, self.shim, self.folder = flank, shim, folder
        self.out, self.old = os.path.join(folder, "out"), os.path.join(folder, "old")
        part = os.path.join(folder, "part.step")
        self.call(["example", "envelope-cone-1", "-o", part])
        # The part's own tool, and its own motion to start from: no search, so that a run takes a second.
        tool, guide = os.path.join(folder, "part.tool.json"), os.path.join(folder, "guide.txt")
        self.write_guide(guide, os.path.join(folder, "part.path.json"))
        plan = [part, "--face", "F1", "--tolerance", "0.1", "--tool", tool, "-o", self.out]
        fit, cover = ["fit", *plan, "--guide", guide], ["cover", *plan]
        self.commands = {"fit": fit, "cover": cover, "verify": ["verify", self.out], "report": ["report", self.out]}
        self.call(fit)
        shutil.copytree(self.out, self.old)
        self.finds = []

    def write_guide(self, file, path):
        """A few axes of a path."""
        with open(path, encoding="utf-8") as stream:
            poses = json.load(stream)["strips"][0]["poses"]
        with open(file, "w", encoding="utf-8") as stream:
            for k in range(8):
                pose = poses[k * (len(poses) - 1) // 7]
                tip, axis = pose[:3], pose[3:6]
                stream.write(" ".join(str(x) for x in [*tip, *(t + 50 * a for t, a in zip(tip, axis))]) + "\n")

    def call(self, words, environment=None, limit=None, pass_fds=()):
        def limits():
            if limit:
                resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        return subprocess.run([self.flank, *words, "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              env={**os.environ, **(environment or {})}, preexec_fn=limits, pass_fds=pass_fds, check=False)

    def restore(self):
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.old, self.out)

    def with_fault(self, words, at, how):
        """Exit code, and the calls that the command made (0 if it was killed)."""
        ours, theirs = os.pipe()
        done = self.call(words, {"LD_PRELOAD": self.shim, "FLANK_FAULT_AT": str(at), "FLANK_FAULT_HOW": how,
                                 "FLANK_FAULT_COUNT": str(theirs)}, pass_fds=(theirs,))
        os.close(theirs)
        with os.fdopen(ours, "rb") as stream:
            counts = stream.read()
        # Children that read parts count, too; the command itself ends last.
        return done.returncode, int.from_bytes(counts[-4:], "little") if counts else 0

    def state(self):
        """What is wrong with the folder, or None."""
        self.call(["report", self.out])
        left = [name for name in os.listdir(self.out) if any(mark in name for mark in OURS)]
        if left:
            return f"{left[0]} is left"
        try:
            with open(os.path.join(self.out, "manifest.json"), encoding="utf-8") as stream:
                files = json.load(stream)["files"]
        except (OSError, ValueError) as error:
            return f"no manifest: {error}"
        for name, known in files.items():
            file = os.path.join(self.out, name)
            if not os.path.exists(file):
                return f"{name} is gone"
            with open(file, "rb") as stream:
                if hashlib.sha256(stream.read()).hexdigest() != known:
                    return f"{name} is of another result"
        return None

    def every_call(self, name, every):
        words = self.commands[name]
        self.restore()
        code, calls = self.with_fault(words, 0, "kill")
        if code not in (0, 1) or calls == 0:
            self.finds.append(f"{name}: exit {code}, {calls} calls, without a fault")
        runs = 0
        for how in HOWS:
            for at in range(1, calls + 1, every):
                self.restore()
                code, _ = self.with_fault(words, at, how)
                runs += 1
                wrong = None if code in (0, 1, 3) or (how == "kill" and code == -9) else f"exit {code}"
                wrong = wrong or self.state()
                if wrong:
                    self.finds.append(f"{name}: {wrong} (call {at} of {calls}, {how})")
                    print(self.finds[-1], flush=True)
        print(f"{name}: {calls} calls, {runs} runs", flush=True)

    def failing_allocations(self, name, count):
        words = self.commands[name] + ["--threads", "1"]

        def run(at):
            self.restore()
            ours, theirs = os.pipe()
            done = self.call(words, {"LD_PRELOAD": self.shim, "FLANK_FAULT_ALLOCATION": str(at),
                                     "FLANK_FAULT_COUNT": str(theirs)}, pass_fds=(theirs,))
            os.close(theirs)
            with os.fdopen(ours, "rb") as stream:
                counts = stream.read()
            return done, int.from_bytes(counts[-4:], "little") if counts else 0

        _, most = run(0)
        numbers = sorted({1 + k * most // max(1, count) for k in range(count)}) if most else []
        codes = {}
        for at in numbers:
            done, _ = run(at)
            codes[done.returncode] = codes.get(done.returncode, 0) + 1
            wrong = None if done.returncode in (0, 1, 3, 4) else f"exit {done.returncode}"
            wrong = wrong or self.state()
            if wrong:
                self.finds.append(f"{name}: {wrong} (allocation {at} of {most}): "
                                  f"{done.stderr[-200:].decode(errors='replace')}")
                print(self.finds[-1], flush=True)
        print(f"{name}: {len(numbers)} of {most} allocations failed, exit codes {codes}", flush=True)

    def ever_less_memory(self, name):
        codes = []
        for megabytes in MEMORY_STEPS_MB:
            self.restore()
            done = self.call(self.commands[name] + ["--threads", "1"], limit=megabytes * 1_000_000)
            codes.append(done.returncode)
            # 127: not even the program itself could be loaded.
            wrong = None if done.returncode in (0, 1, 3, 4, 127) else f"exit {done.returncode}"
            wrong = wrong or self.state()
            if wrong:
                self.finds.append(f"{name}: {wrong} ({megabytes} MB): {done.stderr[-200:].decode(errors='replace')}")
                print(self.finds[-1], flush=True)
        print(f"{name}: exit codes with ever less memory {codes}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("flank")
    parser.add_argument("shim")
    parser.add_argument("--commands", default="verify,report,fit,cover")
    parser.add_argument("--every", type=int, default=1, help="only every so many calls")
    parser.add_argument("--allocations", type=int, default=100, help="how many single allocations fail")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(os.path.abspath(options.flank), os.path.abspath(options.shim), folder)
        for name in options.commands.split(","):
            runs.every_call(name, options.every)
            runs.ever_less_memory(name)
            runs.failing_allocations(name, options.allocations)
        print(f"{len(runs.finds)} finds")
    return 1 if runs.finds else 0


if __name__ == "__main__":
    sys.exit(main())
