"""An installed jostle serves a project of its own; what that computes has the same bits as in Python."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import RODS

import jostle

ROOT = Path(__file__).resolve().parents[2]
PROJECT = ROOT / "tests" / "outside_project"


def succeed(*command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=250)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def block_of_the_guide(word):
    text = (ROOT / "docs" / "guide" / "extending.md").read_text()
    blocks = re.findall(r"^```cpp\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    return next(block for block in blocks if word in block)


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    folder = tmp_path_factory.mktemp("outside")
    (folder / "guide.cpp").write_text(block_of_the_guide("int main"))
    (folder / "constant_force.hpp").write_text(block_of_the_guide("class ConstantForce"))
    succeed("cmake", "--install", os.environ["JOSTLE_BUILD"], "--prefix", folder / "prefix")
    succeed("cmake", "-S", PROJECT, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}", f"-DGUIDE_PROGRAM={folder / 'guide.cpp'}")
    succeed("cmake", "--build", folder / "build")
    assert (folder / "prefix/bin/jostle").exists()
    return folder / "build"


def test_outside_project(build, tmp_path):
    (tmp_path / "scene.toml").write_text(RODS)
    printed = [float(word) for word in succeed(build / "outside", tmp_path / "scene.toml").split()]
    box = jostle.body_moments("box", edges=[1, 2, 3])
    stress = jostle.pair_stress(box, box.at([1, 0.2, 0]), [0.5, 0.3, 0.1], [-0.5, 0.1, 0.1], [2, 1, 0])
    assert np.array_equal(printed[:9], stress.total.ravel())
    simulation = jostle.Simulation(jostle.Scene.from_toml(RODS))
    assert np.array_equal(printed[9:], simulation.step().collision_virial.ravel())


def test_motion_of_the_guide(build):
    """Two spheres sediment as Stokes says."""
    printed = [float(word) for word in succeed(build / "sediment").split()]
    assert np.allclose(printed, [3 / (3 * np.pi)] * 2, rtol=1e-12)


def test_program_of_the_guide(build, tmp_path):
    """Z and its error bar are those of Python, to the last bit."""
    scene = jostle.Scene(box={"volume_fraction": 0.1}, rods={"count": 30, "length": 0.0},
                         time={"equilibration": 1.0, "production": 25.0})
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    words = succeed(build / "guide", tmp_path / "scene.toml").split()
    simulation = jostle.Simulation(scene)
    simulation.run()
    Z = simulation.summary()["Z"]
    assert words == ["Z", "=", words[2], "+-", words[4]]
    assert float(words[2]) == Z["mean"] and float(words[4]) == Z["standard_error"]
