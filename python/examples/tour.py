#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A tour of the Python package, to be read from top to bottom; each `# %%` is a cell for editors that know notebooks.

    tour.py [FOLDER]    writes tour.png and a map into FOLDER (default: out/tour)
"""
# %% A scene: a table top and two boxes on it, as a camera sees them that goes round the table
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import hoctomap

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out/tour")
folder.mkdir(parents=True, exist_ok=True)
camera = hoctomap.Camera(fx=260.0, fy=260.0, cx=159.5, cy=119.5)
room = ((-2.0, -2.0, 0.0), (2.0, 2.0, 2.6))
table = ((-0.6, -0.4, 0.68), (0.6, 0.4, 0.72))
boxes = [((-0.30, -0.10, 0.72), (-0.15, 0.05, 0.87)), ((0.15, -0.05, 0.72), (0.30, 0.15, 0.84))]


def pose_looking_at(target, eye):
    """world_T_sensor: x forward, y left, z up."""
    x = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
    y = np.cross((0, 0, 1), x) / np.linalg.norm(np.cross((0, 0, 1), x))
    pose = np.eye(4)
    pose[:3] = np.column_stack([x, y, np.cross(x, y), eye])
    return pose


def depth_image(pose, things):
    v, u = np.mgrid[:240, :320]
    beams = np.stack([np.ones(u.shape), (camera.cx - u) / camera.fx, (camera.cy - v) / camera.fy], -1)
    beams = beams @ pose[:3, :3].T
    depth = np.full(u.shape, np.inf)
    for inside, (low, high) in [(True, room), *((False, thing) for thing in things)]:
        a, b = ((np.array(corner) - pose[:3, 3]) / beams for corner in (low, high))
        near, far = np.minimum(a, b).max(-1), np.maximum(a, b).min(-1)
        depth = np.where((near <= far) & (far > 0), np.minimum(depth, far if inside else near), depth)
    return depth


def scans(things):
    for turn in np.linspace(-0.8, 0.8, 5):
        pose = pose_looking_at((0, 0, 0.75), (1.2 * np.sin(turn), -1.2 * np.cos(turn), 1.5))
        yield hoctomap.Measurement.from_depth(depth_image(pose, things), camera, pose)


# %% Map it, look at the tree, write it down
mapper = hoctomap.Mapper(hoctomap.Settings(overrides={"label.object.resolution": 0.005}))
for report in mapper.run(scans([table, *boxes])):
    print(f"scan {report.scan}:", ", ".join(f"{e.label} {e.node} {e.kind}" for e in report.events))
mapper.finish()
before = mapper.map
print(before)
mapper.save(folder / "map", overwrite=True)

# %% Ask it: a slice through the boxes, as states of a regular grid
query = hoctomap.Query(before)
x, y = np.meshgrid(np.arange(-0.8, 0.8, 0.005), np.arange(-0.6, 0.6, 0.005))
points = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 0.78)])
states, probabilities, nodes = query.points(points)

# %% What changes when one of the boxes is moved by 15 cm?
moved = [tuple(np.add(corner, (0.0, 0.15, 0.0))) for corner in boxes[0]]
later = hoctomap.Mapper(mapper.settings)
later.run(scans([table, moved, boxes[1]]))
later.finish()
changes = hoctomap.diff(before, later.map)
for change in changes:
    there = change.motion[:3, :3] @ change.position + change.motion[:3, 3]
    print(f"{change.label} {change.node_a} {change.kind} by {np.round(there - change.position, 3)} m")

# %% Own rules: what is high is a tower, what is not is an object
def by_height(measurement, segment):
    if segment.structure != "cluster":
        return {"plane": "table", "remainder": "background"}[segment.structure]
    height = np.ptp(measurement.points[segment.points, 2])
    return "tower" if height > 0.135 else "object"


named = hoctomap.Mapper(
    hoctomap.Settings(overrides={"label.tower.resolution": 0.005, "label.object.resolution": 0.005}),
    labeling=by_height,
    relations={"is under": lambda above, below: (above.label, below.label) in
               {("background", "table"), ("table", "object"), ("table", "tower")}},
)
named.run(scans([table, *boxes]))
named.finish()
print(named.map)

# %% Draw: voxels of every node by label, and the slice
figure = plt.figure(figsize=(11, 4.5))
scene = figure.add_subplot(121, projection="3d")
for node in before.with_label("table") + before.with_label("object"):
    scene.scatter(*node.world_voxels().T, s=1, label=f"{node.label} {node.id}")
scene.set_box_aspect((1.2, 0.8, 0.3))
scene.legend(loc="upper left")
slice_ = figure.add_subplot(122)
slice_.imshow(probabilities.reshape(x.shape), origin="lower", extent=(-0.8, 0.8, -0.6, 0.6), cmap="gray_r", vmin=0, vmax=1)
for change in changes:
    end = change.motion[:3, :3] @ change.position + change.motion[:3, 3]
    slice_.annotate("", end[:2], change.position[:2], arrowprops={"color": "red", "width": 2})
slice_.set(title="P(occupied) at z = 0.78 m; what was moved", xlabel="x [m]", ylabel="y [m]")
figure.tight_layout()
figure.savefig(folder / "tour.png", dpi=100)
print(folder / "tour.png")
