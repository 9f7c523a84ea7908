"""An installed jostle serves a project of its own; what that computes has the same bits as in Python."""

import os
import subprocess
from pathlib import Path

import numpy as np
from conftest import RODS

import jostle

PROJECT = Path(__file__).resolve().parents[1] / "outside_project"


def succeed(*command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=250)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def test_outside_project(tmp_path):
    succeed("cmake", "--install", os.environ["JOSTLE_BUILD"], "--prefix", tmp_path / "prefix")
    succeed("cmake", "-S", PROJECT, "-B", tmp_path / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}")
    succeed("cmake", "--build", tmp_path / "build")
    (tmp_path / "scene.toml").write_text(RODS)
    printed = [float(word) for word in succeed(tmp_path / "build/outside", tmp_path / "scene.toml").split()]
    box = jostle.body_moments("box", edges=[1, 2, 3])
    stress = jostle.pair_stress(box, box.at([1, 0.2, 0]), [0.5, 0.3, 0.1], [-0.5, 0.1, 0.1], [2, 1, 0])
    assert np.array_equal(printed[:9], stress.total.ravel())
    simulation = jostle.Simulation(jostle.Scene.from_toml(RODS))
    assert np.array_equal(printed[9:], simulation.step().collision_virial.ravel())
    assert (tmp_path / "prefix/bin/jostle").exists()
