"""pip makes a package that works, from what this build has made; offline, into a folder of its own."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_pip_install(tmp_path):
    pytest.importorskip("pip")
    result = subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index",
                             "--no-cache-dir", "--target", str(tmp_path / "site"), str(ROOT)], capture_output=True,
                            text=True, timeout=250, env={**os.environ, "JOSTLE_BUILD_BASE": str(tmp_path / "base")})
    assert result.returncode == 0, result.stdout + result.stderr
    program = ("import jostle; print(jostle.__file__, jostle.__version__); "
               "print(jostle.segment_distance([0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0])[0])")
    found = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True,
                           env={**os.environ, "PYTHONPATH": str(tmp_path / "site")})
    assert found.returncode == 0, found.stderr
    assert found.stdout == f"{tmp_path / 'site/jostle/__init__.py'} 0.1.0\n2.0\n"
