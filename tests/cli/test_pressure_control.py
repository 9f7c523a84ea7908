"""[pressure]: runs that go on to the same bits, and what they leave."""

import json
import signal

import pytest

from jostle_command import (DONE, NUMERICS, RODS, STOPPED, changed, column, command, finish, kill, require_one_line, require_refused, require_same_results, rows_of,
                            start, stop_and_kill, wait_until, with_steps, write_scene)

PRESSED = changed(RODS, pressure={"external": 0.8})


def test_stopped_and_resumed(tmp_path):
    scene = changed(with_steps(PRESSED, 500), output={"series_every": 1, "checkpoint_every": 40})
    write_scene(tmp_path / "whole", scene)
    whole = finish(tmp_path / "whole")
    volume = column(whole / "series.csv", "volume")
    assert len(set(volume)) == len(volume) - 1 or len(set(volume)) == len(volume)  # it stays in the first step alone
    summary = json.loads((whole / "summary.json").read_text())
    assert summary["pressure_control"]["external"]["value"] == 0.8
    folder = tmp_path / "parts"
    write_scene(folder, scene)
    for rows, number, status in ((60, signal.SIGTERM, STOPPED), (250, signal.SIGKILL, -signal.SIGKILL)):
        process = start(folder)
        wait_until(lambda rows=rows: rows_of(folder / "run/series.csv") > rows, process)
        assert kill(process, number)[0] == status
        assert command(folder, "verify", "run").returncode == DONE
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_a_limit_ends_the_run(tmp_path):
    write_scene(tmp_path, changed(PRESSED, pressure={"external": 5.0, "limit_volume_fraction": 0.27}))
    folder = finish(tmp_path)
    assert column(folder / "series.csv", "phi")[-1] > 0.26
    assert json.loads((folder / "summary.json").read_text())["rods"] == 50


def test_a_box_far_from_its_pressure(tmp_path):
    """It comes to it in steps that contacts can follow, which are counted; and does not see-saw about it."""
    write_scene(tmp_path, changed(with_steps(PRESSED, 1500), box={"volume_fraction": 0.05}, pressure={"external": 3.0, "relaxation_time": 20.0},
                                  time={"equilibration": 2.0}))
    folder = finish(tmp_path)
    held_back = column(folder / "series.csv", "held_back")
    assert max(held_back[:5]) > 0.5 and max(held_back[-20:]) == 0.0 and column(folder / "series.csv", "phi")[-1] > 0.35
    assert json.loads((folder / "summary.json").read_text())["pressure_control"]["held_back"] < 1.0


def test_a_box_that_would_see_saw_is_refused(tmp_path):
    require_refused(tmp_path, changed(PRESSED, pressure={"external": 5.0, "relaxation_time": 1.0, "coupling": "orthogonal"}),
                    "pressure.relaxation_time = 1", "lets the bath move the box so far", "at most 0.1 is possible")


SLIT = changed(RODS, box={"volume_fraction": None, "edges": [8.0, 8.0, 8.0], "periodic": [True, True, False]},
               walls={"faces": [False, False, True]})
PISTON = changed(SLIT, pressure={"external": 0.8, "coupling": "piston"})
COMPRESSED = changed(PRESSED, fluid={"kT": 0.0}, time={"step": 0.5})


@pytest.mark.parametrize("scene", [PISTON, COMPRESSED], ids=["piston", "compression"])
def test_pistons_and_compression_go_on_to_the_same_bits(tmp_path, scene):
    scene = changed(with_steps(scene, 300), output={"series_every": 1, "checkpoint_every": 40})
    write_scene(tmp_path / "whole", scene)
    whole = finish(tmp_path / "whole")
    assert len(set(column(whole / "series.csv", "volume"))) > 290
    edges = set(column(whole / "series.csv", "edge_x"))
    assert (len(edges) == 1) == (scene is not COMPRESSED and "walls" in scene)
    folder = tmp_path / "parts"
    write_scene(folder, scene)
    stop_and_kill(folder, (60, signal.SIGTERM), (150, signal.SIGKILL))
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_what_a_compression_tells(tmp_path):
    write_scene(tmp_path, with_steps(COMPRESSED, 300))
    summary = json.loads((finish(tmp_path) / "summary.json").read_text())
    last = summary["pressure_control"]["last"]
    assert last["volume_fraction"] > 0.5 and 0.5 < last["pressure_over_external"] < 1.01 and last["contacts_per_rod"] > 4.0
    assert "Z" not in summary["pressure_control"] and summary["checks"] == {}
    assert "the box is compressed" in summary["equilibrium"]["in_words"] and summary["pressure"]["standard_error"] is None


@pytest.mark.parametrize("scene, told", [
    (changed(SLIT, pressure={"external": 0.8}), 'coupling = "piston"'),
    (changed(PRESSED, pressure={"limit_volume_fraction": 0.25}), "is reached as the run begins"),
    (changed(PRESSED, pressure={"coupling": "piston"}), "there are 0 pairs of them"),
    (changed(PISTON, box={"periodic": [True, False, False]}, walls={"faces": [False, True, True]}), "there are 2 pairs of them"),
    (changed(PISTON, box={"periodic": [True, False, False]}), "nothing holds the rods"),
    (changed(COMPRESSED, pressure={"coupling": "orthogonal"}), "needs thermal motion"),
    (changed(COMPRESSED, solver={"method": "projected_sor"}), "cannot solve for a box that all contacts open"),
    (changed(COMPRESSED, forces={"alignment_energy": 1.0}), "[forces] do"),
    (changed(COMPRESSED, growth={"rate": 1.0, "division_length": 4.0}), "cells that grow"),
])
def test_what_does_not_go_together(tmp_path, scene, told):
    write_scene(tmp_path, scene)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), told)
    assert not (tmp_path / "scene.run").exists()


def test_a_box_that_becomes_too_thin_for_its_rods_ends_the_run(tmp_path):
    """A bath of high pressure presses the thin edge down to where a step turns rods farther than their own images let them."""
    scene = changed(RODS, box={"volume_fraction": None, "edges": [9.0, 9.0, 1.06]}, rods={"count": 12, "length": 2.0, "start": "aligned"},
                    pressure={"external": 20.0, "coupling": "orthogonal"})
    write_scene(tmp_path, with_steps(scene, 500))
    failed = command(tmp_path, "run", "scene.toml")
    assert failed.returncode == NUMERICS and "an edge of the box has become" in failed.stderr
