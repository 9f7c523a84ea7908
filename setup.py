"""Builds the extension `_jostle` and the command `jostle` by CMake. What pip needs to know stands in pyproject.toml.

JOSTLE_BUILD: a CMake build folder that has made both already; they are taken from there.
JOSTLE_BUILD_BASE: where to put files of the build; by default build/pip.
CMAKE_PREFIX_PATH: where libraries of your own lie; CMake reads it itself.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
BASE = Path(os.environ.get("JOSTLE_BUILD_BASE", ROOT / "build" / "pip"))


class BuildByCmake(build_ext):
    def build_extension(self, extension):
        build = os.environ.get("JOSTLE_BUILD") or self._built()
        made = next((Path(build) / "python" / "jostle").glob("_jostle.*.so"))
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(made, target)
        subprocess.run(["cmake", "--install", build, "--component", "command", "--prefix", target.parent / "command"], check=True)

    def _built(self):
        build = BASE / "cmake"
        by_ninja = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *by_ninja, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                        "-DJOSTLE_TESTS=OFF", "-DJOSTLE_MPI=OFF", "-DJOSTLE_PYTHON_MODULE=REQUIRED", f"-DPython3_EXECUTABLE={sys.executable}",
                        *where_pybind11_is()], check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", "--target", "_jostle", "jostle"], check=True)
        return build


def where_pybind11_is():
    """pip's pybind11 lies among its Python modules; Debian's is found by CMake itself."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


BASE.mkdir(parents=True, exist_ok=True)
setup(ext_modules=[Extension("jostle._jostle", sources=[])], cmdclass={"build_ext": BuildByCmake},
      options={"build": {"build_base": str(BASE)}, "egg_info": {"egg_base": str(BASE)}})
