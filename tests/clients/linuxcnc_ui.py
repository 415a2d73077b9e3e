#!/usr/bin/env python3
# The "screen" of a headless LinuxCNC: homes, runs the program of NGC to its end while the joints are logged at 1 kHz, and writes what
# was seen to the file of RESULT. LinuxCNC itself starts it; only its own Python has the module `linuxcnc`.
import json
import os
import subprocess
import sys
import time

import linuxcnc

JOINTS = 5
LIMIT_S = float(os.environ.get("LIMIT_S", "250"))

command = linuxcnc.command()
stat = linuxcnc.stat()
errors = linuxcnc.error_channel()
messages = []


def poll_errors():
    """Messages of the control since the last call; true if one of them is an error."""
    bad = False
    while True:
        message = errors.poll()
        if not message:
            return bad
        kind, text = message
        messages.append(text)
        bad = bad or kind in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR)


def wait_for(condition, seconds):
    end = time.time() + seconds
    while time.time() < end:
        stat.poll()
        if condition():
            return True
        time.sleep(0.005)
    return False


def do(call, *values):
    call(*values)
    command.wait_complete()


def run():
    do(command.state, linuxcnc.STATE_ESTOP_RESET)
    do(command.state, linuxcnc.STATE_ON)
    do(command.mode, linuxcnc.MODE_MANUAL)
    command.home(-1)
    if not wait_for(lambda: all(stat.homed[:JOINTS]), 20):
        return "not homed"
    do(command.teleop_enable, 1)
    do(command.mode, linuxcnc.MODE_MDI)
    do(command.mdi, os.environ["OFFSET"])
    do(command.mode, linuxcnc.MODE_AUTO)
    with open(os.environ["JOINT_LOG"], "w") as log:
        sampler = subprocess.Popen(["halsampler", "-c", "0"], stdout=log)
        try:
            do(command.program_open, os.environ["NGC"])
            command.auto(linuxcnc.AUTO_RUN, 0)
            time.sleep(0.05)
            seen = []

            def ended():
                seen.append(poll_errors())
                return stat.interp_state == linuxcnc.INTERP_IDLE and stat.exec_state in (linuxcnc.EXEC_DONE, linuxcnc.EXEC_ERROR)

            done = wait_for(ended, LIMIT_S)
            time.sleep(0.1)
            if any(seen) or poll_errors():
                return "error"
            return "end" if done else "out of time"
        finally:
            sampler.terminate()
            sampler.wait()


begin = time.time()
outcome = run()
stat.poll()
with open(os.environ["RESULT"], "w") as file:
    json.dump({"outcome": outcome, "messages": messages, "line": stat.motion_line, "seconds": time.time() - begin}, file)
sys.exit(0 if outcome == "end" else 1)
