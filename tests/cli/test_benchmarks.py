"""The page of performance follows from the numbers of a machine; the commands that make and compare these do as they say."""

import csv
import importlib.machinery
import importlib.util
import pathlib
import re
import subprocess
import sys

import pytest

from jostle_command import JOSTLE

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCHMARKS = ROOT / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

from measurements import Machine  # noqa: E402  (the path comes first)

PAGE = ROOT / "docs" / "performance.md"
BUILD = pathlib.Path(JOSTLE).parents[1]
NUMBERS = BENCHMARKS / "results" / re.search(r"benchmarks/results/([^)]+)\)", PAGE.read_text(encoding="utf-8"))[1]


def call(name, *words):
    return subprocess.run([BENCHMARKS / name, *words], capture_output=True, text=True, timeout=120)


def written(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def test_page_follows_from_the_numbers():
    done = call("page", "--check")
    assert done.returncode == 0, "docs/performance.md is not what benchmarks/page makes: " + done.stderr


def test_page_shows_a_number_that_has_changed(tmp_path):
    with open(NUMBERS, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    row = next(row for row in rows if row[0] == "steps" and row[4] == "step_ns")
    row[5] = "12345"
    changed = tmp_path / NUMBERS.name
    with open(changed, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    before = PAGE.read_bytes()
    assert call("page", changed, "--check").returncode == 1
    assert PAGE.read_bytes() == before


def test_page_of_few_numbers_says_what_is_missing(tmp_path):
    few = written(tmp_path / "few.csv", "part,case,bodies,threads,quantity,value\nsteps,rods/0.05,20000,1,step_ns,200\n")
    loader = importlib.machinery.SourceFileLoader("page_of_performance", str(BENCHMARKS / "page"))
    page = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(page)
    text = page.renewed(PAGE.read_text(encoding="utf-8"), page.Machine(few))
    assert text.count("Not measured on this machine.") == 6
    assert "| rods, phi 0.05, 20,000: 250 ns a step | 200 ns | met |" in text
    assert "| rods, phi 0.40, 20,000: 700 ns a step | not measured |  |" in text


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "state,bodies,threads\nrods/0.05,2000\n"])
def test_what_is_no_table_is_refused(tmp_path, text):
    bad = written(tmp_path / "bad.csv", text)
    done = call("ratios", NUMBERS, bad)
    assert done.returncode == 2 and "bad.csv" in done.stderr


def test_ratios_of_printed_tables(tmp_path):
    before = written(tmp_path / "before.csv", "state,bodies,threads,step_ns,solves\nrods/0.05,2000,1,200.0,1\nrods/0.10,2000,1,300.0,1\n")
    after = written(tmp_path / "after.csv", "state,bodies,threads,step_ns,solves\nrods/0.05,2000,1,150.0,1\nspheres/0.05,2000,1,9.0,1\n")
    done = call("ratios", before, after)
    assert done.returncode == 0
    rows = list(csv.DictReader(done.stdout.splitlines()))
    assert [(row["case"], row["quantity"], row["ratio"]) for row in rows] == [("rods/0.05", "step_ns", "0.750"),
                                                                            ("rods/0.05", "solves", "1.000")]
    assert "4 numbers are in one of the files only" in done.stderr


def test_numbers_of_a_machine_are_measured_and_those_of_other_parts_kept(tmp_path):
    path = written(tmp_path / "here.csv", "part,case,bodies,threads,quantity,value\nsolvers,kept,2000,1,solve_ns,7\nsteps,old,2000,1,step_ns,8\n")
    done = call("run", "--quick", "--only", "steps", "--name", "here", "--output", tmp_path, "--build", BUILD)
    assert done.returncode == 0, done.stderr
    here = Machine(path)
    assert here.number("solvers", "kept", "solve_ns") == 7
    assert here.cases("steps") == [("rods/0.10", 2000, 1)]
    phases = [here.number("steps", "rods/0.10", f"{phase}_ns")
              for phase in ("known_velocity", "find_contacts", "solve_contacts", "measure_stress", "advance")]
    assert sum(phases) == pytest.approx(here.number("steps", "rods/0.10", "step_ns"), abs=0.5)  # each is rounded to 0.1
    assert here.text("processor")


def test_a_program_that_is_not_there_is_said_and_harms_nothing(tmp_path):
    path = written(tmp_path / "here.csv", "part,case,bodies,threads,quantity,value\nsteps,old,2000,1,step_ns,8\n")
    before = path.read_bytes()
    done = call("run", "--only", "steps", "--name", "here", "--output", tmp_path, "--build", tmp_path)
    assert done.returncode == 2 and "benchmark_step" in done.stderr
    assert path.read_bytes() == before
