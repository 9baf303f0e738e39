"""Programs of the build as tests call them, and materials files."""
import functools
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import subprocess
import tempfile

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MPM = os.environ.get("GRANULAW_MPM", "mpm")
LAUNCHER = os.environ.get("GRANULAW_LAUNCHER", "liggghts-mpm")
MPIRUN = os.environ.get("GRANULAW_MPIRUN", "mpirun")


class InFolder:
    """A test with a folder of its own."""

    @pytest.fixture(autouse=True)
    def _own_folder(self, tmp_path):
        self.folder = tmp_path
        self.prepare()

    def prepare(self):
        """Further files."""


def run(*words, code=0, timeout=900, env=None, **how):
    """The finished command, which must end with this exit status (None: any but 0; ...: any). `env`: more variables."""
    done = subprocess.run([str(w) for w in words], stdin=None if "input" in how else subprocess.DEVNULL, capture_output=True, text=True, errors="backslashreplace",
                          timeout=timeout, env={**os.environ, **(env or {})}, **how)
    assert code is ... or (done.returncode != 0 if code is None else done.returncode == code), f"{words}: exit {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}"
    return done


def mpm(*words, **how):
    return run(MPM, *words, **how)


def answer(*words, **how):
    """JSON that the command prints."""
    return json.loads(mpm(*words, **how).stdout)


def module(path):
    """A script of the tree as a module, whatever its ending."""
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(path).stem, str(path))
    found = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(found)
    return found


@functools.cache
def table(materials, *words):
    """Path of the law that `mpm table` makes of a materials file of this text; made once."""
    folder = pathlib.Path(tempfile.mkdtemp())
    (folder / "m.toml").write_text(materials)
    mpm("table", folder / "m.toml", *words, "-o", folder / "law.h5")
    return folder / "law.h5"


def material(name, density, youngs_modulus, poisson_ratio, yield_stress=None, more=""):
    """Its section of a materials file; `more`: further lines."""
    text = f"[material.{name}]\ndensity = {density}\nyoungs_modulus = {youngs_modulus}\npoisson_ratio = {poisson_ratio}\n"
    return text + (f"yield_stress = {yield_stress}\n" if yield_stress else "") + (f"{more}\n" if more else "")


def particle(name, material, radius=None, more=""):
    return f'[particle.{name}]\nmaterial = "{material}"\n' + (f"radius = {radius}\n" if radius else "") + (f"{more}\n" if more else "")
