"""The pages in docs/examples are what the scripts say and print."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("script", sorted((ROOT / "python/examples").glob("*.py")), ids=lambda path: path.stem)
def test_page(script):
    page = (ROOT / "docs/examples" / f"{script.stem}.md").read_text()
    result = subprocess.run([sys.executable, ROOT / "tools/make_example_pages", "--check", script.stem],
                            capture_output=True, text=True, timeout=200)
    assert result.returncode == 0, result.stdout + result.stderr
    assert page.startswith("# ") and "```python" in page and "```text" in page


def test_every_page_has_a_script_and_a_link():
    pages = {page.stem for page in (ROOT / "docs/examples").glob("*.md")} - {"README"}
    assert pages == {script.stem for script in (ROOT / "python/examples").glob("*.py")} and len(pages) == 3
    for name in pages:
        assert f"{name}.md" in (ROOT / "docs/examples/README.md").read_text()


def test_notebooks_run():
    """Every cell, without Jupyter; they print and draw what is stored in them, but for digits."""
    done = subprocess.run([ROOT / "tools" / "run_notebook"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
