"""liggghts_plugin/copy_to_src into a folder that looks like LIGGGHTS's src: what it copies, what it refuses, and that the words
it prints compile what it copied."""
import os
import pathlib
import re

from programs import ROOT, InFolder, run

HEADERS = pathlib.Path(os.environ["GRANULAW_LIGGGHTS_HEADERS"])
NOT_COPIED = {"register_hertz.cpp"}  # a yardstick for benchmarks


class TestCopyToSrc(InFolder):
    def prepare(self):
        self.src = self.folder / "src"
        self.src.mkdir()
        for header in HEADERS.glob("*.h"):
            (self.src / header.name).symlink_to(header.resolve())
        (self.src / "version_liggghts.txt").write_text("3.8.0\n")

    def copy(self, folder="src", status=0):
        done = run(ROOT / "liggghts_plugin" / "copy_to_src", folder, code=status, cwd=self.src.parent)
        return done.stdout if status == 0 else done.stderr

    def test_all_sources(self):
        before = {path.name for path in self.src.iterdir()}
        (self.src / "granulaw_old.cpp").write_text("of an earlier version")
        self.copy()
        folders = {path.parent for path in (ROOT / "liggghts_plugin").glob("*/*.hpp")} - {ROOT / "liggghts_plugin/plan"}
        folders |= {ROOT / "mpm_core" / name for name in ("law", "contact", "base")}
        expected = {"granulaw_" + str(path.relative_to(ROOT)).replace("/", "_") for folder in folders for path in folder.glob("*.cpp") if path.name not in NOT_COPIED}
        expected |= {"granulaw_mpm_core_base_version.cpp"}
        expected |= {f"granulaw_liggghts_plugin_loop_register_{model}.cpp" for model in ("mpm", "thornton")}  # of models.list
        assert {path.name for path in self.src.iterdir()} - before == expected | {"granulaw"}
        for filled_in in ("granulaw_mpm_core_base_version.cpp", "granulaw_liggghts_plugin_loop_register_mpm.cpp"):
            assert "@" not in (self.src / filled_in).read_text()

    def test_what_is_copied_includes_what_is_copied(self):
        """A header that stays behind stops the build of a user's own LIGGGHTS."""
        self.copy()
        places = [self.src / "granulaw", self.src / "granulaw" / "mpm_core"]
        missing = [f"{file.name}: {name}" for file in [*self.src.glob("granulaw_*.cpp"), *(self.src / "granulaw").rglob("*.hpp")]
                   for name in re.findall(r'^#include "([a-z_]+/[^"]+)"', file.read_text(), re.M) if not any((place / name).exists() for place in places)]
        assert missing == []

    def test_its_words_compile(self):
        """One file of each folder (docs/guide/own-liggghts.md: the whole of LIGGGHTS, done once)."""
        words = dict(line.split(" = ", 1) for line in self.copy().splitlines() if " = " in line)
        flags = words["MPI_CCFLAGS_USR"].split() + ["-O2", "-std=c++17"] + words["LMP_INC"].split()  # as Makefile.auto orders them
        for name in ("mpm_core_law_law.cpp", "liggghts_plugin_deck_options.cpp", "mpm_core_base_version.cpp"):
            run("mpicxx", *flags, "-fsyntax-only", self.src / f"granulaw_{name}")

    def test_its_flags_make_the_loop_fast(self):
        """Those of the plug-in's own build (NormalModels.cmake, cmake/Granulaw.cmake), each worth a tenth of the loop time or more."""
        flags = next(line for line in self.copy().splitlines() if line.startswith("MPI_CCFLAGS_USR = ")).split()
        for flag in ("-fno-math-errno", "-fno-tree-slp-vectorize"):
            assert flag in flags

    def test_its_words_link_a_shared_library(self):
        """As the rule `shlib` of Makefile.auto links, without LDFLAGS; nothing of HDF5 and fmt may stay undefined."""
        words = dict(line.split(" = ", 1) for line in self.copy().splitlines() if " = " in line)
        (self.src / "uses_hdf5.cpp").write_text("#include <hdf5.h>\nint version() { return H5open(); }\n")
        flags = words["MPI_CCFLAGS_USR"].split() + ["-std=c++17"] + words["LMP_INC"].split() + ["-fPIC", "-shared", "-Wl,--no-undefined"]
        libraries = ["-L" + words["MPI_LIB_USR"]] + words["MPI_ADDLIBS_USR"].split()
        run("mpicxx", *flags, "-o", "libtest.so", "uses_hdf5.cpp", "granulaw_mpm_core_base_error.cpp", *libraries, cwd=self.src)

    def test_refusals(self):
        assert "holds no contact_models.h" in self.copy(".", status=1)
        (self.src / "version_liggghts.txt").write_text("4.0.0\n")
        assert "LIGGGHTS '4.0.0'; the models are written for 3.8.0" in self.copy(status=1)
        assert not (self.src / "granulaw").exists()
