"""Frames of a sheared box: neighbours across its faces, unwrapped places, and what is kept of it in files."""

import dataclasses

import numpy as np
import pytest

import jostle
import jostle.analysis
from jostle.neighbours import neighbours
from jostle.trajectory import Frame

SCENE = {"seed": 2, "box": {"edges": [8.0, 7.0, 6.0]}, "rods": {"count": 60, "length": 1.0}, "flow": {"shear_rate": 2.0, "start_strain": 0.4},
         "time": {"step": 0.004, "production": 1.0}}


def sheared_frame(count=80, offset=2.9):
    numbers = np.random.default_rng(3)
    edges = np.array([8.0, 5.0, 6.0])
    centre, axis = numbers.random((count, 3)) * edges, np.tile([1.0, 0.0, 0.0], (count, 1))
    return Frame(0, 0.0, edges, (True,) * 3, np.arange(count, dtype=np.uint64), centre, axis, np.zeros((count, 3), np.int32), np.zeros(count), np.ones(count),
                 offset)


@pytest.mark.parametrize("reach", [1.2, 3.9])
@pytest.mark.parametrize("offset", [2.9, -4.0, 0.0])
def test_neighbours_across_the_faces_are_those_of_brute_force(reach, offset):
    frame = sheared_frame(offset=offset)
    found = neighbours(frame, reach)
    expected = []
    vectors = np.array([[8.0, 0, 0], [offset, 5.0, 0], [0, 0, 6.0]])
    for image in np.ndindex(7, 5, 5):
        step = frame.centre[None] + (np.array(image) - [3, 2, 2]) @ vectors - frame.centre[:, None]
        i, j = np.nonzero(np.linalg.norm(step, axis=2) <= reach)
        expected += [(a, b, *step[a, b].round(6)) for a, b in zip(i, j) if a < b]
    assert sorted((a, b, *step.round(6)) for a, b, step in zip(found.i, found.j, found.step)) == sorted(expected)


def test_a_simulation_tells_its_offset_and_frames_keep_it(tmp_path):
    scene = jostle.Scene(**SCENE)
    for ending in (".h5", ".gsd"):
        if ending == ".gsd":
            pytest.importorskip("gsd")
        simulation = jostle.Simulation(scene)
        assert simulation.offset == pytest.approx(0.4 * 7.0)
        with simulation.record(tmp_path / f"rods{ending}", every=50):
            simulation.run(250)
        strain = 0.4 + 2.0 * 250 * 0.004
        assert simulation.offset == pytest.approx((strain * 7.0 + 4.0) % 8.0 - 4.0)
        frame = jostle.frames.frames_of(tmp_path / f"rods{ending}")[-1]
        now = simulation.rods
        assert frame.offset == pytest.approx(simulation.offset, abs=1e-5)
        copies = now.image @ np.array([[8.0, 0, 0], [simulation.offset, 7.0, 0], [0, 0, 6.0]])
        assert np.allclose(frame.unwrapped, (now.centre + copies)[np.argsort(now.id)], atol=1e-4)


def test_wave_vectors_of_a_sheared_box_are_refused():
    with pytest.raises(jostle.InputError, match="sheared"):
        jostle.analysis.structure_factor(sheared_frame())
    assert jostle.analysis.structure_factor(dataclasses.replace(sheared_frame(), offset=0.0)).S.size > 0
