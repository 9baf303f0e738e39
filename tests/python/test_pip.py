"""`pip install .` in a virtual environment, without a network."""
import subprocess
import sys

from programs import ROOT, InFolder


class TestPip(InFolder):
    def test_a_virtual_environment_imports_it(self):
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", self.folder / "env"], check=True)
        python = self.folder / "env/bin/python"
        subprocess.run([python, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps", ROOT], check=True, cwd=self.folder)
        code = "import granulaw; p = granulaw.Material(density=1500, youngs_modulus=1e10, poisson_ratio=.3, yield_stress=1e8); print(granulaw.table({'p': p}, ['p:wall']).pair().impact(2.0)['e'])"
        e = float(subprocess.run([python, "-c", code], check=True, cwd=self.folder, capture_output=True, text=True).stdout)
        assert 0.5 < e < 1
