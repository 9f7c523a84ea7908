"""The Monte Carlo program behind the reference values of nematics: spheres have the pressure of the equation of state, and rods never overlap."""

import importlib.util
import pathlib
import subprocess

import numpy

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "studies/reference"


def test_spheres_and_rods(tmp_path):
    """Z of spheres is Carnahan's and Starling's (1969), right to 0.2 % there. The program ends with an error if two rods overlap when it measures."""
    spec = importlib.util.spec_from_file_location("monte_carlo", FOLDER / "monte_carlo.py")
    monte_carlo = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(monte_carlo)
    program = monte_carlo.build(tmp_path)

    def measured(length, state):
        done = subprocess.run([program, str(length), str(monte_carlo.COUNT), "1"], input=state, text=True, capture_output=True, timeout=300)
        assert done.returncode == 0, done.stderr
        return monte_carlo.measurements(numpy.array([[float(value) for value in line.split()] for line in done.stdout.splitlines()]))

    Z = measured(0, "0.4 1000 20000\n")[:, 0]
    expected = (1 + 0.4 + 0.4**2 - 0.4**3) / (1 - 0.4) ** 3
    error = Z.std(ddof=1) / len(Z) ** 0.5  # measurements are 50 sweeps apart, and as good as independent
    assert error < 0.05 and abs(Z.mean() - expected) < 4 * error + 0.002 * expected
    S = measured(5, "0.46 200 200\n0.5 200 200\n0.42 200 200\n")[:, 1]  # compressed, then expanded
    assert len(S) == 12 and 0.5 < S.min() and S.max() < 1
