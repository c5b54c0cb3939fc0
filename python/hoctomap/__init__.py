# SPDX-License-Identifier: BSD-3-Clause
"""Hierarchies of octree maps: load, inspect and ask them, compare them, and build them from numpy arrays.

Poses are (4, 4) matrices named a_T_b, which take coordinates in frame b to frame a. Metres everywhere.

    import hoctomap
    world = hoctomap.load("out/map")
    states, probabilities, nodes = hoctomap.Query(world).points(xyz)
"""

from ._core import (
    FREE,
    OCCUPIED,
    RAY_HIT,
    RAY_NOTHING,
    RAY_UNKNOWN,
    UNKNOWN,
    Box,
    Camera,
    Change,
    ConfigError,
    Error,
    Event,
    FileError,
    InputError,
    LimitError,
    Map,
    MapError,
    Mapper,
    Measurement,
    Node,
    NodeView,
    Query,
    Report,
    Segment,
    Settings,
    __version__,
    diff,
    load,
)

__all__ = [name for name in dir() if not name.startswith("_")]
