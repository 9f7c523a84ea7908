"""The Python blocks of the guide run, in order; but for the last of the stress formula, which tests/cli runs."""

import re
import shutil
from pathlib import Path

import pytest

GUIDE = Path(__file__).resolve().parents[2] / "docs" / "guide"


def blocks(page):
    return re.findall(r"^```python\n(.*?)^```", (GUIDE / page).read_text(), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page, count", [("python.md", 5), ("stress_formula.md", 4)])
def test_blocks_run(page, count, run_of_rods, tmp_path, monkeypatch):
    shutil.copytree(run_of_rods, tmp_path / "rods.run")
    monkeypatch.chdir(tmp_path)
    names = {}
    found = blocks(page)
    assert len(found) == count
    for block in found if page == "python.md" else found[:3]:
        exec(block.replace('"count": 400', '"count": 60').replace("run(1000)", "run(50)"), names)
    if page == "stress_formula.md":
        assert abs(names["found"].per_body.sum(axis=0) - names["found"].total).max() < 1e-12
