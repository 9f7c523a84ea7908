"""Contact problems that are not solved are told, exit 3, with a post-mortem; nothing is hidden."""

import json
from pathlib import Path

import pytest

from jostle_command import (DONE, NUMERICS, RODS, changed, checkpoint_step, column, command, finish, lines_but_notices,
                            require_one_line, run, snapshot, with_steps, write_scene)

SCENES = Path(__file__).resolve().parents[2] / "scenes"
TIGHT = {"solver": {"max_iterations": 1}}
# 125 spheres in rows through a periodic box that is a little too small for them: there is no room for any push.
JAMMED = {
    "seed": 1,
    "box": {"edges": [4.998, 4.998, 4.998]},
    "rods": {"length": 0.0, "start": "file", "file": "spheres.csv"},
    "motion": {"brownian": False},
    "time": {"step": 0.01, "equilibration": 0.0, "production": 1.0},
    "output": {"series_every": 1},
}
FIELDS = ["failure", "step", "time", "time_step", "volume_fraction", "residual", "tolerance", "iterations",
          "max_iterations", "contacts", "max_overlap", "deepest_contacts", "strongest_contacts", "checksum"]
CONTACT_FIELDS = ["id_i", "id_j", "image", "gap", "force"]


def require_failure(folder, *parts):
    """Exit 3; three lines on stderr: what, what to do, where to look. Returns the post-mortem."""
    result = run(folder)
    assert result.returncode == NUMERICS, (result.returncode, result.stdout, result.stderr)
    assert result.stdout == ""
    lines = lines_but_notices(result.stderr)
    assert len(lines) == 3, result.stderr
    assert lines[0].startswith("jostle: step ") and lines[2] == "  details: run/post_mortem.json"
    for part in parts:
        assert part in result.stderr, result.stderr
    record = json.loads((folder / "run/post_mortem.json").read_text())
    assert list(record) == FIELDS
    assert f"step {record['step']} failed: {record['failure']}" in lines[0]
    assert json.loads((folder / "run/run.json").read_text())["exit_reason"] == record["failure"]
    assert not (folder / "run/summary.json").exists()
    assert command(folder, "verify", "run").returncode == DONE
    return record


def require_contacts(record):
    deepest, strongest = record["deepest_contacts"], record["strongest_contacts"]
    assert len(deepest) == len(strongest) == min(10, record["contacts"]) > 0
    for contact in deepest + strongest:
        assert list(contact) == CONTACT_FIELDS and contact["force"] >= 0.0 and len(contact["image"]) == 3
    assert [c["gap"] for c in deepest] == sorted(c["gap"] for c in deepest)
    assert [c["force"] for c in strongest] == sorted((c["force"] for c in strongest), reverse=True)


def test_iteration_limit(tmp_path):
    write_scene(tmp_path, changed(RODS, **TIGHT))
    record = require_failure(tmp_path, "not solved within solver.max_iterations", "try a smaller time.step")
    require_contacts(record)
    assert record["max_iterations"] == 1
    assert record["residual"] > record["tolerance"] > 0.0
    assert record["volume_fraction"] == pytest.approx(0.25)
    assert record["time"] == pytest.approx(record["step"] * record["time_step"])
    # The same command fails in the same way, and what was there before stays.
    again = require_failure(tmp_path)
    assert again == record


def test_failure_after_sound_steps(tmp_path):
    """A bound that most steps keep: the rows before the failure are those of the run without the bound."""
    scene = changed(with_steps(RODS, 300), output={"series_every": 1}, solver={"method": "bbpgd"})
    write_scene(tmp_path / "free", scene)
    rows = (finish(tmp_path / "free") / "series.csv").read_text().splitlines()
    most = max(column(tmp_path / "free/run/series.csv", "iterations"))
    for tenths in range(9, 0, -1):  # a step may solve more than once, so `most` alone does not tell the bound
        folder = tmp_path / f"bound_{tenths}"
        write_scene(folder, changed(scene, solver={"max_iterations": max(1, int(most * tenths / 10))}))
        if run(folder).returncode != DONE:
            break
    record = require_failure(folder)
    assert record["step"] > 0
    assert (folder / "run/trajectory.h5").exists()
    assert (folder / "run/series.csv").read_text().splitlines() == rows[:record["step"] + 1]
    assert checkpoint_step(folder / "run") == record["step"] - record["step"] % RODS["output"]["checkpoint_every"]


def test_infeasible(tmp_path):
    places = [0.9996 * (k + 0.5) for k in range(5)]
    rows = [f"{x},{y},{z},1,0,0" for x in places for y in places for z in places]
    (tmp_path / "spheres.csv").write_text("\n".join(["x,y,z,nx,ny,nz", *rows]) + "\n")
    write_scene(tmp_path, JAMMED)
    record = require_failure(tmp_path, "step 0 failed: the contact problem has no solution", "lower volume fraction")
    require_contacts(record)
    assert record["contacts"] >= 375
    assert record["volume_fraction"] == pytest.approx(3.141592653589793 / 6 / 0.9996**3)


def test_overlap_limit(tmp_path):
    scene = changed(with_steps(RODS, 10**5), rods={"length": 5.0}, time={"step": 0.3},
                    contact={"overlap_limit": 1e-4})
    write_scene(tmp_path, scene)
    record = require_failure(tmp_path, "rods overlap by", "more than contact.overlap_limit allows (0.0001)")
    assert record["max_overlap"] > 1e-4
    require_contacts(record)
    assert record["deepest_contacts"][0]["gap"] == pytest.approx(-record["max_overlap"])
    # With a limit that is not reached the same scene goes on.
    write_scene(tmp_path / "free", with_steps(changed(scene, contact={"overlap_limit": 0.9}), record["step"] + 10))
    assert run(tmp_path / "free").returncode == DONE


def test_too_dense_to_start(tmp_path):
    """A start that cannot be had is bad input: nothing was simulated, nothing is left behind."""
    write_scene(tmp_path, changed(RODS, rods={"start": "lattice", "count": 3}, box={"volume_fraction": 0.84}))
    before = snapshot(tmp_path)
    require_one_line(command(tmp_path, "check", "scene.toml"), "do not fit into the box in rows")
    require_one_line(run(tmp_path), 'scene.toml:7:9: rods.start = "lattice": ', "do not fit into the box in rows",
                     "Use a lower volume fraction")
    assert snapshot(tmp_path) == before
