"""jostle.analysis against what is known in closed form. A tolerance is five standard errors of the sample, which a right program exceeds
once in 1.7 million numbers; seeds are fixed."""

import numpy as np
import pytest

import jostle
from conftest import command
from jostle import analysis

WIDE = 5.0


def agree(found, error, expected):
    assert (error > 0).all()
    difference = abs(found - expected) / error
    assert (difference < WIDE).all(), f"up to {difference.max():.1f} standard errors"


@pytest.fixture(scope="module")
def free_rods():
    """Paths of free Brownian rods with D_par = 2, D_perp = 1, D_R = 0.5, by small steps, unwrapped; 40 frames, 2000 rods."""
    random = np.random.default_rng(5)
    along, across, turning, step, every = 2.0, 1.0, 0.5, 0.005, 10
    axis = random.normal(size=(2000, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    centre, centres, axes = np.zeros((2000, 3)), [], []
    for k in range(391):
        if k % every == 0:
            centres.append(centre)
            axes.append(axis)
        kick = random.normal(size=(2, 2000, 3)) * np.sqrt(2.0 * step)
        parallel = (kick[0] * axis).sum(axis=1, keepdims=True) * axis
        centre = centre + np.sqrt(along) * parallel + np.sqrt(across) * (kick[0] - parallel)
        axis = axis + np.sqrt(turning) * np.cross(kick[1], axis)
        axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    return {"centre": np.array(centres), "axis": np.array(axes), "edges": [9, 9, 9], "time": np.arange(40) * step * every}


def test_displacements_of_free_rods(free_rods):
    found = analysis.mean_square_displacements(free_rods)
    mean, tau = 4.0 / 3.0, (1.0 - np.exp(-6 * 0.5 * found.time)) / (6 * 0.5)
    agree(found.along, found.along_error, 2 * mean * found.time + 4 / 3 * tau)
    agree(found.across, found.across_error, 4 * mean * found.time - 4 / 3 * tau)
    agree(found.total, found.total_error, 6 * mean * found.time)
    short = found.time < 0.11
    assert (found.along[short] / (2 * mean * found.time[short]) > 1.3).all(), "at short times rods move along themselves"


def test_memory_of_free_rods(free_rods):
    found = analysis.orientation_memory(free_rods)
    agree(found.first, found.first_error, np.exp(-2 * 0.5 * found.time))
    agree(found.second, found.second_error, np.exp(-6 * 0.5 * found.time))


def test_errors_of_displacements_are_those_of_the_scatter():
    """Of independent rods, the error of the mean over many samples is what the samples scatter by."""
    random = np.random.default_rng(2)
    found = [analysis.mean_square_displacements({"centre": random.normal(size=(20, 100, 3)).cumsum(axis=0), "edges": [9, 9, 9]})
             for _ in range(40)]
    scatter = np.std([one.total for one in found], axis=0, ddof=1)
    told = np.mean([one.total_error for one in found], axis=0)
    assert (abs(scatter / told - 1) < WIDE / np.sqrt(2 * 39)).all()


def test_uneven_frames_count_from_the_first():
    time = np.array([0.0, 1.0, 10.0, 100.0])
    path = {"centre": np.stack([time, 0 * time, 0 * time], axis=1)[:, None], "edges": [9, 9, 9], "time": time}
    found = analysis.mean_square_displacements(path)
    assert found.time.tolist() == [1, 10, 100] and found.along.tolist() == [1, 100, 10000]
    assert np.isnan(found.along_error).all(), "one rod"


def test_rods_that_come_and_go():
    """A rod that is born later counts where it is there."""
    def frame(step, ids, x):
        count = len(ids)
        return jostle.trajectory.Frame(step, float(step), np.full(3, 9.0), (True,) * 3, np.array(ids, np.uint64), np.array([[a, 0, 0] for a in x], float),
                                       np.tile([0.0, 0, 1], (count, 1)), np.zeros((count, 3), np.int32), np.ones(count), np.ones(count))
    found = analysis.mean_square_displacements([frame(0, [3], [0]), frame(1, [3, 5], [1, 0]), frame(2, [3, 5], [2, 3])])
    assert found.total.tolist() == [(1 + 1 + 9) / 3, 4]


def test_ideal_gas_is_uncorrelated():
    """g = 1 and S = 1 and no order; also where the box is long and thin, through all faces."""
    random = np.random.default_rng(7)
    edges = np.array([6.0, 8.0, 20.0])
    axis = random.normal(size=(60, 400, 3))
    gas = {"centre": random.random((60, 400, 3)) * edges, "edges": edges, "axis": axis / np.linalg.norm(axis, axis=2, keepdims=True)}
    found = analysis.pair_correlation(gas, largest=3.0, bins=12)
    agree(found.g, found.g / np.sqrt(found.pairs), 1.0)
    agree(found.g2, np.sqrt(0.2 / found.pairs), 0.0)  # <P2^2> = 1/5
    there = np.isfinite(found.g_error)
    assert there.sum() > 6 and (abs(found.g_error[there] * np.sqrt(found.pairs[there]) - 1) < 0.8).all()
    scattering = analysis.structure_factor(gas, largest=4.0)
    agree(scattering.S, 1 / np.sqrt(60 * scattering.vectors), 1.0)


def test_pairs_are_those_of_all_images():
    random = np.random.default_rng(3)
    edges, centre = np.array([4.0, 5.0, 6.0]), random.random((50, 3)) * [12, 10, 6] - 3
    for periodic in ((True, True, True), (True, False, True), (False, False, False)):
        found = analysis.pair_correlation({"centre": centre, "edges": edges, "periodic": periodic}, largest=2.0, bins=8)
        step = centre[:, None] - centre
        step -= np.where(periodic, edges * np.round(step / edges), 0)
        distance = np.linalg.norm(step, axis=2)[np.triu_indices(50, 1)]
        assert found.pairs.tolist() == np.histogram(distance, np.linspace(0, 2, 9))[0].tolist()
        assert np.isnan(found.g).all() == (periodic != (True, True, True))


def test_lattice_scatters_at_its_wave_vectors_alone():
    lattice = np.stack(np.meshgrid(*[np.arange(4) * 1.5] * 3), axis=-1).reshape(-1, 3) + 0.2
    found = analysis.structure_factor({"centre": lattice, "edges": [6, 6, 6]}, largest=2 * np.pi / 1.5 * 1.02)
    peak = 2 * np.pi / 1.5
    shell = np.argmin(abs(found.wave_number - peak))
    inside = abs(found.wave_number - peak) > 1.0
    assert np.allclose(found.S[inside], 0.0, atol=1e-20)
    whole = np.rint(np.array(np.meshgrid(*[np.arange(-5, 6)] * 3)).reshape(3, -1).T)
    size = np.linalg.norm(whole, axis=1)
    in_shell = whole[(np.rint(size) == 4) & (size * 2 * np.pi / 6 <= peak * 1.02)]
    peaks = (np.mod(in_shell, 4) == 0).all(axis=1).sum()
    assert np.isclose(found.S[shell], 64 * peaks / len(in_shell)) and 2 * found.vectors[shell] == len(in_shell) and peaks == 6


def test_structure_factor_is_the_sum_over_rods():
    random = np.random.default_rng(11)
    edges, centre = np.array([3.0, 4.0, 5.0]), random.random((30, 3)) * 10
    found = analysis.structure_factor({"centre": centre, "edges": edges}, largest=5.0)
    whole = np.array(np.meshgrid(*[np.arange(-5, 6)] * 3)).reshape(3, -1).T
    q = 2 * np.pi * whole / edges
    size = np.linalg.norm(q, axis=1)
    wanted = (size <= 5.0) & (size > 0)
    power = abs(np.exp(-1j * q[wanted] @ centre.T).sum(axis=1))**2 / 30
    assert 2 * found.vectors.sum() == wanted.sum()
    assert np.isclose((found.S * found.vectors).sum(), power.sum() / 2)


def test_clusters_made_by_hand():
    """Two crossed rods one diameter apart; two end to end through a face; one whose image is near; one alone."""
    z, x = [0, 0, 1], [1, 0, 0]
    rods = {"centre": [[5, 5, 5], [5, 6.05, 5], [0.5, 15, 5], [16.45, 15, 5], [10, 10, 15]], "axis": [z, x, x, x, z], "length": 3.0,
            "edges": [20, 20, 20]}
    found = analysis.clusters(rods, gap=0.1)
    assert found.size[0].tolist() == [2, 2, 1]
    assert [np.flatnonzero(found.label[0] == k).tolist() for k in range(3)] == [[0, 1], [2, 3], [4]]
    assert found.number.tolist() == [3] and found.largest.tolist() == [2] and found.mean_size.tolist() == [9 / 5]
    assert analysis.clusters(rods, gap=0.04).size[0].tolist() == [1] * 5
    assert analysis.clusters({**rods, "periodic": (False, True, True)}, gap=0.1).size[0].tolist() == [2, 1, 1, 1]


def test_clusters_of_rods_longer_than_half_the_box():
    """Their middles are nearest by one image, their ends by another."""
    rods = {"centre": [[0, 0, 0], [3, 1, 0]], "axis": [[1, 0, 0], [1, 0, 0]], "length": 4.5, "edges": [10, 10, 10]}
    assert analysis.clusters(rods, gap=0.05).largest.tolist() == [2]
    far = {**rods, "centre": [[0, 0, 0], [4.0, 0.0, 0]], "length": [4.0, 8.0], "edges": [14, 10, 10]}
    assert analysis.clusters(far, gap=0.001).largest.tolist() == [2]
    assert analysis.clusters({**far, "centre": [[0, 0, 0], [6.95, 0, 0]], "length": [4.0, 7.8]}, gap=0.001).largest.tolist() == [1]
    through = {**far, "centre": [[0, 0, 0], [6.9, 0, 0]], "length": [4.0, 8.0]}
    assert analysis.clusters(through, gap=0.05).largest.tolist() == [2]


def test_of_a_run_and_of_its_file(tmp_path):
    (tmp_path / "rods.toml").write_text("[box]\nvolume_fraction = 0.1\n[rods]\ncount = 60\nlength = 2.0\n[time]\nrms_step = 0.1\n"
                                        "production = 5.0\n[output]\ntrajectory_every = 20\n")
    command(tmp_path, "run", "rods.toml", "--quiet")
    run = jostle.load(tmp_path / "rods.run")
    for rods in (run, run.trajectory, tmp_path / "rods.run", tmp_path / "rods.run" / "trajectory.h5", tmp_path / "rods.run" / "trajectory.journal",
                 list(run.trajectory)):
        assert analysis.mean_square_displacements(rods).total[0] == analysis.mean_square_displacements(run).total[0] > 0
    assert analysis.pair_correlation(run.trajectory[2:]).g[0] == 0, "hard rods do not lie in each other"
    assert analysis.clusters(run.resume(), gap=0.0).number[0] > 1
    command(tmp_path, "export", "rods.run", "--to", "gsd")
    of_gsd = analysis.mean_square_displacements(tmp_path / "rods.run" / "trajectory.gsd")
    assert np.allclose(of_gsd.total, analysis.mean_square_displacements(run).total, rtol=1e-4)
    assert np.allclose(of_gsd.along, analysis.mean_square_displacements(run).along, rtol=1e-3)


@pytest.mark.parametrize("call, words", [
    (lambda: analysis.clusters(3, gap=0.1), "are no rods"),
    (lambda: analysis.clusters("nowhere", gap=0.1), "there is no such folder"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]], "edges": [9, 9, 9]}, gap=-1), "is negative"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]]}, gap=1), "is missing"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]], "edges": [9, 9, 9], "colour": 1}, gap=1), "is no array of rods"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]], "edges": [9, 0, 9]}, gap=1), "not all positive"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]], "edges": [9, 9, 9], "axis": [1, 1, 0]}, gap=1), "unit vectors"),
    (lambda: analysis.mean_square_displacements({"centre": [[0, 0, 0]], "edges": [9, 9, 9]}), "at least two frames"),
    (lambda: analysis.mean_square_displacements({"centre": [[[0, 0, 0]]] * 2, "edges": [9, 9, 9], "time": [1, 1]}), "does not rise"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]], "edges": [9, 9, 9], "periodic": 1}, gap=1), "three of True, False"),
    (lambda: analysis.clusters({"centre": [[0, 0, 0]], "edges": [9, 9, 9]}, gap=1e9), "goes through the box too often"),
    (lambda: analysis.pair_correlation({"centre": [[0, 0, 0]], "edges": [9, 9, 9]}), "at least two rods"),
    (lambda: analysis.pair_correlation({"centre": [[0, 0, 0]] * 2, "edges": [9, 9, 9]}, largest=5), "at most half"),
    (lambda: analysis.pair_correlation({"centre": [[0, 0, 0]] * 2, "edges": [9, 9, 9]}, bins=0), "at least 1"),
    (lambda: analysis.structure_factor({"centre": [[0, 0, 0]], "edges": [9, 9, 9], "periodic": (True, True, False)}), "is open"),
    (lambda: analysis.structure_factor({"centre": [[0, 0, 0]], "edges": [9, 9, 9]}, largest=0.1), "smallest wave number"),
])
def test_refuses(call, words):
    with pytest.raises(jostle.InputError, match=words):
        call()
