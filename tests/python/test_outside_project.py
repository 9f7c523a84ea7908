"""An installed jostle serves a project of its own, by its public headers alone; what that computes has the same bits as in Python."""

import os
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from conftest import RODS, succeed

import jostle

ROOT = Path(__file__).resolve().parents[2]
PROJECT = ROOT / "tests" / "outside_project"


def block_of_the_guide(word):
    text = (ROOT / "docs" / "guide" / "extending.md").read_text()
    blocks = re.findall(r"^```cpp\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    return next(block for block in blocks if word in block)


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    folder = tmp_path_factory.mktemp("outside")
    (folder / "guide.cpp").write_text(block_of_the_guide("int main"))
    (folder / "constant_force.hpp").write_text(block_of_the_guide("class ConstantForce"))
    (folder / "mean_square_along_x.hpp").write_text(block_of_the_guide("mean_square_along_x"))
    (folder / "free_draining.hpp").write_text(block_of_the_guide("free_draining()"))
    succeed("cmake", "--install", os.environ["JOSTLE_BUILD"], "--prefix", folder / "prefix")
    succeed("cmake", "-S", PROJECT, "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}", f"-DGUIDE_PROGRAM={folder / 'guide.cpp'}")
    succeed("cmake", "--build", folder / "build")
    assert (folder / "prefix/bin/jostle").exists()
    return folder / "build"


def public_headers():
    return re.findall(r"^\| \[(jostle/\S+\.hpp)\]", (ROOT / "docs/guide/headers.md").read_text(), re.MULTILINE)


def included(text):
    return set(re.findall(r'^#include "(jostle/[^"]+)"', text, re.MULTILINE))


def test_the_page_lists_the_public_headers(build):
    """Installed are those of the page and, apart, what they include; the page names each once, and where it lies."""
    listed, include = public_headers(), build.parent / "prefix/include"
    private = {str(path.relative_to(include / "jostle/private")) for path in (include / "jostle/private").rglob("*.hpp")}
    installed = {str(path.relative_to(include)) for path in include.rglob("*.hpp")} - {f"jostle/private/{name}" for name in private}
    assert installed == set(listed) and len(listed) == len(installed)
    sources = {name: (ROOT / "src" / name).read_text() for name in installed | private}
    assert private == set().union(*map(included, sources.values())) - installed
    page = (ROOT / "docs/guide/headers.md").read_text()
    assert all(f"| [{name}](../../src/{name}) | " in page for name in listed)


def test_each_public_header_alone(build, tmp_path):
    """Each can be included first, where nothing but the install is to be seen."""
    include = build.parent / "prefix/include"

    def compiled(header):
        program = tmp_path / (header.replace("/", "_") + ".cpp")
        program.write_text(f'#include "{header}"\nint main() {{}}\n')
        return subprocess.run(["c++", "-std=c++20", "-fopenmp", "-fsyntax-only", "-Wall", "-Werror", f"-I{include}", f"-I{include}/jostle/private", program],
                              capture_output=True, text=True, timeout=100).stderr

    with ThreadPoolExecutor(os.cpu_count()) as side_by_side:
        assert [errors for errors in side_by_side.map(compiled, public_headers()) if errors] == []


def test_programs_outside_include_public_headers_only():
    programs = [*PROJECT.glob("*.cpp"), *(ROOT / "docs").rglob("*.md")]
    used = set().union(*(included(path.read_text()) for path in programs))
    assert len(used) > 5 and used <= set(public_headers())


def test_outside_project(build, tmp_path):
    (tmp_path / "scene.toml").write_text(RODS)
    printed = [float(word) for word in succeed(build / "outside", tmp_path / "scene.toml").split()]
    box = jostle.body_moments("box", edges=[1, 2, 3])
    stress = jostle.pair_stress(box, box.at([1, 0.2, 0]), [0.5, 0.3, 0.1], [-0.5, 0.1, 0.1], [2, 1, 0])
    assert np.array_equal(printed[:9], stress.total.ravel())
    simulation = jostle.Simulation(jostle.Scene.from_toml(RODS))
    assert np.array_equal(printed[9:], simulation.step().collision_virial.ravel())


def test_motion_and_mobility_of_the_guide(build):
    """A sphere sediments as Stokes says; where the fluid flows through rods freely, a rod twice as long has twice the friction."""
    sphere, rod, free_sphere, free_rod = [float(word) for word in succeed(build / "sediment").split()]
    assert np.allclose([sphere, free_sphere, free_rod], np.array([1, 1, 0.5]) / np.pi, rtol=1e-12)
    assert 0.5 / np.pi < rod < 1 / np.pi


def test_observable_of_the_guide(build, tmp_path):
    """It is what Python finds from the axes, step by step; and so is its mean."""
    (tmp_path / "scene.toml").write_text(RODS)
    printed = [float(word) for word in succeed(build / "observable", tmp_path / "scene.toml").split()]
    simulation = jostle.Simulation(jostle.Scene.from_toml(RODS))
    expected = []
    for _ in range(50):
        simulation.step()
        expected.append((simulation.rods.axis[:, 0] ** 2).mean())
    assert np.allclose(printed, [*expected, np.mean(expected)], rtol=1e-12)
    assert np.ptp(expected) > 0


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
