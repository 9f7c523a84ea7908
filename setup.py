"""Builds the extension `_jostle` by CMake. What pip needs to know stands in pyproject.toml.

JOSTLE_BUILD: a CMake build folder that has made the package already; it is taken from there.
JOSTLE_BUILD_BASE: where to put files of the build; by default build/pip.
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

    def _built(self):
        build = BASE / "cmake"
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DJOSTLE_TESTS=OFF", "-DJOSTLE_PYTHON_MODULE=ON", f"-DPython3_EXECUTABLE={sys.executable}"],
                       check=True)
        subprocess.run(["cmake", "--build", build, "--target", "_jostle"], check=True)
        return build


BASE.mkdir(parents=True, exist_ok=True)
setup(ext_modules=[Extension("jostle._jostle", sources=[])], cmdclass={"build_ext": BuildByCmake},
      options={"build": {"build_base": str(BASE)}, "egg_info": {"egg_base": str(BASE)}})
