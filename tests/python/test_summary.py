"""Averages with error bars of simulations in Python: those of the command."""

import json

import numpy as np
import pytest
from conftest import RODS

import jostle


def content(summary):
    """A summary without what belongs to the file, and to the build."""
    return {key: value for key, value in summary.items() if key not in ("checksum", "git")}


@pytest.mark.parametrize("kind", ["rods", "cells"])
def test_summary_is_that_of_the_command(kind, request):
    run = jostle.load(request.getfixturevalue(f"run_of_{kind}"))
    simulation = jostle.Simulation(request.getfixturevalue(kind))
    rows = simulation.run()
    assert rows.tobytes() == run.series.tobytes()
    assert json.dumps(content(simulation.summary())) == json.dumps(content(run.summary))


def test_run_to_the_end_where_equilibration_is_detected(rods):
    rods.time.equilibration = None
    calls = []
    simulation = jostle.Simulation(rods)
    simulation.run(30)
    simulation.run(every=50, callback=lambda simulation: calls.append(simulation.clock.step))
    assert simulation.clock.step >= 100 and calls == list(range(50, simulation.clock.step + 1, 50))
    assert len(simulation.run()) == 0  # nothing is left to be done
    assert len(simulation.run(5)) == 1 and simulation.summary()["steps"] == simulation.clock.step


def test_summary_of_what_there_is(rods, tmp_path):
    rods.time.equilibration = 0.5
    simulation = jostle.Simulation(rods)
    with pytest.raises(jostle.InputError, match="summary: the series has no row yet. Make more steps"):
        simulation.summary()
    simulation.run(20)
    with pytest.raises(jostle.InputError, match="no row is of production: equilibration takes a time of 0.5, and it is 0.4"):
        simulation.summary()
    simulation.run(22)
    simulation.save(tmp_path)
    simulation.run(33)
    resumed = jostle.Simulation.resume(tmp_path)
    resumed.run(33)
    assert simulation.summary()["production_rows"] == 10  # that of the steps 26 to 30, ... 71 to 75
    assert resumed.summary()["production_rows"] == 7      # that of the steps 41 to 45, ... 71 to 75
    assert resumed.summary()["Z"]["mean"] == pytest.approx(resumed.series["Z"].mean(), rel=1e-12)
    resumed.run()
    assert resumed.clock.step == 125  # 0.5 + 2.0 in steps of 0.02, those of before the checkpoint among them


def test_no_summary_within_a_step(rods):
    def motion(of, clock):
        simulation.summary()

    simulation = jostle.Simulation(rods, motion)
    with pytest.raises(RuntimeError, match="in the middle of a step"):
        simulation.step()


def test_field_is_that_of_the_command(tmp_path):
    from conftest import finished_run

    text = RODS + "field_every = 20\n"
    run = finished_run(tmp_path, text)
    simulation = jostle.Simulation(jostle.Scene.from_toml(text))
    assert simulation.field is None
    simulation.run()
    written = np.genfromtxt(run / "field.csv", delimiter=",", names=True)
    assert simulation.field.dtype.names == written.dtype.names
    last = written[written["step"] == 100]
    assert simulation.field.tobytes() == last.tobytes()
    assert jostle.Simulation(jostle.Scene.from_toml(RODS)).field is None


def test_average_is_that_of_the_summary(run_of_rods):
    run = jostle.load(run_of_rods)
    found = jostle.average(run.series["contacts"])
    assert found.mean == pytest.approx(run.series["contacts"].mean(), rel=1e-12)
    Z, found = run.summary["Z"], jostle.average(run.series["Z"])
    assert (found.mean, found.n_eff, found.standard_deviation) == (Z["mean"], Z["n_eff"], Z["standard_deviation"])


def test_average_of_correlated_rows():
    """Of x_k = a x_(k-1) + noise the error of the mean is 1/((1 - a) sqrt(n)), whatever a is."""
    noise = np.random.default_rng(3).normal(size=40000)
    rows = np.zeros(len(noise))
    for k in range(1, len(noise)):
        rows[k] = 0.9 * rows[k - 1] + noise[k]
    found = jostle.average(rows)
    assert found.standard_error == pytest.approx(10 / 200, rel=0.1)
    assert found.n_eff == pytest.approx(len(rows) / 19, rel=0.2)  # (1 + a)/(1 - a)
    assert str(found) == f"{found.mean:.5g} +- {found.standard_error:.2g} (n_eff {found.n_eff:.0f})"


@pytest.mark.parametrize("series, reason", [([], "no rows"), ([1.0] * 40, "constant"), ([1.0, 2.0], "only 2 rows")])
def test_average_without_an_error_bar(series, reason):
    found = jostle.average(series)
    assert found.standard_error is None and reason in found.no_standard_error_because


@pytest.mark.parametrize("series", [3.0, [[1.0, 2.0]], [1.0, np.nan], [True, False], "text", [1j]])
def test_average_refuses(series):
    with pytest.raises(jostle.InputError, match="^series"):
        jostle.average(series)


@pytest.mark.parametrize("pushed", [False, True])
def test_a_motion_that_is_added_takes_the_checks_of_equilibrium_away(pushed):
    """Unless a motion says that it keeps equilibrium it does not; one of Python cannot say so."""
    simulation = jostle.Simulation(jostle.Scene(box={"volume_fraction": 0.1}, rods={"count": 30, "length": 2.0},
                                                time={"rms_step": 0.1, "equilibration": 0.0, "production": 10.0}))
    if pushed:
        simulation.add_motion(lambda rods, clock: 0.0 * rods.centre)
    simulation.run()
    assert (simulation.summary()["checks"] == {}) == pushed
