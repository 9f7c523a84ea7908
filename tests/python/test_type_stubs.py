"""The type stubs name what is there, and nothing else: names, parameters, fields of classes."""

import ast
import dataclasses
import importlib
import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest

import jostle
from jostle import analysis

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(jostle.__file__).parent


def tree(module):
    return ast.parse((FOLDER / f"{module}.pyi").read_text())


def public(names):
    return {name for name in names if not name.startswith("_")}


def parameters_of_stub(function):
    arguments = function.args
    plain = [*arguments.posonlyargs, *arguments.args]
    optional = len(arguments.defaults)
    found = [(argument.arg, "plain", k >= len(plain) - optional) for k, argument in enumerate(plain)]
    found += [(argument.arg, "keyword", default is not None) for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return found + [(one.arg, word, False) for one, word in ((arguments.vararg, "args"), (arguments.kwarg, "kwargs")) if one]


def parameters_of(function):
    words = {inspect.Parameter.KEYWORD_ONLY: "keyword", inspect.Parameter.VAR_POSITIONAL: "args", inspect.Parameter.VAR_KEYWORD: "kwargs"}
    found = [(name, words.get(parameter.kind, "plain"), parameter.default is not inspect.Parameter.empty)
             for name, parameter in inspect.signature(function).parameters.items()]
    return sorted(found, key=lambda one: ("plain", "keyword", "args", "kwargs").index(one[1]))


def members_of(found):
    """What a class offers, but for attributes that only its instances have."""
    names = {name for base in found.__mro__ if base.__module__.startswith("jostle") for name in vars(base)}
    return public(names) | ({field.name for field in dataclasses.fields(found)} if dataclasses.is_dataclass(found) else set())


CLASSES = [(module, node) for module in ("__init__", "analysis") for node in tree(module).body if isinstance(node, ast.ClassDef) and node.name[0] != "_"]
FUNCTIONS = [(module, node) for module in ("__init__", "analysis") for node in tree(module).body if isinstance(node, ast.FunctionDef)]
ONLY_IN_INSTANCES = {"StepFailure": {"report"}, "Recording": {"path", "journal"}, "Run": {"folder"},
                     "Scene": {table for table, _ in jostle._jostle.scene_keys() if table}}


def here(module):
    return importlib.import_module("jostle" if module == "__init__" else f"jostle.{module}")


@pytest.mark.parametrize("module", ["__init__", "analysis"])
def test_names_are_those_that_are_offered(module):
    said = {node.name for node in tree(module).body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    said |= {alias.asname for node in tree(module).body if isinstance(node, ast.ImportFrom) for alias in node.names if alias.asname}
    assert public(said) == set(here(module).__all__)


@pytest.mark.parametrize("module, node", FUNCTIONS, ids=lambda one: getattr(one, "name", one))
def test_parameters_of_functions(module, node):
    assert parameters_of_stub(node) == parameters_of(getattr(here(module), node.name))


@pytest.mark.parametrize("module, node", CLASSES, ids=lambda one: getattr(one, "name", one))
def test_members_of_classes(module, node):
    found = getattr(here(module), node.name)
    methods = {part.name: part for part in node.body if isinstance(part, ast.FunctionDef)}
    fields = [part.target.id for part in node.body if isinstance(part, ast.AnnAssign)]
    assert public({*methods, *fields}) == members_of(found) | ONLY_IN_INSTANCES.get(node.name, set())
    if dataclasses.is_dataclass(found):
        assert fields == [field.name for field in dataclasses.fields(found)]
    for name, method in methods.items():
        there = inspect.getattr_static(found, name)
        is_property = any(isinstance(word, ast.Name) and word.id == "property" for word in method.decorator_list)
        assert is_property == (not callable(there) and not isinstance(there, classmethod)), name
        if not is_property:
            assert parameters_of_stub(method) == parameters_of(there.__func__ if isinstance(there, classmethod) else there), name


def test_extension():
    """Its stub is what it says of itself."""
    done = subprocess.run([sys.executable, ROOT / "tools" / "make_type_stubs", "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_marker_is_there():
    """Without py.typed type checkers look at no stub; the pip package takes both along."""
    assert (FOLDER / "py.typed").exists() and analysis.__all__
    import tomllib
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
    assert set(tool["package-data"]["jostle"]) == {"py.typed", "*.pyi"} and os.path.exists(FOLDER / "_jostle.pyi")
