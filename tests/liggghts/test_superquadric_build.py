"""Decisions of a build against a LIGGGHTS with superquadrics when it is configured, by libraries that have only the symbols; and
that the plug-in's sources compile with the flags, against the headers at hand. Runs without such a LIGGGHTS."""
import os
import pathlib

from pytest import mark
from programs import ROOT, InFolder, run

HEADERS = pathlib.Path(os.environ["GRANULAW_LIGGGHTS_HEADERS"])
STYLES = pathlib.Path(os.environ["GRANULAW_LIGGGHTS_STYLES"])  # the generated style_*_model.h and register_*.cpp
SMALLBIG = ["_ZN9LAMMPS_NS6Domain5remapEPdRi", "_ZN9LAMMPS_NS6Update14reset_timestepEl"]
SUPERQUADRIC = "_ZTVN9LAMMPS_NS19AtomVecSuperquadricE"
CONVEX = "_ZN9LAMMPS_NS17AtomVecConvexHullC1EPNS_6LAMMPSE"
SCRIPT = """set(CMAKE_NM nm)
set(CMAKE_FIND_LIBRARY_PREFIXES lib)
set(CMAKE_FIND_LIBRARY_SUFFIXES .so)
include({styles})
liggghts_find({root})
message(STATUS "flags=${{LIGGGHTS_FLAGS}}")
"""


class TestConfigure(InFolder):
    def configure(self, symbols, version="3.8.0"):
        """Exit status and text of liggghts_find() for a library that defines `symbols`."""
        (self.folder / "contact_models.h").write_text("")
        (self.folder / "version_liggghts.txt").write_text(version + "\n")
        (self.folder / "library.c").write_text("".join(f"char {symbol} = 1;\n" for symbol in symbols))
        run("cc", "-shared", "-fPIC", "-o", "libliggghts.so", "library.c", cwd=self.folder)
        (self.folder / "find.cmake").write_text(SCRIPT.format(styles=ROOT / "liggghts_plugin" / "LiggghtsStyles.cmake", root=self.folder))
        done = run("cmake", "-P", "find.cmake", cwd=self.folder, code=...)
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    def test_spheres(self):
        status, text = self.configure(SMALLBIG)
        assert status == 0, text
        assert "(spheres only, SMALLBIG)" in text
        assert text.endswith("flags="), text

    def test_superquadrics(self):
        status, text = self.configure([*SMALLBIG, SUPERQUADRIC])
        assert status == 0, text
        assert "(superquadrics, SMALLBIG)" in text
        assert "flags=SUPERQUADRIC_ACTIVE_FLAG;NONSPHERICAL_ACTIVE_FLAG" in text

    @mark.parametrize("symbols, version, sentence", (([*SMALLBIG, SUPERQUADRIC, CONVEX], "3.8.0", "was built with convex particles"),
                                                     ([SUPERQUADRIC], "3.8.0", "was not built with LAMMPS_SMALLBIG"),
                                                     ([*SMALLBIG, SUPERQUADRIC], "4.0.0", "the plug-in is written for 3.8.0")))
    def test_refusals(self, symbols, version, sentence):
        status, text = self.configure(symbols, version)
        assert status != 0, text
        assert sentence in text

    def test_sources_compile(self):
        """With the flags, as an object: the library at hand has not what it needs to be linked."""
        words = ["-std=c++20", "-O0", "-DOMPI_SKIP_MPICXX", "-DMPICH_SKIP_MPICXX", "-DSUPERQUADRIC_ACTIVE_FLAG", "-DNONSPHERICAL_ACTIVE_FLAG", f"-I{ROOT}", f"-I{ROOT / 'mpm_core'}",
                 f"-isystem{STYLES}", f"-isystem{HEADERS}"]
        for name in ("run/checks", "loop/registration", "deck/particle_sizes"):
            run("mpicxx", *words, "-fsyntax-only", ROOT / "liggghts_plugin" / f"{name}.cpp")
        run("mpicxx", *words, "-c", "-o", self.folder / "object.o", STYLES / "register_thornton.cpp")
        symbols = run("nm", self.folder / "object.o").stdout
        assert "extended_overlap_algorithm" in symbols, "the pair loop has no narrow phase"
        assert "calc_curvature_coefficient" in symbols, "bodies behind a contact have no curvature"
