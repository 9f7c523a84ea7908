"""Numbers of the page that are worked out in Python: units, doubling time, radius, lineage, speeds, frames that fit."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

PRESENTATION = Path(__file__).resolve().parents[2] / "presentation"
sys.path.insert(0, str(PRESENTATION))

import colony  # noqa: E402  (the path comes first)
import colourings  # noqa: E402
import frames_of_page  # noqa: E402
import units  # noqa: E402
from lineage import Lineage  # noqa: E402
from trajectory import Frame  # noqa: E402
from verdict import verdict  # noqa: E402


def frame(step, time, ids, centre, image=0, length=2.0):
    count = len(ids)
    return Frame(step=step, time=time, edges=np.full(3, 10.0), periodic=np.ones(3, bool), id=np.array(ids),
                 centre=np.array(centre, float).reshape(count, 3), image=np.broadcast_to(image, (count, 3)),
                 axis=np.tile((0.0, 0.0, 1.0), (count, 1)), length=np.full(count, length), diameter=np.ones(count))


@pytest.mark.parametrize("unit, words", [("1", ""), ("kT-1 D3 mu", "µ D³/kT"), ("kT D-3", "kT/D³"), ("pN um-2", "pN/µm²"), ("s", "s"),
                                         ("kT D-2 mu-1", "kT/(µ D²)"), ("D", "D")])
def test_units_are_as_people_write_them(unit, words):
    assert units.readable(unit, {}) == (1.0, words)


def test_times_of_cells_are_those_of_growth():
    """rate 2 ℓ/t, D = 0.5 ℓ: a cell lengthens by D in 0.25 t, so time 1 t is 4 D/rate; stress is µ over that time."""
    scene = {"growth": {"rate": 2.0}, "rods": {"diameter": 0.5}}
    assert units.readable("time_unit", scene) == (4.0, "D/growth rate")
    assert units.readable("mu time_unit-1", scene) == (0.25, "µ growth rate/D")
    assert units.readable("mu time_unit-1", {"growth": {"rate": 0.0}}) == (1.0, "µ/τ")


def test_the_doubling_time_of_exponential_growth():
    time = np.linspace(0.0, 30.0, 301)
    run = SimpleNamespace(series={"time": time, "N": np.floor(2.0 ** (time / 3.0))}, in_unit=lambda column: (2.0, ""))
    assert colony.doubling_time(run) == pytest.approx(6.0, rel=0.01)  # 3, in a unit of half the size
    run.series["N"] = np.full(301, 5.0)
    assert colony.doubling_time(run) is None


def test_the_radius_holds_the_cells_of_a_ball():
    random = np.random.default_rng(5)
    direction = random.normal(size=(20000, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    ball = 7.0 * direction * random.uniform(size=(20000, 1)) ** (1 / 3)
    made = frame(0, 0.0, range(20000), ball + 3.0, image=(1, 0, -2))
    assert colony.radius(made) == pytest.approx(7.0 * 0.95 ** (1 / 3), abs=0.03)  # 20000 cells leave 0.004


def test_generations_ages_and_families():
    """0 divides into 0 and 5 at time 1; 5 into 5 and 9 at time 2; 0 dies at time 3. Founders 0 and 7."""
    rows = {"step": [10, 20, 30], "time": [1.0, 2.0, 3.0], "birth": [1, 1, 0], "id": [5, 9, 0], "mother": [0, 5, 0]}
    run = SimpleNamespace(table=lambda name: {key: np.array(values, float) for key, values in rows.items()})
    frames = [frame(0, 0.0, [0, 7], np.zeros((2, 3))), frame(25, 2.5, [0, 5, 7, 9], np.zeros((4, 3))),
              frame(35, 3.5, [5, 7, 9], np.zeros((3, 3)))]
    lineage = Lineage(run, frames)
    first, second, third = (lineage.at(one) for one in frames)
    assert first[0].tolist() == [0, 0] and first[1].tolist() == [0.0, 0.0]
    assert second[0].tolist() == [1, 2, 0, 2] and second[1].tolist() == [1.5, 0.5, 2.5, 0.5]
    assert third[0].tolist() == [2, 0, 2]
    families = second[2].tolist()
    assert len(set(families)) == 4  # few cells: every line is told apart


def test_speeds_go_through_periodic_faces_and_know_newborn_cells():
    before = frame(0, 1.0, [0, 1], [[9.5, 5, 5], [1, 1, 1]])
    after = frame(1, 3.0, [0, 1, 2], [[0.5, 5, 5], [1, 1, 4], [2, 2, 2]], image=np.array([[1, 0, 0], [0, 0, 0], [0, 0, 0]]))
    first, second = colourings.speeds([before, after])
    assert np.isnan(first).all()
    np.testing.assert_allclose(second, [0.5, 1.5, np.nan])


def test_frames_that_fit():
    counts = np.full(101, 1000)
    room = 1000 * frames_of_page.BYTES_OF_ROD * 4 / 3 / frames_of_page.MEGABYTE  # of a frame
    assert frames_of_page.chosen_frames(counts, 101 * room + 1e-9).tolist() == list(range(101))
    assert frames_of_page.chosen_frames(counts, 51.5 * room).tolist() == list(range(0, 101, 2))
    assert frames_of_page.chosen_frames(counts, 2.5 * room).tolist() == [0, 100]
    assert frames_of_page.chosen_frames(counts, 0.5 * room).tolist() == [100]


def test_folded_axes_unfold():
    axis = np.random.default_rng(2).normal(size=(1000, 3))
    axis[:6] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    a, b = (2.0 * values / 65535 - 1.0 for values in frames_of_page.folded(axis))
    z = 1.0 - np.abs(a) - np.abs(b)
    fold = np.maximum(-z, 0.0)
    n = np.stack((a - np.copysign(fold, a), b - np.copysign(fold, b), z), axis=1)
    assert np.abs(n / np.linalg.norm(n, axis=1, keepdims=True) - axis).max() < 1e-4


CHECK = {"measured": {"mean": 1.01, "standard_error": 0.004}, "in_equilibrium": {"from": 1.0, "to": 1.0}, "agree": True}


@pytest.mark.parametrize("judged, states", [
    ("reached", ["good", "good", "good"]), ("not reached", ["bad", "good", "good"]), ("too short to tell", ["bad", "good", "good"])])
def test_the_verdict_is_that_of_the_summary(judged, states):
    summary = {"equilibrated": judged == "reached", "equilibrium": {"verdict": judged, "in_words": f"{judged}: covers 5.9 rotation times"},
               "equilibration_time": 1.0, "time": 9.0, "max_overlap": 0.01, "checks": {"total_stress_ratio": CHECK}}
    run = SimpleNamespace(summary=summary, record={}, is_colony=False, propelled=False, scene={}, in_unit=lambda column: (1.0, "s"))
    lines = verdict(run)
    assert [state for state, *_ in lines] == states
    assert "covers 5.9 rotation times" in lines[0][2]
    assert "1.01 ± 0.004" in lines[1][2]
    summary["checks"]["total_stress_ratio"] = {**CHECK, "agree": False}
    assert verdict(run)[1][0] == "bad" and verdict(run)[1][1] == "The whole stress is not isotropic"
