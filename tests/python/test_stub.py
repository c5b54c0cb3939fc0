# SPDX-License-Identifier: BSD-3-Clause
"""The type stub and the module are in step."""
import ast
import inspect
from pathlib import Path

import hoctomap

OF_PYBIND = {"__init__", "__new__", "__doc__", "__module__", "__repr__", "__str__"}


def members_of_stub():
    tree = ast.parse(Path(hoctomap.__file__).with_name("__init__.pyi").read_text())
    names = {}
    for statement in tree.body:
        if isinstance(statement, ast.ClassDef):
            names[statement.name] = {m.name for m in statement.body if isinstance(m, ast.FunctionDef)} - OF_PYBIND
        elif isinstance(statement, ast.FunctionDef):
            names[statement.name] = None
        elif isinstance(statement, ast.AnnAssign):
            names[statement.target.id] = None
    return names


def test_stub_names_everything_and_nothing_else():
    stub = members_of_stub()
    assert set(stub) - {"__version__"} == set(hoctomap.__all__)
    for name, members in stub.items():
        if members is None or issubclass(getattr(hoctomap, name), Exception):
            continue
        cls = getattr(hoctomap, name)
        assert cls.__module__ == "hoctomap"
        actual = {m for m in vars(cls) if not m.startswith("_pybind") and not m.startswith("__pybind")} - OF_PYBIND
        assert actual == members, name


def test_everything_has_a_docstring():
    for name in hoctomap.__all__:
        thing = getattr(hoctomap, name)
        if inspect.isclass(thing) or callable(thing):
            assert thing.__doc__, name


def test_version_is_semantic():
    assert len([int(part) for part in hoctomap.__version__.split(".")]) == 3
