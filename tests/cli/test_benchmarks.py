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

OVERVIEW = ROOT / "docs" / "performance.md"
BUILD = pathlib.Path(JOSTLE).parents[1]
PAGE = BENCHMARKS / "results" / re.search(r"benchmarks/results/([^)#]+\.md)[)#]", OVERVIEW.read_text(encoding="utf-8"))[1]
NUMBERS = PAGE.with_suffix(".csv")


def call(name, *words):
    return subprocess.run([BENCHMARKS / name, *words], capture_output=True, text=True, timeout=120)


def written(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def program():
    """benchmarks/page, as a module."""
    loader = importlib.machinery.SourceFileLoader("page_of_performance", str(BENCHMARKS / "page"))
    page = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(page)
    return page


def test_pages_follow_from_the_numbers():
    done = call("page", "--check")
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_table_of_the_overview_that_is_changed_is_told():
    page = program()
    text = OVERVIEW.read_text(encoding="utf-8")
    measured = page.Machine(NUMBERS)
    step = page.rounded(measured.number("steps", "rods/0.10", "step_ns", 20000))
    changed = text.replace(f" {step} |", " 1 |")
    assert changed != text and page.renewed(changed, measured, {"overview": page.overview}) == text


def test_numbers_in_the_text_of_the_overview_are_those_of_the_machine():
    page, text = program(), re.sub(r"<!-- table.*?<!-- end -->", "", OVERVIEW.read_text(encoding="utf-8"), flags=re.DOTALL)
    number = page.Machine(NUMBERS).number

    def step(state, bodies, threads=1, part="sizes"):
        return number(part, state, "step_ns", bodies, threads)

    shown = [f"{page.rounded(step('rods/0.05', 20000, part='steps'))} ns per rod", f"{page.rounded(step('rods/0.40', 20000, part='steps'))} ns at",
             " and ".join(f"{1e4 * 2000 * 1e-9 * step(state, 2000, part='steps'):.0f} s" for state in ("rods/0.05", "rods/0.40")),
             f"{page.rounded(step('rods/0.10', 10**7) / step('rods/0.10', 20000))} times as much"]
    shown += [page.rounded(number("ten_million", "jostle run", name, threads=2)) + unit
              for name, unit in (("gigabytes", " GB"), ("set_up_s", " s of set-up"), ("step_s", " s per step"))]
    faster = [step(state, 200000) / step(state, 200000, 2) for state in ("rods/0.05", "rods/0.10", "rods/0.40")]
    shown.append(f"{page.rounded(min(faster))} to {page.rounded(max(faster))} times faster")
    for beads, between in ((11, " times the processor time of jostle at phi = 0.1, and "), (6, " and ")):
        for quantity, joint in (("cpu_us_per_rod_and_step", between), ("cpu_ms_per_rod_and_D2_over_Dt", " and ")):
            ratios = [number("rivals", f"LAMMPS, {beads} beads, phi {phi}", f"{quantity}_over_jostle", 20000) for phi in ("0.1", "0.3")]
            shown.append(joint.join((page.rounded(ratios[0]), page.rounded(ratios[1]) + " times")))
    for kind, ends in (("hard", (" times faster at phi = 0.05, ", " times at 0.40 and ", " times in a nematic")),
                       ("compliant", (", ", " and ", " times faster"))):
        ratios = [number("solvers", f"{state}, {kind}, projected_sor", "times_faster") for state in ("rods/0.05", "rods/0.40", "rods/nematic")]
        shown.append("".join(page.rounded(ratio) + end for ratio, end in zip(ratios, ends)))
    assert [words for words in shown if words not in text] == []


def test_numbers_of_the_readme_are_those_of_the_overview():
    numbers = r"\d[\d.,]*\d|\d"
    item = re.search(r"\[Performance\]\(docs/performance\.md\)(.*?)\n- ", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)[1]
    known = set(re.findall(numbers, OVERVIEW.read_text(encoding="utf-8")))
    assert "ns per rod" in item and set(re.findall(numbers, item)) - known == set()


def test_the_overview_names_every_missed_aim_by_its_factor():
    missed = re.findall(r"missed by ([\d.]+) times", PAGE.read_text(encoding="utf-8"))
    text = OVERVIEW.read_text(encoding="utf-8").split("Missed aims")[1]
    assert missed and [factor for factor in missed if not re.search(rf"(?<![\d.]){re.escape(factor)}(?![\d.])", text)] == []


def test_page_shows_a_number_that_has_changed(tmp_path):
    with open(NUMBERS, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    row = next(row for row in rows if row[0] == "steps" and row[4] == "step_ns")
    row[5] = "12345"
    changed = tmp_path / NUMBERS.name
    with open(changed, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    page = written(tmp_path / PAGE.name, PAGE.read_text(encoding="utf-8"))
    before = [path.read_bytes() for path in (page, PAGE, OVERVIEW)]
    assert call("page", changed, "--check").returncode == 1
    assert [path.read_bytes() for path in (page, PAGE, OVERVIEW)] == before
    assert call("page", changed).returncode == 0
    assert "| 12345 |" in page.read_text(encoding="utf-8")
    assert [path.read_bytes() for path in (PAGE, OVERVIEW)] == before[1:]  # those of another machine


def test_page_of_few_numbers_says_what_is_missing(tmp_path):
    few = written(tmp_path / "few.csv", "part,case,bodies,threads,quantity,value\nsteps,rods/0.05,20000,1,step_ns,200\n")
    assert call("page", few).returncode == 0
    text = (tmp_path / "few.md").read_text(encoding="utf-8")
    assert text.startswith("# Measurements: few") and "## LAMMPS beside jostle" in text
    assert text.count("Not measured on this machine.") == 7
    assert "| rods, phi 0.05, 20,000: 250 ns per body and step | 200 ns | met |" in text
    assert "| rods, phi 0.40, 20,000: 900 ns per body and step | not measured |  |" in text
    assert call("page", few, "--check").returncode == 0


def test_a_page_without_a_table_is_refused(tmp_path):
    few = written(tmp_path / "few.csv", "part,case,bodies,threads,quantity,value\nsteps,rods/0.05,20000,1,step_ns,200\n")
    page = written(tmp_path / "few.md", "# Measurements\n")
    done = call("page", few)
    assert done.returncode == 1 and "few.md: tables that are not there" in done.stderr
    assert page.read_text(encoding="utf-8") == "# Measurements\n"


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
