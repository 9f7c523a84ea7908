"""Two dimensions in Python: scenes, simulations and analysis."""

import numpy as np
import pytest

import jostle
from jostle import analysis


def scene_of(count=60, length=2.0, **tables):
    return jostle.Scene(seed=4, box={"dimensions": 2, "area_fraction": 0.4}, rods={"count": count, "length": length},
                        time={"step": 0.01, "equilibration": 0.0, "production": 1.0}, **tables)


def test_a_scene_of_the_plane_has_vectors_of_two_numbers():
    scene = scene_of()
    assert scene.box.dimensions == 2 and scene.box.shape == (1.0, 1.0) and scene.box.periodic == (True, True)
    scene.box.shape = [1, 2]
    assert jostle.Scene.from_toml(scene.to_toml()) == scene
    with pytest.raises(jostle.InputError, match="two elements"):
        scene.box.shape = [1, 2, 3]
    space = jostle.Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 1}, time={"production": 1})
    space.box.dimensions = 2
    with pytest.raises(jostle.InputError, match="box.edges"):
        space.validate()


def test_a_simulation_of_the_plane():
    simulation = jostle.Simulation(scene_of())
    simulation.run(steps=50)
    assert simulation.dimensions == 2 and simulation.edges[2] == 0.0
    assert simulation.volume == pytest.approx(simulation.edges[0] * simulation.edges[1])
    rods = simulation.rods
    assert not rods.centre[:, 2].any() and not rods.axis[:, 2].any()
    stress = simulation.stress
    assert not stress[2].any() and not stress[:, 2].any()
    expected = -jostle.orientation_stress(rods, 1.0, simulation.volume, dimensions=2)
    assert np.trace(expected) == pytest.approx(0.0, abs=1e-12)
    assert simulation.stress_orientation == pytest.approx(-expected)
    with pytest.raises(jostle.InputError, match="2 or 3"):
        jostle.orientation_stress(rods, 1.0, 1.0, dimensions=4)


def test_analysis_counts_by_areas_and_angles_of_the_plane():
    random = np.random.default_rng(1)
    count, edge = 4000, 60.0
    angle = 2 * np.pi * random.random(count)
    centre = np.column_stack((edge * random.random((count, 2)), np.zeros(count)))
    ideal = {"centre": centre, "edges": [edge, edge, 0], "axis": np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))}
    found = analysis.pair_correlation(ideal, largest=10.0, bins=10)
    assert found.g == pytest.approx(1.0, abs=0.1) and found.g[1:] == pytest.approx(1.0, abs=0.05)
    assert np.abs(found.g2[1:]).max() < 0.05
    structure = analysis.structure_factor(ideal, largest=3.0)
    assert np.average(structure.S, weights=structure.vectors) == pytest.approx(1.0, abs=0.1)
    turning = {"centre": np.zeros((2, 1, 3)), "edges": [9, 9, 0], "axis": np.eye(3)[[0, 1]][:, None]}
    assert analysis.orientation_memory(turning).second == pytest.approx([-1.0])
    with pytest.raises(jostle.InputError, match="plane"):
        analysis.pair_correlation({**ideal, "centre": centre + [0, 0, 1]})
