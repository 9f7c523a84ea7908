"""cpack makes a Debian package whose content runs, here unpacked into a folder. tests/installation/minimal_debian, by hand, installs it."""

import os
import re
from pathlib import Path

import pytest
from conftest import RODS, succeed

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    folder = tmp_path_factory.mktemp("package")
    succeed("cpack", "--config", Path(os.environ["JOSTLE_BUILD"]) / "CPackConfig.cmake", "-B", folder)
    (made,) = folder.glob("*.deb")
    assert re.fullmatch(r"jostle_\d+\.\d+\.\d+_\w+\.deb", made.name)
    assert f"build/package/{made.name} " in (ROOT / "tools/apptainer.def").read_text()
    succeed("dpkg-deb", "-x", made, folder / "root")
    return made


def test_what_it_depends_on(package):
    """The libraries that programs are linked with, and Python only where somebody asks for pictures."""
    needed, recommended = (succeed("dpkg-deb", "-f", package, field) for field in ("Depends", "Recommends"))
    assert all(name in needed for name in ("libc6", "libfmt", "libgomp1", "libhdf5", "libstdc++6", "libtomlplusplus", "libxxhash0"))
    assert "python" not in needed and "-dev" not in needed
    assert all(name in recommended for name in ("python3-numpy", "python3-h5py", "python3-matplotlib", "python3-scipy"))


def test_its_content_runs(package, tmp_path):
    root = package.parent / "root/usr"
    (tmp_path / "scene.toml").write_text(RODS)
    around = {"cwd": tmp_path, "env": {name: value for name, value in os.environ.items() if name not in ("JOSTLE", "JOSTLE_BUILD", "PYTHONPATH")}}
    succeed(root / "bin/jostle", "run", "scene.toml", "--quiet", **around)
    succeed(root / "bin/jostle", "check", root / "share/jostle/scenes/isotropic_rods.toml", **around)
    page = succeed(root / "bin/jostle", "report", "scene.run", "--width", "100", **around).strip()
    assert 'id="rods-x"' in (tmp_path / page).read_text()
    around["env"]["PYTHONPATH"] = str(root / "lib/python3/dist-packages")
    assert succeed(os.environ["JOSTLE_PYTHON"], "-c", "import jostle; print(jostle.__file__)", **around).startswith(str(root))


def test_what_is_in_it(package):
    """Neither headers nor libraries for other programs, nor anything of the tests; what others may read, and nothing that others may write."""
    lines = [line.split(maxsplit=5) for line in succeed("dpkg-deb", "-c", package).splitlines()]
    assert not [name for *_, name in lines if name.endswith((".hpp", ".a", ".cmake", ".pyc")) or "test" in name]
    assert all(mode[7] == "r" and mode[8] == "-" and owner == "root/root" for mode, owner, *_ in lines)
    assert "./usr/share/doc/jostle/copyright" in {name for *_, name in lines}
