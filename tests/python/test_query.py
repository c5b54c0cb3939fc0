# SPDX-License-Identifier: BSD-3-Clause
import threading

import numpy as np
import pytest
from conftest import BOXES

import hoctomap


@pytest.fixture(scope="module")
def query(world):
    return hoctomap.Query(world)


def test_occupied_voxels_are_occupied_and_free_cells_free(world, query):
    for node in world.with_label("object"):
        states, probabilities, nodes = query.points(node.world_voxels())
        assert (states == hoctomap.OCCUPIED).mean() > 0.99
        assert (probabilities[states == hoctomap.OCCUPIED] > 0.5).all()
        assert (nodes == node.id).mean() > 0.99
    states, probabilities, nodes = query.points([[50.0, 0.0, 0.0]])
    assert states[0] == hoctomap.UNKNOWN and probabilities[0] == 0.5 and nodes[0] == -1


def test_points_are_asked_in_any_layout(query):
    points = np.random.default_rng(1).uniform(-1, 1, (1000, 3))
    expected = query.points(points)[0]
    assert (query.points(np.asfortranarray(points))[0] == expected).all()
    assert (query.points(np.repeat(points, 2, axis=0)[::2])[0] == expected).all()
    assert (query.points(points.tolist())[0] == expected).all()
    assert len(query.points(np.empty((0, 3)))[0]) == 0
    for wrong in (np.zeros(3), np.zeros((2, 2)), np.full((1, 3), np.nan)):
        with pytest.raises(ValueError):
            query.points(wrong)


def test_rays_from_above_meet_the_tops_of_the_boxes(world, query):
    origins = [[*np.add(low, high)[:2] / 2, 2.0] for low, high in BOXES]
    ends, distances, nodes = query.rays(origins, np.tile((0.0, 0.0, -2.0), (2, 1)), ignore_unknown=True)
    assert (ends == hoctomap.RAY_HIT).all()
    assert np.allclose(distances, [2.0 - high[2] for _, high in BOXES], atol=0.01)
    assert {world[int(n)].label for n in nodes} == {"object"}
    ends, distances, nodes = query.rays(origins, np.tile((0.0, 0.0, -1.0), (2, 1)), max_range=0.1, ignore_unknown=True)
    assert (ends == hoctomap.RAY_NOTHING).all() and (nodes == -1).all() and np.allclose(distances, 0.1)
    with pytest.raises(ValueError):
        query.rays(origins, np.zeros((2, 3)))


def test_nearest_collision_and_regions(world, query):
    low, high = BOXES[0]
    above = np.array([*np.add(low, high)[:2] / 2, high[2] + 0.2])
    distances, places, nodes = query.nearest([above])
    assert abs(distances[0] - 0.2) < 0.01
    assert np.linalg.norm(places[0] - above) == pytest.approx(distances[0])
    found = world[int(nodes[0])]
    to_centres = np.linalg.norm(found.world_voxels() - above, axis=1).min()
    assert to_centres - 0.87 * found.resolution < distances[0] < to_centres
    assert query.nearest([above], max_distance=0.05)[2][0] == -1
    gripper = hoctomap.Box(above, (0.03, 0.03, 0.03))
    assert query.collision(gripper) is None and query.collision(above, 0.1) is None
    assert query.collision(above, 0.25) == nodes[0]
    assert query.collision(hoctomap.Box(np.add(low, high) / 2, (0.1, 0.1, 0.1), np.eye(3))) == nodes[0]
    around = hoctomap.Box(np.add(low, high) / 2, (0.15, 0.15, 0.09))
    assert query.nodes_in(around)[int(nodes[0])] == pytest.approx(1.0)
    assert 0.0 <= query.unknown_share(around) < 1.0
    with pytest.raises(ValueError):
        hoctomap.Box((0, 0, 0), (1, -1, 1))


def test_nodes_that_hardly_exist_can_be_left_out(world):
    strict = hoctomap.Query(world, min_existence=0.999)
    assert (strict.points(world.with_label("object")[0].world_voxels())[0] != hoctomap.OCCUPIED).all()


def test_threads_ask_at_once(query):
    points = np.random.default_rng(2).uniform(-1, 1, (50000, 3))
    expected = query.points(points)
    answers = [None] * 4

    def ask(i):
        answers[i] = query.points(points)

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
    [t.start() for t in threads]
    [t.join() for t in threads]
    for answer in answers:
        assert all((a == b).all() for a, b in zip(answer, expected))
