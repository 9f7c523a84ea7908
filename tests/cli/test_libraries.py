"""How CMake finds the libraries that jostle is built with: all that are missing are named at once, and a prefix of one's own is enough."""

import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Libraries that work from their headers: Debian's package, and what is to be unpacked.
HEADERS = {"libcli11-dev": "CLI", "libeigen3-dev": "eigen3", "librandom123-dev": "Random123", "libfmt-dev": "fmt",
           "libkissfft-dev": "kissfft",
           "nlohmann-json3-dev": "nlohmann", "libtomlplusplus-dev": "toml++", "libxxhash-dev": "xxhash.h"}
COMPILED = {"libhdf5-dev", "libqhull-dev"}
NOTHING_OF_DEBIAN = ("-DCMAKE_IGNORE_PREFIX_PATH=/usr;/", "-DCMAKE_DISABLE_FIND_PACKAGE_HDF5=ON")


def configure(build, *words):
    return subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DJOSTLE_TESTS=OFF", "-DCMAKE_CXX_COMPILER=/usr/bin/g++",
                           "-DCMAKE_C_COMPILER=/usr/bin/gcc", *words], capture_output=True, text=True, timeout=200)


def named(result):
    """The packages that CMake says are missing, each named in a line of its own and in the command that installs them."""
    assert result.returncode != 0 and result.stderr.count("CMake Error") == 1, result.stderr
    packages = set(re.search(r"apt-get install (.*)", result.stderr)[1].split())
    assert packages == set(re.findall(r"^ +.*: (\S+)$", result.stderr, re.MULTILINE))
    return packages


def prefix_of(places, folder):
    (folder / "include").mkdir(parents=True)
    for place in places:
        (folder / "include" / place).symlink_to(Path("/usr/include") / place)
    return f"-DCMAKE_PREFIX_PATH={folder}"


def test_every_missing_library_is_named_at_once(tmp_path):
    result = configure(tmp_path / "build", *NOTHING_OF_DEBIAN, "-DJOSTLE_PYTHON_MODULE=REQUIRED")
    assert named(result) == {*HEADERS, *COMPILED, "pybind11-dev"}


def test_only_what_is_missing_is_named(tmp_path):
    prefix = prefix_of([place for place in HEADERS.values() if place != "CLI"], tmp_path / "prefix")
    assert named(configure(tmp_path / "build", *NOTHING_OF_DEBIAN, prefix)) == {"libcli11-dev", *COMPILED}


def test_headers_in_a_prefix_are_enough(tmp_path):
    """They come before those of the system, and no library of the system is mixed with them."""
    prefix = tmp_path / "prefix"
    result = configure(tmp_path / "build", prefix_of(HEADERS.values(), prefix), "-DJOSTLE_PYTHON_MODULE=OFF")
    assert result.returncode == 0, result.stderr
    found = dict(re.findall(r"^(\w+_INCLUDE_DIR):PATH=(.*)$", (tmp_path / "build/CMakeCache.txt").read_text(), re.MULTILINE))
    assert {name for name, place in found.items() if place.startswith(str(prefix))} >= {
        f"{name}_INCLUDE_DIR" for name in ("CLI11", "Eigen3", "Random123", "fmt", "kissfft", "nlohmann_json", "tomlplusplus", "xxhash")}
    build = (tmp_path / "build/build.ninja").read_text()
    assert not re.search(r"lib(fmt|xxhash|tomlplusplus)\.(so|a)", build)
    assert "-DFMT_HEADER_ONLY" in build and "-DXXH_INLINE_ALL" in build and f"-isystem {prefix}/include" in build


def test_quickstart_installs_what_the_report_draws_rods_with():
    """Modules that the report asks for, and what draws its plots; a still picture for print takes povray, which is left to others."""
    needed = set(re.findall(r'"(python3-\w+)"', (ROOT / "presentation/report.py").read_text()))
    installed = set(re.findall(r"^quickstart +(\S+)", (ROOT / "tools/packages.txt").read_text(), re.MULTILINE))
    assert {"python3-numpy", "python3-h5py", "python3-matplotlib"} <= needed and needed | {"libjs-dygraphs"} <= installed
