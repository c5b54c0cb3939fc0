# SPDX-License-Identifier: BSD-3-Clause
"""A small scene of numpy arrays: a table top with two boxes, seen by a depth camera from several places."""
import numpy as np
import pytest

import hoctomap

CAMERA = hoctomap.Camera(fx=260.0, fy=260.0, cx=159.5, cy=119.5)
SIZE = (240, 320)
TABLE = ((-0.6, -0.4, 0.68), (0.6, 0.4, 0.72))
BOXES = [((-0.30, -0.10, 0.72), (-0.15, 0.05, 0.87)), ((0.15, -0.05, 0.72), (0.30, 0.15, 0.84))]
ROOM = ((-2.5, -2.5, 0.0), (2.5, 2.5, 2.6))


def looking(eye, target=(0.0, 0.0, 0.75)):
    """The pose of a camera (x forward, y left, z up) at `eye` that looks at `target`."""
    forward = np.subtract(target, eye)
    forward /= np.linalg.norm(forward)
    left = np.cross((0.0, 0.0, 1.0), forward)
    left /= np.linalg.norm(left)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2] = forward, left, np.cross(forward, left)
    pose[:3, 3] = eye
    return pose


def depth_image(pose, boxes):
    """Depth along the optical axis of the nearest surface: the room from within, boxes from without."""
    v, u = np.mgrid[: SIZE[0], : SIZE[1]]
    beams = np.stack([np.ones(SIZE), (CAMERA.cx - u) / CAMERA.fx, (CAMERA.cy - v) / CAMERA.fy], axis=-1)
    beams = beams @ pose[:3, :3].T
    with np.errstate(divide="ignore"):
        inverse = 1.0 / beams

    def interval(box):
        a, b = ((np.array(corner) - pose[:3, 3]) * inverse for corner in box)
        return np.minimum(a, b).max(-1), np.maximum(a, b).min(-1)

    depth = interval(ROOM)[1]
    for box in boxes:
        near, far = interval(box)
        depth = np.where((near > 0) & (near <= far), np.minimum(depth, near), depth)
    return depth.astype(np.float32)


def measurements(boxes=BOXES, views=5):
    """One scan from each of `views` places round the table."""
    for turn in np.linspace(-0.8, 0.8, views):
        pose = looking((1.2 * np.sin(turn), -1.2 * np.cos(turn), 1.5))
        yield hoctomap.Measurement.from_depth(depth_image(pose, [TABLE, *boxes]), CAMERA, pose)


def mapped(boxes=BOXES):
    mapper = hoctomap.Mapper(hoctomap.Settings(overrides={"label.object.resolution": 0.005}))
    mapper.run(measurements(boxes))
    mapper.finish()
    return mapper


@pytest.fixture(scope="session")
def mapper():
    return mapped()


@pytest.fixture(scope="session")
def world(mapper):
    return mapper.map
