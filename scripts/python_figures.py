#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the Python package costs over C++, as a table in Markdown: seconds of user time, the least of several runs of each
in turn, each in a process of its own.

    cmake --preset benchmark
    cmake --build --preset benchmark --target hoctomap_python hoctomap-python-baseline
    python3 scripts/python_figures.py [BUILD_FOLDER]        (default: build/benchmark)
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build" / "benchmark"
BASELINE = BUILD / "tests" / "benchmarks" / "hoctomap-python-baseline"
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(BUILD / "python")}
MIMALLOC = "libmimalloc.so.2"
RUNS = 7
SCANS = 12

POINTS = """
import resource, sys, numpy as np, hoctomap
query = hoctomap.Query(hoctomap.load(sys.argv[1]))
points = np.fromfile(sys.argv[2]).reshape(-1, 3)
start = resource.getrusage(resource.RUSAGE_SELF).ru_utime
query.points(points)
print(resource.getrusage(resource.RUSAGE_SELF).ru_utime - start)
"""
MAPPING = """
import pathlib, resource, sys, numpy as np, hoctomap
folder = pathlib.Path(sys.argv[1])
count = len(list(folder.glob("*.depth")))
depths = [np.fromfile(folder / f"{k}.depth", dtype=np.float32).reshape(480, 640) for k in range(count)]
poses = [np.fromfile(folder / f"{k}.pose").reshape(4, 4) for k in range(count)]
camera = hoctomap.Camera(520.0, 520.0, 319.5, 239.5)
start = resource.getrusage(resource.RUSAGE_SELF).ru_utime
mapper = hoctomap.Mapper()
for depth, pose in zip(depths, poses):
    mapper.integrate(hoctomap.Measurement.from_depth(depth, camera, pose))
mapper.finish()
print(resource.getrusage(resource.RUSAGE_SELF).ru_utime - start)
if len(sys.argv) > 2:
    mapper.save(sys.argv[2])
"""


def seconds(command, preload=None):
    environment = {**ENVIRONMENT, **({"LD_PRELOAD": preload} if preload else {})}
    return float(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout)


def compare(name, python, cpp, preload=None):
    pairs = [(seconds(python, preload), seconds(cpp, preload)) for _ in range(RUNS)]
    ours, theirs = (min(times) for times in zip(*pairs))
    print(f"| {name} | {theirs:.3f} | {ours:.3f} | {ours / theirs:.2f} |", flush=True)


def write_scans(folder):
    """A table with six boxes, in a room, as a camera of 640 x 480 sees it on its way round, with the noise of a Kinect."""
    sys.path.insert(0, str(BUILD / "python"))
    sys.path.insert(0, str(ROOT / "tests" / "python"))
    import conftest
    import numpy as np

    random = np.random.default_rng(0)
    conftest.CAMERA = conftest.hoctomap.Camera(520.0, 520.0, 319.5, 239.5)
    conftest.SIZE = (480, 640)
    corners = [(-0.5 + 0.35 * i, -0.3 + 0.35 * j, 0.72) for i in range(3) for j in range(2)]
    boxes = [(c, tuple(np.add(c, (0.1, 0.15, 0.08 + 0.02 * k)))) for k, c in enumerate(corners)]
    for k, turn in enumerate(np.linspace(-1.0, 1.0, SCANS)):
        pose = conftest.looking((1.3 * np.sin(turn), -1.3 * np.cos(turn), 1.5))
        depth = conftest.depth_image(pose, [conftest.TABLE, *boxes])
        depth = depth + 0.0015 * depth**2 * random.standard_normal(depth.shape)
        (np.round(1000 * depth) / 1000).astype(np.float32).tofile(folder / f"{k}.depth")
        pose.tofile(folder / f"{k}.pose")
    low, high = np.array([(-1.5, -1.5, 0.0), (1.5, 1.5, 1.5)])
    random.uniform(low, high, (3_000_000, 3)).tofile(folder / "points")


with tempfile.TemporaryDirectory() as name:
    scans = Path(name)
    write_scans(scans)
    saved = scans / "map"
    subprocess.run([sys.executable, "-c", MAPPING, scans, saved], env=ENVIRONMENT, check=True, capture_output=True)
    python_points = [sys.executable, "-c", POINTS, saved, scans / "points"]
    python_mapping = [sys.executable, "-c", MAPPING, scans]
    print("| | C++ [s] | Python [s] | ratio |\n|---|---:|---:|---:|")
    compare("3 million point queries", python_points, [BASELINE, "points", saved, scans / "points"])
    compare(f"mapping {SCANS} depth images of 640 x 480", python_mapping, [BASELINE, "mapping", scans])
    compare("the same, both with mimalloc preloaded", python_mapping, [BASELINE, "mapping", scans], MIMALLOC)
