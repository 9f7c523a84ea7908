"""What a sweep runs: keys, the values that each takes, and the points that they make together."""

import itertools
import json
import re
import tomllib
from dataclasses import dataclass

from refusal import Refusal

EXAMPLE = "Write --set box.volume_fraction=0.1,0.2"
RESERVED = ("replicas", "zip")  # of the table [sweep], beside keys
LONGEST_NAME = 150


@dataclass(frozen=True)
class Point:
    """One run of a sweep."""

    settings: tuple  # of (key, value as it is typed), the seed of a replica last
    name: str        # of its folder

    def words(self):
        """What `jostle run` takes."""
        return [word for key, value in self.settings for word in ("--set", f"{key}={value}")]

    def value(self, key):
        return dict(self.settings).get(key)

    def __str__(self):
        return ", ".join(f"{key} = {value}" for key, value in self.settings) or "the scene"


def parsed(value):
    """A typed value as a number, text, list or truth; what is no TOML is a text, as for `jostle run --set`."""
    try:
        return tomllib.loads(f"v = {value}")["v"]
    except (tomllib.TOMLDecodeError, KeyError):
        return value


def asked_for(settings, table):
    """{key: [values]} of the command line's KEY=V1,V2 and of the table [sweep]; a key of both is that of the command line."""
    keys = {key: [_toml(key, value) for value in _list(key, values)] for key, values in _flat(table) if key not in RESERVED}
    on_line = {}
    for text in settings:
        key, equals, values = (part.strip() for part in text.partition("="))
        if not equals or not key:
            raise Refusal(f"--set = {text}", "is not of the form KEY=VALUE,VALUE", EXAMPLE)
        if key in on_line:
            raise Refusal(f"--set {key}", "is given twice", "Give all values of a key together, with commas between")
        on_line[key] = split(values)
        if "" in on_line[key]:
            raise Refusal(f"--set {text}", "has an empty value", EXAMPLE)
    keys.update(on_line)
    for key, values in keys.items():
        seen = [json.dumps(parsed(value)) for value in values]
        again = next((value for number, value in enumerate(values) if seen[number] in seen[:number]), None)
        if again is not None:
            raise Refusal(f"--set {key}", f"has the value {again} twice", "Give --replicas to run a point several times")
    return keys


def points_of(keys, zipped, repeated=((),)):
    """Points in the order of the first key, then of the second, and so on. `repeated`: settings that each of them is run with in turn."""
    if zipped:
        longest = max((len(values) for values in keys.values()), default=1)
        for key, values in keys.items():
            if len(values) not in (1, longest):
                other = next(key for key, values in keys.items() if len(values) == longest)
                raise Refusal(f"--zip: {key}", f"has {len(values)} values and {other} has {longest}", "Give as many to each, or leave --zip out")
        combined = [[values[number % len(values)] for values in keys.values()] for number in range(longest)]
    else:
        combined = itertools.product(*keys.values())
    return named([(*zip(keys, values), *more) for values in combined for more in repeated])


def named(all_settings):
    """Points with a name each, of the keys that vary; of their last parts, unless these are the same."""
    keys = [key for key in dict(all_settings[0]) if len(all_settings) == 1 or len({dict(settings)[key] for settings in all_settings}) > 1]
    short = {key: key.rpartition(".")[2] for key in keys}
    if len(set(short.values())) < len(keys):
        short = {key: key for key in keys}
    names = ["_".join(f"{short[key]}={re.sub(r'[^A-Za-z0-9.+-]+', '-', value).strip('-')}" for key, value in settings if key in keys) or "run"
             for settings in all_settings]
    if len(set(names)) < len(names) or max(map(len, names)) > LONGEST_NAME:
        names = [f"point-{number}" for number in range(1, len(names) + 1)]
    return [Point(settings, name) for settings, name in zip(all_settings, names)]


def split(text):
    """The parts between commas that stand in no brackets and no quotes."""
    parts, depth, quote = [""], 0, ""
    for letter in text:
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'":
            quote = letter
        depth += (letter == "[") - (letter == "]") if not quote else 0
        if letter == "," and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def _flat(table, above=""):
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{above}{key}.")
        else:
            yield above + key, value


def _list(key, values):
    if not isinstance(values, list) or not values:
        raise Refusal(f"sweep.{key}", "is not a list of values", f"Write {key} = [1, 2] under [sweep]")
    return values


def _toml(key, value):
    if isinstance(value, list):
        return "[" + ", ".join(_toml(key, element) for element in value) + "]"
    if isinstance(value, (bool, int, float, str)):
        return json.dumps(value, ensure_ascii=False) if isinstance(value, (bool, str)) else repr(value)
    raise Refusal(f"sweep.{key}", f"has a {type(value).__name__} among its values", "Give numbers, texts, true or false, or lists of three")
