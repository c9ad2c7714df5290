"""The build backend of pyproject.toml: setuptools', with one extension that CMake builds (target cutbench_python)."""

import os
import shutil
import subprocess
from pathlib import Path

from setuptools import Extension, setup
from setuptools.build_meta import _BuildMetaBackend
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        folder = Path(os.environ.get("CUTBENCH_BUILD", ROOT / "build/python"))  # a second build takes what is there
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DCUTBENCH_PYTHON=ON"], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "cutbench_python", "--parallel", str(os.cpu_count())], check=True)
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next((folder / "package/cutbench").glob("_core*.so")), target)
        shutil.copy(ROOT / "experiments/recommend_calibration.toml", target.parent)


class _Backend(_BuildMetaBackend):
    def run_setup(self, setup_script="setup.py"):
        os.makedirs("build", exist_ok=True)
        setup(ext_modules=[Extension("cutbench._core", [])], cmdclass={"build_ext": BuildByCMake},
              options={"egg_info": {"egg_base": "build"}})  # all that is made is there


_backend = _Backend()
get_requires_for_build_wheel = _backend.get_requires_for_build_wheel
get_requires_for_build_editable = _backend.get_requires_for_build_editable
prepare_metadata_for_build_wheel = _backend.prepare_metadata_for_build_wheel
prepare_metadata_for_build_editable = _backend.prepare_metadata_for_build_editable
build_wheel = _backend.build_wheel
build_editable = _backend.build_editable
build_sdist = _backend.build_sdist
