"""Scenes: everything that a user decides."""

import json
import os
from pathlib import Path

import numpy as np

from . import _jostle
from ._jostle import refuse

_TABLES = {}  # table name -> names of its keys, "" for those at the top


def _toml(key, value):
    """A Python value as TOML; whether it fits the key is for the reader of scenes to say."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_toml(key, element) for element in value) + "]"
    refuse(key, repr(value), f"is a {type(value).__name__}", "a number, a text, True or False, or three of them")


class Table:
    """A table of a scene; its keys are attributes, by their names in scene files."""

    def __init__(self, scene, name):
        object.__setattr__(self, "_scene", scene)
        object.__setattr__(self, "_name", name)

    def __getattr__(self, key):
        if key.startswith("__"):
            raise AttributeError(key)
        return self._scene._get(self._name, key)

    def __setattr__(self, key, value):
        self._scene._set(self._name, key, value)

    def __dir__(self):
        return _TABLES[self._name]

    def __repr__(self):
        values = ", ".join(f"{key}={getattr(self, key)!r}" for key in _TABLES[self._name])
        return f"{self._name}({values})"


class Scene:
    """Everything that a user decides about a simulation: the tables and keys of a scene file (docs/guide/scene.md).

    Made from keywords, one a table, or by `Scene.from_toml`. All rules of scene files hold: ranges, units ("2 um/s" in
    the micro system), keys that are missing or mean nothing here. Keys are attributes, as `scene.rods.length`; None
    stands for "auto" and for a key that is left out. What is set is looked at for its type at once, for its range and
    its sense beside the others by `validate`, which making a Simulation calls.

    Raises InputError with the text that `jostle check` prints.

    >>> scene = Scene(box={"volume_fraction": 0.2}, rods={"count": 400, "length": 5.0}, time={"production": 500.0})
    >>> scene.rods.length, scene.time.step, scene.motion.brownian
    (5.0, None, True)
    >>> scene.box.volume_fraction = 0.5
    >>> scene.validate()
    Traceback (most recent call last):
    jostle.InputError: box.volume_fraction = 0.5: is too dense for a random start with rods of L/D = 5 \
(allowed: a volume fraction of at most 0.45). Use start = "aligned" or "lattice", or a lower volume fraction
    """

    def __init__(self, **tables):
        lines = []
        for name in sorted(tables, key=lambda name: isinstance(tables[name], dict)):  # those at the top first
            if not isinstance(tables[name], dict):
                lines.append(f"{_key(name)} = {_toml(name, tables[name])}")
                continue
            lines.append(f"[{_key(name)}]")
            lines += [f"{_key(key)} = {_toml(f'{name}.{key}', value)}" for key, value in tables[name].items()
                      if value is not None]
        self._set_core(_jostle.Scene.parse("\n".join(lines) + "\n", ""))

    @classmethod
    def from_toml(cls, source):
        """A scene from a file, or from text.

        source : path, or str; a str with a line break in it is the scene itself, any other the name of a file.

        >>> Scene.from_toml('''
        ... [box]
        ... volume_fracton = 0.2
        ... [rods]
        ... count = 400
        ... length = 5.0
        ... [time]
        ... production = 50.0
        ... ''')
        Traceback (most recent call last):
        jostle.InputError: <text>:3:1: box.volume_fracton = 0.2: is an unknown key (allowed: "dimensions", "volume_fraction", "area_fraction", "shape", "edges", "periodic"). \
Did you mean "volume_fraction"?
        """
        if not isinstance(source, (str, os.PathLike)):
            refuse("source", repr(source), "is no scene", "the name of a file, or a text")
        if isinstance(source, str) and "\n" in source:
            return cls._of(_jostle.Scene.parse(source, "<text>"))
        if "\0" in os.fspath(source):
            refuse("source", repr(source), "holds a character 0", "the name of a file")
        return cls._of(_jostle.Scene.read(Path(source)))

    @classmethod
    def _of(cls, core):
        scene = cls.__new__(cls)
        scene._set_core(core)
        return scene

    def _set_core(self, core):
        object.__setattr__(self, "_core", core)

    def validate(self):
        """Raises InputError where a value is out of its range, or does not make sense beside the others."""
        self._core.validate()

    def to_toml(self):
        """The scene as a scene file, with every key that means something in it.

        >>> scene = Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 1}, time={"production": 1})
        >>> Scene.from_toml(scene.to_toml()) == scene
        True
        """
        return self._core.to_toml()

    def copy(self):
        """Another scene with the same values."""
        return Scene._of(self._core.copy())

    def _get(self, table, key):
        if key not in _TABLES[table]:
            raise AttributeError(_unknown(table, key))
        return self._core.get(f"{table}.{key}" if table else key)

    def _set(self, table, key, value):
        if key not in _TABLES[table]:
            raise AttributeError(_unknown(table, key))
        full = f"{table}.{key}" if table else key
        self._core.set(full, None if value is None else _toml(full, value))

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return Table(self, name) if name in _TABLES else self._get("", name)

    def __setattr__(self, name, value):
        if name in _TABLES:
            raise AttributeError(f"{name} is a table: set its keys, one by one")
        self._set("", name, value)

    def __dir__(self):
        return [*super().__dir__(), *_TABLES[""], *(name for name in _TABLES if name)]

    def __eq__(self, other):
        return self._core.same(other._core) if isinstance(other, Scene) else NotImplemented

    __hash__ = None

    def __copy__(self):
        return self.copy()

    def __deepcopy__(self, _):
        return self.copy()

    def __repr__(self):
        return f"<jostle.Scene\n{self.to_toml().rstrip()}\n>"


def _key(name):
    return name if name.replace("_", "").isalnum() and name.isascii() else json.dumps(name)


def _unknown(table, key):
    place = f"[{table}]" if table else "a scene"
    return f"{place} has no key {key!r}; it has {', '.join(_TABLES[table])}"


for _table, _name in _jostle.scene_keys():
    _TABLES.setdefault(_table, []).append(_name)
