"""Columns of the series that are functions of the user."""

import numpy as np
import pytest

import jostle


@pytest.fixture
def simulation(rods):
    return jostle.Simulation(rods)


def test_column_is_taken_at_every_row(simulation):
    """It sees the simulation of its row: what the series says of it already, it says, too. Both ways to make steps, and any portions."""
    simulation.add_column("n", len)
    simulation.add_column("t", lambda simulation: simulation.clock.time, unit="kT-1 D3 mu", definition="time again")
    simulation.add_column("order", lambda simulation: np.linalg.eigvalsh(1.5 * np.einsum("ia,ib->ab", *[simulation.rods.axis] * 2) / 50 - np.eye(3) / 2)[-1])
    for _ in range(7):
        simulation.step()
    rows = simulation.run(21)
    assert simulation.series["step"].tolist() == [5, 10, 15, 20, 25] and rows["step"].tolist() == [10, 15, 20, 25]
    assert simulation.series["n"].tolist() == [50] * 5 and np.array_equal(simulation.series["t"], simulation.series["time"])
    assert np.allclose(simulation.series["order"], simulation.series["nematic_order"], atol=1e-12)
    assert simulation.columns["t"] == {"unit": "kT-1 D3 mu", "symbol": "", "definition": "time again", "sign": ""}


def test_columns_change_nothing_else(rods):
    plain, watched = jostle.Simulation(rods), jostle.Simulation(rods)
    watched.add_column("x", lambda simulation: simulation.contacts["force"].sum() + simulation.stress[0, 0] + simulation.series["Z"][-1])
    assert np.array_equal(plain.run(40), watched.run(40)[list(plain.series.dtype.names)])


def test_average_is_that_of_the_command(rods):
    """A column that repeats one of the series has its mean, error and n_eff; one that begins late has those of its rows."""
    rods.time.production = 40.0
    simulation = jostle.Simulation(rods)
    simulation.add_column("contacts_again", lambda simulation: simulation.series["pressure"][-1])
    simulation.run()
    summary = simulation.summary()
    ours, theirs = summary["columns"]["contacts_again"], summary["pressure"]
    assert ours["mean"] == theirs["mean"] and ours["n_eff"] == theirs["n_eff"]
    assert ours["standard_error"] == theirs["standard_error"]
    assert ours.get("no_standard_error_because") == theirs.get("no_standard_error_because")


def test_average_has_an_error_bar_in_equilibrium():
    scene = jostle.Scene(box={"volume_fraction": 0.1}, rods={"count": 50, "length": 0}, time={"equilibration": 1.0, "production": 60.0})
    simulation = jostle.Simulation(scene)
    simulation.add_column("Z_again", lambda simulation: simulation.series["Z"][-1])
    simulation.run()
    summary = simulation.summary()
    assert summary["columns"]["Z_again"]["standard_error"] == summary["Z"]["standard_error"] > 0


def test_late_column_has_nan_before(simulation):
    simulation.run(10)
    simulation.add_column("late", lambda simulation: 1.0)
    simulation.run(10)
    assert np.array_equal(simulation.series["late"], [np.nan, np.nan, 1, 1], equal_nan=True)
    assert simulation.summary()["columns"]["late"]["mean"] == 1.0


@pytest.mark.parametrize("value, error", [(lambda simulation: 1 / 0, ZeroDivisionError), (lambda simulation: "three", jostle.InputError),
                                          (lambda simulation: [1.0, 2.0], jostle.InputError), (lambda simulation: np.nan, jostle.InputError)])
def test_what_a_function_raises_ends_the_run_between_steps(simulation, value, error):
    simulation.add_column("bad", value)
    simulation.add_column("good", lambda simulation: 2.0)
    with pytest.raises(error):
        simulation.run(20)
    assert simulation.clock.step == 5 and len(simulation.series) == 1
    assert np.isnan(simulation.series["bad"][0])


def test_function_that_looks_at_the_series_and_the_columns(simulation):
    """Within a function its own column has no value of this row yet."""
    seen = []
    simulation.add_column("a", lambda simulation: seen.append(simulation.series["a"][-1]) or 1.0)
    simulation.run(10)
    assert np.isnan(seen).all() and len(seen) == 2 and simulation.series["a"].tolist() == [1, 1]


@pytest.mark.parametrize("name, function", [("Z", len), ("two words", len), (3, len), ("new", 3)])
def test_refuses(simulation, name, function):
    with pytest.raises(jostle.InputError):
        simulation.add_column(name, function)
    simulation.add_column("new", len)
    with pytest.raises(jostle.InputError, match="already"):
        simulation.add_column("new", len)
