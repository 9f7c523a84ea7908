import os
import subprocess

import pytest

import jostle

# Touch often; rows of the series, and the checkpoint, out of step with each other.
RODS = """
seed = 7
[box]
volume_fraction = 0.25
[rods]
count = 50
length = 2.0
[time]
step = 0.02
equilibration = 0.0
production = 2.0
[output]
series_every = 5
trajectory_every = 12
checkpoint_every = 32
contacts = true
"""
# Grow, divide and die; end in fewer than the ids that were given.
CELLS = """
seed = 5
[box]
edges = [12.0, 12.0, 12.0]
[rods]
count = 12
length = 2.0
[growth]
rate = 1.0
division_length = 3.0
division_deviation = 0.1
death_rate = 0.2
[motion]
self_propulsion = 1.0
[time]
step = 0.01
production = 6.0
[output]
contacts = true
trajectory_every = 100
"""


@pytest.fixture
def rods():
    return jostle.Scene.from_toml(RODS)


@pytest.fixture
def cells():
    return jostle.Scene.from_toml(CELLS)


def command(folder, *arguments):
    """Runs `jostle ARGUMENTS` in the folder."""
    return subprocess.run([os.environ["JOSTLE"], *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                          timeout=60)


def succeed(*command, **surroundings):
    """What the command prints, which must end well."""
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=250, **surroundings)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def finished_run(folder, text):
    (folder / "scene.toml").write_text(text)
    result = command(folder, "run", "scene.toml", "--out", "run", "--threads", "1", "--quiet")
    assert result.returncode == 0, result.stderr
    return folder / "run"


@pytest.fixture(scope="session")
def run_of_rods(tmp_path_factory):
    return finished_run(tmp_path_factory.mktemp("rods"), RODS)


@pytest.fixture(scope="session")
def run_of_cells(tmp_path_factory):
    return finished_run(tmp_path_factory.mktemp("cells"), CELLS)
