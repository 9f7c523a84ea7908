"""Every example of docs/guide/stress_formula.md is run, and does what the page says."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np

from fenced_blocks import fenced_blocks
from jostle_command import DONE, SPHERES, changed, command, finish, with_steps, write_scene

PAGE = Path(__file__).parents[2] / "docs/guide/stress_formula.md"
BLOCKS = fenced_blocks(PAGE)


def texts(language):
    return [text for name, text in BLOCKS if name == language]


def test_the_program():
    result = subprocess.run([os.environ["GUIDE"]], capture_output=True, text=True, timeout=60)
    assert result.returncode == DONE, result.stderr
    assert result.stdout == texts("text")[0]


def test_the_command(tmp_path):
    contacts, bodies, shares = texts("csv")
    for table in (contacts, bodies):
        name = table.splitlines()[0].removeprefix("# ")
        (tmp_path / name).write_text(table)
    (line,) = texts("sh")
    result = command(tmp_path, *shlex.split(line)[1:])
    assert result.returncode == DONE, result.stderr
    assert result.stdout == texts("text")[1]
    assert (tmp_path / "per_body.csv").read_text() == shares


def test_contacts_of_a_run(tmp_path):
    scene = changed(SPHERES, output={"contacts": True, "series_every": 1})
    write_scene(tmp_path, with_steps(scene, 50))
    finish(tmp_path)
    code = texts("python")[-1]  # tests/python runs the others
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True, timeout=60)
    row = np.genfromtxt(tmp_path / "run/series.csv", delimiter=",", names=True)[-1]
    volume = 64 * np.pi / 6 / 0.3
    result = command(tmp_path, "stress", "contacts.csv", "--bodies", "bodies.csv", "--volume", volume, "--per-body",
                     "per_body.csv")
    assert result.returncode == DONE, result.stderr
    shares = np.genfromtxt(tmp_path / "per_body.csv", delimiter=",", skip_header=1)[:, 1:]
    expected = [row[f"stress_{a}{b}"] for a in "xyz" for b in "xyz"]
    assert row["active_contacts"] > 0
    np.testing.assert_allclose(shares.sum(axis=0), expected, rtol=0, atol=1e-12 * np.abs(expected).max())
