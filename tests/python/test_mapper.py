# SPDX-License-Identifier: BSD-3-Clause
import gc
import threading

import numpy as np
import pytest
from conftest import BOXES, CAMERA, SIZE, depth_image, looking, mapped, measurements

import hoctomap

SHELF = {"label.shelf.resolution": 0.02}


def shelf_cloud():
    """A shelf and two things in it, seen from the origin along x."""
    rng = np.random.default_rng(0)
    shelf = rng.uniform((1.9, -0.7, -0.3), (2.1, 0.7, 0.3), (4000, 3))
    things = [rng.uniform((1.95, y - 0.05, -0.1), (2.05, y + 0.05, 0.1), (2000, 3)) for y in (-0.3, 0.3)]
    shelf = shelf[(np.abs(np.abs(shelf[:, 1]) - 0.3) > 0.1)]
    return np.concatenate([shelf, *things])


def halves(z):
    inside = np.abs(np.abs(z.points[:, 1]) - 0.3) < 0.07
    left = z.points[:, 1] > 0
    yield hoctomap.Segment("plane", np.flatnonzero(~inside), plane=(-1, 0, 0, 2))
    yield hoctomap.Segment("cluster", np.flatnonzero(inside & left))
    yield hoctomap.Segment("cluster", np.flatnonzero(inside & ~left))


def test_strategies_of_python_make_the_map():
    seen = []

    def label(z, segment):
        seen.append((len(segment), segment.structure, segment.plane))
        return "shelf" if segment.structure == "plane" else "object"

    mapper = hoctomap.Mapper(
        hoctomap.Settings(overrides={**SHELF, "mapping.confirm_scans": 1}),
        segmentation=halves,
        labeling=label,
        relations={"contains": lambda above, below: above.label == "shelf" and above.box.contains(below.box.center)},
    )
    report = mapper.integrate(hoctomap.Measurement.from_points(shelf_cloud(), np.eye(4)))
    assert sum(n for n, _, _ in seen) == len(shelf_cloud())
    assert seen[0][2] == (-1.0, 0.0, 0.0, 2.0)
    (shelf,) = mapper.map.with_label("shelf")
    things = mapper.map.with_label("object")
    assert len(things) == 2 and all(t.parent == shelf.id for t in things)
    assert sorted(e.label for e in report.events if e.kind == "created") == ["object", "object", "shelf"]


@pytest.mark.parametrize(
    "segments, message",
    [
        (lambda z: [hoctomap.Segment("cluster", [0])], "leave out"),
        (lambda z: [hoctomap.Segment("cluster", [0, 0])], "share"),
        (lambda z: [hoctomap.Segment("cluster", [10**6])], "has not"),
        (lambda z: 1 / 0, "division"),
        (lambda z: [1], ""),
    ],
)
def test_what_a_strategy_does_wrong_is_raised_and_the_map_is_whole(segments, message):
    wrong = [True]
    mapper = hoctomap.Mapper(segmentation=lambda z: segments(z) if wrong[0] else halves(z))
    z = hoctomap.Measurement.from_points(shelf_cloud(), np.eye(4))
    with pytest.raises((ValueError, ZeroDivisionError, RuntimeError, TypeError), match=message):
        mapper.integrate(z)
    assert len(mapper.map) == 1
    wrong[0] = False
    mapper.integrate(hoctomap.Measurement.from_points(shelf_cloud(), np.eye(4)))


def test_errors_of_relations_and_of_iterators_come_out():
    def holds(above, below):
        raise LookupError("no idea")

    mapper = hoctomap.Mapper(relations={"r": holds})
    with pytest.raises(LookupError, match="no idea"):
        mapper.run(measurements(views=2))
    with pytest.raises(RuntimeError, match="not whole"):
        mapper.map

    def broken():
        yield from measurements(views=1)
        raise OSError("unplugged")

    mapper = hoctomap.Mapper()
    with pytest.raises(OSError, match="unplugged"):
        mapper.run(broken())
    assert mapper.map.scans == 1
    with pytest.raises((TypeError, RuntimeError)):
        mapper.run([1, 2])


def test_one_by_one_is_the_same_as_all_at_once(world):
    mapper = hoctomap.Mapper(hoctomap.Settings(overrides={"label.object.resolution": 0.005}))
    reports = [mapper.integrate(z) for z in measurements()]
    mapper.finish()
    assert [r.scan for r in reports] == [0, 1, 2, 3, 4] and reports[0].points == SIZE[0] * SIZE[1]
    assert set(reports[0].seconds) == {"segment", "associate", "update", "existence"}
    assert len(mapper.map) == len(world)
    for a, b in zip(mapper.map, world):
        assert a.id == b.id and (a.voxels == b.voxels).all() and a.existence == b.existence


def test_the_map_does_not_change_when_the_mapper_goes_on():
    scans = list(measurements())
    mapper = hoctomap.Mapper()
    mapper.run(scans[:3])
    early = mapper.map
    assert mapper.map is early
    voxels, count = early.root.voxels, len(early.root.voxels)
    kept = voxels.copy()
    mapper.run(scans[3:])
    assert mapper.map is not early
    del mapper
    gc.collect()
    assert (voxels == kept).all() and len(early.root.voxels) == count and early.scans == 3


def test_a_node_is_moved_with_what_stands_on_it(mapper):
    mapper = mapped()
    before = mapper.map
    (table,) = before.with_label("table")
    shift = np.eye(4)
    shift[:3, 3] = table.world_T_node[:3, :3].T @ (1.0, 0.0, 0.0)
    with pytest.raises(RuntimeError):
        mapper.move(table.id, shift)  # it has finished
    mapper = hoctomap.Mapper()
    mapper.run(measurements(views=3))
    (table,) = mapper.map.with_label("table")
    before = mapper.map
    assert [e.kind for e in mapper.move(table.id, shift).events] == ["moved"]
    for node in before.nodes[1:]:
        assert np.allclose(mapper.map[node.id].box.center - node.box.center, (1, 0, 0), atol=1e-9)


def test_measurements_hold_views_and_check_their_input():
    pose = looking((0.0, -1.2, 1.5))
    depth = depth_image(pose, BOXES)
    depth[:10] = 0.0
    z = hoctomap.Measurement.from_depth(depth, CAMERA, pose, scan=7, stamp=2.5, sensor="cam")
    assert (z.scan, z.stamp, z.sensor) == (7, 2.5, "cam")
    assert len(z) == (depth > 0).sum() == len(z.pixel_of_point)
    assert (z.depth == depth).all() and z.depth.ctypes.data == z.depth.ctypes.data
    assert (depth.ravel()[z.pixel_of_point] > 0).all()
    forward = (z.points - z.origin) @ pose[:3, 0]
    assert np.allclose(forward, depth.ravel()[z.pixel_of_point], atol=1e-4)
    points = z.points
    del z
    gc.collect()
    assert np.isfinite(points).all()

    cloud = np.array([[1, 0, 0], [np.nan, 0, 0], [0, 0, 0], [0.1, 0, 0]])
    z = hoctomap.Measurement.from_points(cloud, np.eye(4), min_range=0.5)
    assert len(z) == 1 and z.depth is None and len(z.pixel_of_point) == 0
    for wrong in (np.zeros((3, 2)), np.zeros(3)):
        with pytest.raises(ValueError):
            hoctomap.Measurement.from_points(wrong, np.eye(4))
    with pytest.raises(ValueError):
        hoctomap.Measurement.from_points(cloud, np.ones((4, 4)))
    with pytest.raises(ValueError):
        hoctomap.Camera(0, 1, 2, 3)


def test_scans_ascend():
    mapper = hoctomap.Mapper()
    z = next(measurements())
    mapper.integrate(z)
    with pytest.raises(ValueError, match="too late"):
        mapper.integrate(z)


def test_other_threads_run_while_the_mapper_works_and_it_serves_one_at_a_time():
    mapper, refused, counted = hoctomap.Mapper(), [], [0]
    done = threading.Event()

    def intrude():
        while not done.is_set():
            counted[0] += 1
            try:
                mapper.map
            except RuntimeError as e:
                refused.append(str(e))
            done.wait(0.001)

    thread = threading.Thread(target=intrude)
    try:
        thread.start()
        for z in measurements(views=3):
            while True:
                try:
                    mapper.integrate(z)
                    break
                except RuntimeError:  # the other thread has it
                    pass
    finally:
        done.set()
        thread.join()
    assert refused and "at work" in refused[0]
    assert mapper.map.scans == 3
