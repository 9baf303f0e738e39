"""Contact laws between solid particles, computed by the material point method.

    import granulaw

    powder = granulaw.Material(density=1500, youngs_modulus=10e9, poisson_ratio=0.3, yield_stress=100e6)
    law = granulaw.table({"powder": powder}, ["powder:wall"])
    pair = law.pair("powder:wall", radius=1e-3)
    pair.impact(2.0)["e"]

Everything is SI. Arrays are NumPy's. Input that cannot be used raises granulaw.Error, a ValueError of one sentence.
"""
import os

from granulaw import _granulaw
from granulaw._granulaw import (Contact, Error, Law, Material, Materials, Pair, Particle, __version__, impact, press, read,
                                read_materials, sphere)

__all__ = ["Contact", "Error", "Law", "Material", "Materials", "Pair", "Particle", "calibrate", "impact", "press", "read",
           "read_materials", "sphere", "table", "__version__"]


def _atlas():
    return os.environ.get("GRANULAW_ATLAS") or os.path.join(os.path.dirname(__file__), "atlas.h5")


def table(materials, pairs=(), *, tolerance=0.01, depth=0.2, damage_number=0.0625, jobs=1, progress=None):
    return _granulaw._table(materials, list(pairs), tolerance, depth, damage_number, jobs, _atlas(), progress)


def calibrate(*files, fit, **options):
    words = [os.fspath(file) for file in files] + ["--fit", *([fit] if isinstance(fit, str) else fit)]
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            for one in value if isinstance(value, (list, tuple)) else [value]:
                words += [option, str(one)]
    return _granulaw._calibrate(words, _atlas())


for _function in (table, calibrate):
    _function.__doc__ = _granulaw._doc(_function.__name__)
