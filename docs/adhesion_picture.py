#!/usr/bin/python3
"""The picture of the theory of adhesion: a sphere that LIGGGHTS presses to three depths and draws off, with and without adhesion.

    docs/adhesion_picture.py --mpm build/release/tools/mpm/mpm --liggghts build/release/liggghts_plugin/liggghts-mpm
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "examples/common"))
import one_sentence  # noqa: E402, F401
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

RADIUS, WORK, STEPS = 2e-6, 0.066, 2000
TOML = "[material.powder]\ndensity = 1500\nyoungs_modulus = 3e9\npoisson_ratio = 0.3\nyield_stress = 1.1e8\n"


def deck(depth, work):
    style = "model mpm tangential off" + (" cohesion dent" if work else "")
    after = 0.002 * RADIUS
    return (f"units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\n"
            f"region box block {-3 * RADIUS} {3 * RADIUS} {-3 * RADIUS} {3 * RADIUS} {-RADIUS} {5 * RADIUS} units box\ncreate_box 1 box\nneighbor {RADIUS / 3} bin\nneigh_modify delay 0\n"
            "fix m1 all property/global youngsModulus peratomtype 3e9\nfix m2 all property/global poissonsRatio peratomtype 0.3\n"
            f"fix m3 all property/global workOfAdhesion peratomtypepair 1 {WORK}\nfix m4 all property/global adhesionRange scalar 0.8e-9\n"
            f"pair_style gran {style} law law.h5 materials powder elasticDamping off\npair_coeff * *\nfix w all wall/gran {style} primitive type 1 zplane 0.0\n"
            f"create_atoms 1 single 0 0 {RADIUS * (1 + 1e-9)!r} units box\nset group all diameter {2 * RADIUS!r} density 1500\ntimestep 1e-3\n"
            "variable x equal z[1]\nvariable f equal fz[1]\nthermo_style custom step v_x v_f\nthermo 1\nthermo_modify norm no format float %.12g\n"
            f"fix m all move linear 0 0 {-depth / STEPS * 1e3!r}\nrun {STEPS}\nunfix m\nfix m all move linear 0 0 {(depth + after) / STEPS * 1e3!r}\nrun {STEPS}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", default="mpm")
    parser.add_argument("--liggghts", default="liggghts-mpm")
    asked = parser.parse_args()
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "m.toml").write_text(TOML)
        subprocess.run([pathlib.Path(asked.mpm).resolve(), "table", "m.toml", "--pair", "powder:powder", "--pair", "powder:wall", "-o", "law.h5"], cwd=folder, check=True, capture_output=True)
        for depth, colour in ((0.01, "tab:green"), (0.02, "tab:orange"), (0.04, "tab:blue")):
            for work, style in ((0.0, "--"), (WORK, "-")):
                (pathlib.Path(folder) / "in").write_text(deck(depth * RADIUS, work))
                text = subprocess.run([pathlib.Path(asked.liggghts).resolve(), "-in", "in"], cwd=folder, check=True, capture_output=True, text=True).stdout
                rows = [[float(w) for w in row] for row in re.findall(r"^ *\d+ +(\S+) +(\S+) *$", text, re.M)]
                axes.plot([1 - x / RADIUS for x, _ in rows], [1e6 * f for _, f in rows], style, color=colour, lw=1.4 if work else 0.9, label=f"pressed to {depth:g} R" if work else None)
    axes.axhline(0, color="0.7", lw=0.6)
    axes.set(xlabel="overlap/R", ylabel="force, uN", ylim=(-4, 12))
    axes.legend(frameon=False)
    figure.savefig(pathlib.Path(__file__).parent / "theory/adhesion.png", dpi=130)


main()
