#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a stop signal to the committed end of `hoctomap build`, at random moments of a run.

usage: stop_times.py HOCTOMAP LOG COUNT SEED [OPTION of build ...]
Prints seconds of the clock. Fails at a map that is not whole, or at an exit code that is not that of a stop."""
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import time


def stop_after(wait, command):
    """(exit code, seconds from the signal to the end)"""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(wait)
    start = time.monotonic()
    process.send_signal(signal.SIGTERM)
    return process.wait(), time.monotonic() - start


def main():
    program, log, count, seed, *options = sys.argv[1:]
    rng = random.Random(int(seed))
    with tempfile.TemporaryDirectory() as folder:
        build = [program, "build", "-q", "-i", log, *options, "-o"]
        start = time.monotonic()
        subprocess.run([*build, f"{folder}/whole"], check=True, stdout=subprocess.DEVNULL)
        duration = time.monotonic() - start
        stops = []
        while len(stops) < int(count):
            map = f"{folder}/map{len(stops)}"
            code, passed = stop_after(rng.uniform(0.1, 0.95) * duration, [*build, map])
            if code == 0:
                continue  # it had ended
            if code != 143:
                sys.exit(f"exit code {code}")
            if os.path.exists(f"{map}/hierarchy.yaml"):
                subprocess.run([program, "verify", map], check=True, stdout=subprocess.DEVNULL)
            stops.append(passed)
            subprocess.run(["rm", "-rf", map])
    print(f"a run of {duration:.1f} s, {len(stops)} stops: ended after {statistics.median(stops):.2f} s (median), {max(stops):.2f} s (longest); load {os.getloadavg()[0]:.1f}")


main()
