"""pip makes a package that works in a virtual environment, the command with its Python programs included; offline, from what this build has made."""

import os
import sys
from pathlib import Path

import pytest
from conftest import RODS, succeed

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """A virtual environment that sees Debian's modules: no network is asked for what the package depends on."""
    pytest.importorskip("pip")
    folder = tmp_path_factory.mktemp("pip")
    python = folder / "environment/bin/python3"
    succeed(sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", folder / "environment")
    succeed(sys.executable, "-m", "pip", "--python", python, "install", "--no-build-isolation", "--no-index", "--no-deps",
            "--no-cache-dir", ROOT,
            env={**os.environ, "JOSTLE_BUILD_BASE": str(folder / "base")})
    return folder / "environment"


def outside(environment, **others):
    """Surroundings that tell nothing of this build, nor of the virtual environment."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("JOSTLE", "PYTHON"))}
    return {**kept, "PATH": "/bin", **others}


def test_package(environment, tmp_path):
    program = ("import jostle; print(jostle.__file__, jostle.__version__); "
               "print(jostle.segment_distance([0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0])[0])")
    printed = succeed(environment / "bin/python3", "-c", program, cwd=tmp_path, env=outside(environment))
    assert printed == f"{environment}/lib/python3.{sys.version_info.minor}/site-packages/jostle/__init__.py 0.1.0\n2.0\n"


def test_command(environment, tmp_path):
    """It runs a scene; the report, which Python makes, is made with the Python of the environment, by files of the package alone."""
    (tmp_path / "scene.toml").write_text(RODS)
    jostle, around = environment / "bin/jostle", {"cwd": tmp_path, "env": outside(environment)}
    assert succeed(jostle, "--version", **around).startswith("jostle 0.1.0 ")
    succeed(jostle, "run", "scene.toml", "--quiet", **around)
    modules = tmp_path / "modules"
    modules.mkdir()
    (modules / "usercustomize.py").write_text(f"import sys\nopen({str(tmp_path / 'seen')!r}, 'a').write(sys.executable + '\\n')\n")
    succeed(jostle, "export", "scene.run", "--to", "xyz", cwd=tmp_path, env=outside(environment, PYTHONPATH=str(modules)))
    assert set((tmp_path / "seen").read_text().split()) == {f"{environment}/bin/python3"}
    page = Path(succeed(jostle, "report", "scene.run", "--width", "100", **around).strip())
    assert 'id="rods-x"' in (tmp_path / page).read_text() and "dygraph" in (tmp_path / page).read_text()
    sources = [path for path in (environment / "lib").rglob("report.py")]
    assert len(sources) == 1 and "jostle/command/share" in str(sources[0])
