"""studies/run: verdicts that can fail, runs that resume, and what a user gets who asks for nonsense."""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys

import pytest

from jostle_command import JOSTLE, wait_until

STUDIES = pathlib.Path(__file__).resolve().parents[2] / "studies"
sys.path.insert(0, str(STUDIES))

import page  # noqa: E402  (the path comes first)
import quickstart  # noqa: E402
import reference_values  # noqa: E402
from report import Report  # noqa: E402


def study(*arguments, **options):
    return subprocess.run([STUDIES / "run", *arguments], capture_output=True, text=True, check=False, timeout=200,
                          env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}, **options)


def test_closed_forms_agree_with_the_virial_series():
    for beta in (1, 2, 3, 5):
        phi = 1e-3
        Z, error = reference_values.virial(beta, phi)
        third_order = (20 * phi)**3
        assert error < 1e-4
        assert reference_values.nezbeda(beta, phi) == pytest.approx(Z, abs=third_order)
        assert reference_values.parsons_lee(beta, phi) == pytest.approx(Z, abs=(4 * beta * phi)**2)
    assert reference_values.virial(5, 0.3) is None  # no reference where the series is too short
    assert reference_values.hard_spheres(0.3) == pytest.approx(reference_values.carnahan_starling(0.3), rel=4e-3)
    assert reference_values.best(5, 0.2)[:2] == (4.2657, 0.0109)


def test_predicted_anisotropy():
    """The numbers of the theory for L/D = 5: 1.035, 1.145, 1.178 at phi = .397, .419, .448."""
    states = {phi: (Z, S) for phi, Z, S in reference_values.mcgrother()}
    for phi, expected in ((0.397, 1.035), (0.419, 1.145), (0.448, 1.178)):
        assert reference_values.predicted_anisotropy(5, *states[phi]) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize("measured, passes", [(1.0, True), (1.029, True), (0.97, False), (1.031, False),
                                              (float("nan"), False)])
def test_a_comparison_can_fail(measured, passes, tmp_path):
    """1 % + 2 combined standard errors of 0.006 and 0.008: 0.03."""
    report = Report("name", "title", "question", tmp_path)
    assert not report.passed  # without a check nothing has passed
    report.compare("state", (measured, 0.006), (1.0, 0.008), 0.01)
    assert report.passed == passes and report.checks[0].rule == "1 % + 2 combined standard errors"
    assert report.require("bound", 2.0, upper=3.0) and report.require("bound", 2.0, lower=1.0)
    assert not report.require("bound", 2.0, upper=1.9) and not report.require("bound", 2.0, lower=2.1)
    assert not report.require("bound", float("nan"), upper=1.0)
    assert not report.passed


def test_quickstart_prints_its_bound_and_the_worst_case():
    """phi, Z, its error, the reference, its error, per cent, combined standard errors: the first deviates more in per cent, the second beyond its bound."""
    rows = [[0.1, 2.05, 0.03, 2.0, 0.04, 2.5, 1.0], [0.2, 4.08, 0.003, 4.0, 0.004, 2.0, 16.0]]
    assert quickstart.claim(rows) == ("|Z - Z_ref| <= 1 % of Z_ref + 2 combined standard errors holds in 1 of 2 states. "
                                      "The worst case is phi = 0.20, +2.00 %, +16.0 combined standard errors.")


def test_bad_requests(tmp_path):
    unknown = study("isotropic_presure")
    assert unknown.returncode == 2 and "isotropic_pressure" in unknown.stderr
    missing = study("drag_independence", "--quick", "--jostle", tmp_path / "none", "--results", tmp_path)
    assert missing.returncode == 2 and "there is no program" in missing.stderr
    assert study("drag_independence", "--quick", "--processes", "0").returncode == 2
    no_results = study("page", "--results", tmp_path)
    assert no_results.returncode == 2 and f"studies/run isotropic_pressure makes {tmp_path}/" in no_results.stderr
    assert list(tmp_path.iterdir()) == []


def test_the_page_is_renewed_study_by_study():
    text = page.FOLDER.joinpath("README.md").read_text(encoding="utf-8")
    names = re.findall(r'^## <a name="(\w+)">', text, re.MULTILINE)
    assert len(names) >= 7 and page.renewed(text, [], names) == text
    check = {"name": "size", "passed": False, "measured": 2.0, "expected": 1.0, "allowed": 0.0, "rule": "at most 1"}
    verdict = {"study": "time_step", "title": "A title", "question": "How?", "passed": False, "checks": [check], "remarks": ["So."],
               "tables": [], "figures": [], "runs": 3, "rod_steps": 4.0e5, "processor_seconds": 67.0, "processors": ["One"],
               "versions": ["0.1.0 (abc)"]}
    renewed = page.renewed(text, [verdict], names)
    assert "| FAIL | 0 of 1 | 3 | 4.00e+05 | 1 min 07 s |" in " ".join(renewed.split()) and "[A title](#time_step)" in renewed
    assert "|  size |        2 |        1 |       0 | at most 1 |" in renewed and "on One; jostle 0.1.0 (abc)." in renewed
    begin, end = text.index('## <a name="time_step"'), text.index('## <a name="nematic_transition"')
    assert renewed.index('## <a name="nematic_transition"') > renewed.index('## <a name="time_step"') > 0
    assert text[end:] in renewed and text[begin:end] not in renewed
    assert page.renewed(renewed, [], names) == renewed


def test_the_worst_cases_of_the_readme_are_those_of_the_page():
    item = re.search(r"- \[Validation\]\(docs/validation/README\.md\)(.*?)\n- ", (STUDIES.parent / "README.md").read_text(encoding="utf-8"), re.DOTALL)[1]
    told = re.findall(r"the worst is (L/D = \d+, phi = [\d.]+), ([-+][\d.]+ %), ([-+][\d.]+) combined standard errors", " ".join(item.split()))
    text = page.FOLDER.joinpath("README.md").read_text(encoding="utf-8")
    shown = re.findall(r"the worst deviation of 29 points with a reference is ([-+][\d.]+ %), ([-+][\d.]+) combined standard errors \((.*?)\)", text)
    assert [(per_cent, errors, state) for state, per_cent, errors in told] == shown and len(shown) == 2


def test_stop_and_resume(tmp_path):
    """Ctrl-C ends with 75 and leaves checkpoints; the same command goes on from them, and a third has nothing to run."""
    command = [STUDIES / "run", "drag_independence", "--quick", "--jostle", JOSTLE, "--results", tmp_path,
               "--processes", "2"]
    folder = tmp_path / "drag_independence-quick"
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    series = folder / "runs" / "slender_body" / "series.csv"
    wait_until(lambda: series.exists() and series.stat().st_size > 5000, process)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 75 and "goes on from here" in errors
    assert not (folder / "verdict.json").exists()
    again = subprocess.run(command, capture_output=True, text=True, check=False, timeout=200)
    assert again.returncode in (0, 1), again.stdout + again.stderr
    verdict = json.loads((folder / "verdict.json").read_text())
    # A sound program fails this study's check once in a hundred seeds, and exceeds this once in ten thousand.
    assert [check["measured"] < 21.11 for check in verdict["checks"]] == [True]
    assert again.returncode == (0 if verdict["passed"] else 1), again.stdout + again.stderr
    sessions = [json.loads(path.read_text())["sessions"] for path in folder.glob("runs/*/run.json")]
    assert max(len(of_run) for of_run in sessions) == 2
    assert verdict["quick"]
    assert 4 * 32000 <= verdict["steps"] <= 4 * 32020  # times are rounded up to whole rows
    for ending in ("csv", "png", "svg"):
        assert (folder / f"drag_independence.{ending}").stat().st_size > 100
    third = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert third.returncode == again.returncode and "4 of them done before" in third.stdout
