"""Cells that grow, divide and die: files whose number of rods changes, and runs that stop between divisions."""

import json
import signal

import h5py
import numpy as np

from jostle_command import (DONE, NUMERICS, STOPPED, changed, column, finish, mean, require_same_results, run, start, wait_until,
                            write_scene)

# Ten cells, three generations, a little noise; every file written, no two of the intervals in step.
CELLS = {
    "seed": 4,
    "box": {"edges": [20.0, 20.0, 20.0]},
    "rods": {"count": 10, "length": 2.0},
    "growth": {"rate": 1.0, "rate_deviation": 0.1, "division_length": 5.0, "division_deviation": 0.05,
               "death_rate": 0.02},
    "time": {"step": 0.01, "production": 11.0},
    "output": {"series_every": 5, "trajectory_every": 12, "checkpoint_every": 32, "contacts": True},
}


def test_files_follow_the_number_of_cells(tmp_path):
    write_scene(tmp_path, CELLS)
    folder = finish(tmp_path)
    births = column(folder / "lineage.csv", "birth")
    alive = 10 + sum(1 if birth else -1 for birth in births)
    assert sum(births) > 50 and len(births) - sum(births) > 2
    assert column(folder / "series.csv", "N")[-1] == alive
    ids = column(folder / "lineage.csv", "id")
    born = {id for id, birth in zip(ids, births) if birth} | set(range(10))
    assert len(born) == 10 + sum(births)
    assert set(column(folder / "lineage.csv", "mother")) <= born
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        id_of_frame = rods["id/value"][...]
        counts = (id_of_frame >= 0).sum(axis=1)
        assert counts[0] == 10 and counts.max() == id_of_frame.shape[1]
        for frame in (0, len(counts) // 2, -1):
            there = id_of_frame[frame] >= 0
            assert len(set(id_of_frame[frame][there])) == counts[frame]
            lengths = rods["length/value"][frame]
            assert np.all((lengths[there] >= 1.0) & (lengths[there] < 6.0)) and np.all(np.isnan(lengths[~there]))
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["equilibration_time"] == 0.0 and summary["checks"] == {}
    assert summary["rods"] == alive and mean(folder, "Z") > 1.0
    # From 10 to some 60 cells: no state of which there could be an error bar.
    assert summary["Z"]["standard_error"] is None and "Cells grow throughout" in summary["Z"]["no_standard_error_because"]
    assert summary["stress_collision"]["standard_error"] == 3 * [3 * [None]]


def test_stopped_and_resumed_across_divisions(tmp_path):
    """Stopped by a signal in several places: the same bits in every file as in one go."""
    write_scene(tmp_path / "whole", CELLS)
    whole = finish(tmp_path / "whole")
    folder = tmp_path / "parts"
    write_scene(folder, CELLS)
    series = folder / "run" / "series.csv"
    for rows in (20, 90, 150):
        process = start(folder)
        wait_until(lambda rows=rows: series.exists() and series.read_bytes().count(b"\n") > rows, process)
        process.send_signal(signal.SIGINT)
        process.communicate()
        assert process.returncode in (STOPPED, DONE)
    require_same_results(whole, finish(folder))


def test_a_population_that_dies_out_ends_well(tmp_path):
    write_scene(tmp_path, changed(CELLS, growth={"death_rate": 20.0}))
    result = run(tmp_path)
    assert result.returncode == DONE and "all cells have died" in result.stderr
    assert json.loads((tmp_path / "run" / "run.json").read_text())["exit_reason"] == "extinct"
    assert sum(column(tmp_path / "run" / "lineage.csv", "birth")) == 0
    again = run(tmp_path)
    assert again.returncode == DONE and "all cells have died" in again.stderr


def test_soft_cells_that_have_died_out_go_on(tmp_path):
    write_scene(tmp_path, changed(CELLS, growth={"death_rate": 20.0}, contact={"model": "wca"}, time={"step": 0.005}))
    for _ in range(2):
        result = run(tmp_path)
        assert result.returncode == DONE and "all cells have died" in result.stderr


def test_swimmers_from_a_file_that_divide_take_little_memory(tmp_path):
    """Daughters' ids have gaps: they are no rows."""
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n5,5,5,1,0,0\n10,10,10,0,1,0\n")
    write_scene(tmp_path, changed(CELLS, rods={"count": None, "start": "file", "file": "rods.csv"},
                                  growth={"death_rate": 0.0}, motion={"self_propulsion": 1.0}))
    folder = finish(tmp_path)
    ids = column(folder / "lineage.csv", "id")
    assert max(ids) > len(ids) + 2
    assert (folder / "checkpoint").stat().st_size < 100000


def test_active_stress_goes_on_through_divisions(tmp_path):
    """A line of cells that swims along x, U_0 = 1, and lengthens: pushes between them add up to none, so that the mean path is that of
    one cell alone, and the active stress tells how old it is. After every lag that is the same again, divisions or not."""
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n50,50,50,1,0,0\n")
    write_scene(tmp_path, {"box": {"edges": [100.0, 100.0, 100.0]},
                           "rods": {"start": "file", "file": "rods.csv", "length": 2.5},
                           "mobility": {"model": "slender_body"},
                           "motion": {"brownian": False, "self_propulsion": 1.0},
                           "growth": {"rate": 1.0, "division_length": 6.0},
                           "time": {"step": 0.01, "equilibration": 0.0, "production": 9.0},
                           "output": {"series_every": 10, "active_stress_lag": 1.0}})
    series = finish(tmp_path) / "series.csv"
    time, number, stress = (np.array(column(series, name)) for name in ("time", "N", "stress_active_xx"))
    assert number[-1] == 4
    length = 2.5 + np.round(time, 6) % 3.5
    mobility = (2.0 * np.log(2.0 * length) - 1.0) / (4.0 * np.pi * length)
    age = stress * 100.0**3 * mobility / number
    assert np.all(np.isnan(age[:9])) and np.all((age[9:] > 1.0 - 1e-9) & (age[9:] < 2.0))
    assert np.allclose(age[19:], age[9:-10], atol=1e-6)


def test_lines_longer_than_ids_can_tell(tmp_path):
    """40 founders have 6 bits of an id, their lines the other 47: the run ends there, as one that failed."""
    write_scene(tmp_path, changed(CELLS, rods={"count": 40, "length": 1.0}, box={"edges": [60.0, 60.0, 60.0]},
                                  growth={"rate": 1.0, "rate_deviation": 0.0, "division_deviation": 0.0,
                                          "division_length": 3.0, "death_rate": 0.31},
                                  time={"step": 0.05, "production": 200.0},
                                  output={"series_every": 20, "trajectory_every": 500, "contacts": False}))
    result = run(tmp_path)
    assert result.returncode == NUMERICS and "has had 47 divisions in its line (allowed: at most 47" in result.stderr
    record = json.loads((tmp_path / "run/run.json").read_text())
    assert "has had 47 divisions" in record["exit_reason"]
    assert (tmp_path / "run/post_mortem.json").exists() and (tmp_path / "run/trajectory.h5").exists()
    assert 47 * 2.0 <= column(tmp_path / "run/series.csv", "time")[-1] + 1.0 <= 48 * 2.0


def test_cells_that_lengthen_and_do_not_divide_have_no_error_bar(tmp_path):
    """Their number stays, and their state does not."""
    write_scene(tmp_path, {"box": {"volume_fraction": 0.1}, "rods": {"count": 60, "length": 1.0}, "growth": {"rate": 0.02, "division_length": 9.0},
                           "time": {"step": 0.02, "equilibration": 0.0, "production": 20.0}})
    summary = json.loads((finish(tmp_path) / "summary.json").read_text())
    assert summary["rods"] == 60 and summary["equilibrium"]["in_words"] == "not checked: cells grow"
    for name in ("Z", "pressure", "nematic_order", "anisotropy"):
        assert summary[name]["standard_error"] is None, name
