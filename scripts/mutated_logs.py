#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mutated logs end to end: `hoctomap build` on changed copies of WORK/a.rawlog, plain and compressed.

usage: mutated_logs.py HOCTOMAP WORK COUNT SEED
Fails at the first run that ends by a signal, takes longer than a minute, has an exit code that is not documented,
or does not say in one line what is wrong.
"""
import collections
import gzip
import random
import shutil
import subprocess
import sys


def mutated(log, rng):
    log = bytearray(log)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(log))
        kind = rng.randrange(5)
        if kind == 0:
            log[at] = rng.randrange(256)
        elif kind == 1:
            log[at] ^= 1 << rng.randrange(8)
        elif kind == 2:
            log[at:at + 4] = b"\xff" * 4
        elif kind == 3:
            del log[at:at + rng.randint(1, 40)]
        else:
            piece = log[at:at + rng.randint(1, 200)]
            to = rng.randrange(len(log))
            log[to:to] = piece
    return bytes(log)


def main():
    hoctomap, work, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    with gzip.open(f"{work}/a.rawlog") as log:
        plain = log.read()
    with open(f"{work}/a.rawlog", "rb") as log:
        compressed = log.read()
    # What stands before the first image is most of what a reader can be told wrong things about.
    head = plain.find(b"CObservation3DRangeScan") + 400
    rng = random.Random(int(sys.argv[4]))
    codes = collections.Counter()
    for i in range(count):
        if i % 4 == 0:
            log = mutated(compressed, rng)
        elif i % 4 == 1:
            log = mutated(plain, rng)
        else:
            log = mutated(plain[:head], rng) + plain[head:]
        with open(f"{work}/bad.rawlog", "wb") as out:
            out.write(log)
        shutil.rmtree(f"{work}/map", ignore_errors=True)
        run = subprocess.run([hoctomap, "build", "-q", "-i", f"{work}/bad.rawlog", "-o", f"{work}/map", "--monolithic"],
                             capture_output=True, timeout=60)
        codes[run.returncode] += 1
        errors = [line for line in run.stderr.splitlines() if line.startswith(b"hoctomap: ")]
        skipped = run.returncode == 3 and b"too many scans were skipped" in run.stderr
        if run.returncode not in (0, 3, 6) or (run.returncode != 0 and len(errors) != 1 and not skipped):
            shutil.copy(f"{work}/bad.rawlog", "finding.rawlog")
            sys.exit(f"finding.rawlog (round {i}): exit code {run.returncode}\n{run.stderr.decode(errors='replace')}")
    print(", ".join(f"{n} x exit code {code}" for code, n in sorted(codes.items())))


main()
