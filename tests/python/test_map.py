# SPDX-License-Identifier: BSD-3-Clause
import gc

import numpy as np
import pytest
from conftest import BOXES, mapped

import hoctomap


def test_the_scene_is_a_tree_of_what_stands_on_what(world):
    assert world.root.label == "background" and world.root.parent is None
    (table,) = world.with_label("table")
    objects = world.with_label("object")
    assert len(objects) == 2 and len(world) == 4 == len(list(world))
    assert all(o.parent == table.id for o in objects)
    assert table.children == sorted(o.id for o in objects) and table.parent == 0
    assert [n.depth for n in world.nodes] == [0, 1, 2, 2]
    assert objects[0].resolution == 0.005 and 0.5 < objects[0].existence < 1.0
    assert table.id in world and 99 not in world
    with pytest.raises(KeyError):
        world[99]
    assert str(world).count("\n") == 4


def test_objects_are_where_the_boxes_are(world):
    for low, high in BOXES:
        middle = np.add(low, high) / 2
        (node,) = [n for n in world.with_label("object") if np.abs(n.box.center - middle).max() < 0.05]
        inside = (node.world_voxels() > np.array(low) - 0.01) & (node.world_voxels() < np.array(high) + 0.01)
        assert inside.all()
        assert node.box.contains(node.box.center) and node.box.intersects(node.box)


def test_voxels_are_views_that_keep_the_map_alive():
    world = mapped().map
    node = world.with_label("object")[0]
    view = node.voxels
    assert view.dtype == np.float32 and view.shape == (node.occupied_voxels, 3)
    assert view.ctypes.data == node.voxels.ctypes.data, "a copy"
    with pytest.raises(ValueError):
        view[0, 0] = 1.0
    kept = view.copy()
    pose, moved = node.world_T_node, node.world_voxels()
    del world, node
    gc.collect()
    assert (view == kept).all()
    assert np.allclose(view @ pose[:3, :3].T + pose[:3, 3], moved, atol=1e-5)


def test_cells_are_the_octree(world):
    node = world.with_label("object")[0]
    centres, edges, probabilities = node.cells()
    volume = (edges.astype(float) / node.resolution) ** 3
    assert round(volume[probabilities >= 0.5].sum()) == node.occupied_voxels
    assert round(volume[probabilities < 0.5].sum()) == node.free_voxels
    occupied = {tuple(c) for c in np.round(centres[(probabilities >= 0.5) & (volume < 1.5)], 5)}
    assert occupied <= {tuple(c) for c in np.round(node.voxels, 5)}


def test_poses_compose(world):
    for node in world:
        if node.parent is not None:
            expected = world[node.parent].world_T_node @ node.parent_T_node
            assert np.allclose(expected, node.world_T_node)


def test_a_saved_map_is_loaded_as_it_was(mapper, world, tmp_path):
    mapper.save(tmp_path / "map")
    stored = hoctomap.load(tmp_path / "map")
    assert stored.scans == world.scans == 5
    assert [(n.id, n.label, n.parent, n.existence) for n in stored] == [
        (n.id, n.label, n.parent, n.existence) for n in world
    ]
    for a, b in zip(stored, world):
        assert (a.voxels == b.voxels).all() and np.allclose(a.world_T_node, b.world_T_node, atol=1e-12)
    with pytest.raises(hoctomap.ConfigError):
        mapper.save(tmp_path / "map")
    mapper.save(tmp_path / "map", overwrite=True)


def test_errors_are_pythons_too(tmp_path):
    with pytest.raises(hoctomap.MapError) as raised:
        hoctomap.load(tmp_path / "nothing")
    assert isinstance(raised.value, ValueError) and isinstance(raised.value, hoctomap.Error)
    with pytest.raises(hoctomap.ConfigError, match="no_such_key"):
        hoctomap.Settings(overrides={"label.object.no_such_key": 1})
    assert issubclass(hoctomap.FileError, OSError) and issubclass(hoctomap.LimitError, RuntimeError)
    (tmp_path / "map").mkdir()
    (tmp_path / "map" / "hierarchy.yaml").write_text("nodes: [")
    with pytest.raises(hoctomap.MapError, match="hierarchy.yaml"):
        hoctomap.load(tmp_path / "map")
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        mapped_into_a_file(tmp_path / "file" / "map")


def mapped_into_a_file(path):
    hoctomap.Mapper().save(path)


def test_diff_finds_what_was_moved_and_what_was_taken(world):
    assert hoctomap.diff(world, world) == []
    low, high = BOXES[0]
    shifted = [tuple(np.add(corner, (0.0, 0.15, 0.0))) for corner in (low, high)]
    (moved,) = hoctomap.diff(world, mapped([shifted, BOXES[1]]).map)
    assert moved.kind == "moved" and moved.label == "object"
    assert np.allclose(moved.motion[:3, :3] @ moved.position + moved.motion[:3, 3] - moved.position, (0, 0.15, 0), atol=0.01)
    (taken,) = hoctomap.diff(world, mapped([BOXES[1]]).map)
    assert taken.kind == "removed" and taken.node_b is None and world[taken.node_a].label == "object"
