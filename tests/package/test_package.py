"""The Debian packages that CPack left in GRANULAW_PACKAGES; the packaged program must equal that of the build."""
import functools
import json
import os
import pathlib
import re
import shutil

from programs import MPM, ROOT, InFolder, run
from pytest import mark, skip

FOLDER = pathlib.Path(os.environ["GRANULAW_PACKAGES"])


def said(*words, **how):
    return run(*words, **how).stdout


VERSION = said(MPM, "--version").split()[1]


def package(name):
    found = [p for p in FOLDER.glob(f"{name}_*.deb") if p.name.startswith(f"{name}_{VERSION}_")]
    if len(found) != 1:
        raise AssertionError(f"{name}_{VERSION}_*.deb: {len(found)} of them in {FOLDER}")
    return found[0]


@functools.cache
def listing(name):
    """{path: (mode and kind, owner)} as dpkg sees them."""
    rows = [line.split(maxsplit=5) for line in said("dpkg-deb", "--contents", package(name)).splitlines()]
    return {path.split(" -> ")[0].removeprefix("./"): (mode, owner) for mode, owner, _, _, _, path in rows}


class TestContents:
    def test_users_find(self):
        files = listing("granulaw")
        for path in ("bin/mpm", "bin/liggghts-mpm", "lib/libgranulaw_liggghts.so", "lib/libgranulaw.so.1",
                     "share/granulaw/atlas.h5", "share/granulaw/plot_law.py",
                     "share/granulaw/plot_fields.py", "share/granulaw/examples/README.md",
                     "share/granulaw/examples/hopper/in.hopper", "share/granulaw/examples/hopper/materials.toml",
                     "share/granulaw/examples/common/sweep.py", "share/man/man1/mpm.1.gz", "share/man/man1/mpm-table.1.gz",
                     "share/man/man1/liggghts-mpm.1.gz", "share/bash-completion/completions/mpm", "share/doc/granulaw/copyright",
                     "share/doc/granulaw/changelog.gz", "share/doc/granulaw/examples"):
            assert f"usr/{path}" in files
        if shutil.which("sphinx-build"):  # without it the package has no book
            assert "usr/share/doc/granulaw/html/index.html" in files
        if (pathlib.Path(MPM).parents[2] / "explorer/index.html").exists():  # of the build that made the package
            assert "usr/share/doc/granulaw/html/_static/explorer/index.html" in files

    def test_every_example(self):
        """All that git keeps of examples/."""
        packed = {path.removeprefix("usr/share/granulaw/") for path in listing("granulaw") if not path.endswith("/")}
        kept = said("git", "-C", ROOT, "ls-files", "examples").split()
        assert len(kept) > 30
        assert set(kept) <= packed

    def test_nothing_else(self):
        for name in ("granulaw", "granulaw-dev", "python3-granulaw"):
            for path, (mode, owner) in listing(name).items():
                assert path == "" or "usr/".startswith(path) or path.startswith("usr/"), path
                assert "__pycache__" not in path
                assert owner == "root/root", path
                if not mode.startswith("l"):
                    assert "w" not in mode[5] + mode[8], path
        assert [p for p in listing("granulaw") if p.endswith((".a", ".hpp", ".cmake"))] == []

    def test_programmers_find(self):
        files = listing("granulaw-dev")
        for path in ("lib/libgranulaw_law.a", "lib/cmake/granulaw/granulawConfig.cmake", "include/granulaw/law/law.hpp", "include/granulaw.h", "lib/pkgconfig/granulaw.pc",
                     "lib/libgranulaw.so"):
            assert f"usr/{path}" in files
        assert [p for p in files if p in listing("granulaw") and not p.endswith("/")] == []


class TestFields:
    def field(self, name, package_name="granulaw"):
        return said("dpkg-deb", "--field", package(package_name), name).strip()

    def test_what_it_is(self):
        assert self.field("Package") == "granulaw"
        assert self.field("Version") == VERSION
        assert f'version: {VERSION}\n' in (ROOT / "CITATION.cff").read_text()
        assert (ROOT / "tools/package/changelog").read_text().startswith(f"granulaw ({VERSION}) ")
        assert self.field("Section") == "science"
        assert re.search(r"^.+ <\S+@\S+>$", self.field("Maintainer"))
        assert int(self.field("Installed-Size")) > 5000  # KiB; the models alone are more

    def test_what_it_needs(self):
        needs = re.split(r",\s*", self.field("Depends"))
        for need in ("liggghts (>= 3.8.0)", "liggghts (<< 3.8.1~)", "python3"):
            assert need in needs
        libraries = {need.split()[0] for need in needs}
        assert {"libc6", "libstdc++6", "liggghts"} <= libraries
        for library in ("libhdf5-", "libfmt", "libliggghts", "libopenmpi"):  # found by dpkg-shlibdeps
            assert any(name.startswith(library) for name in libraries), (library, needs)
        for tool in ("python3-h5py", "python3-matplotlib", "python3-numpy"):
            assert tool in self.field("Recommends")
        assert f"granulaw (= {VERSION})" in self.field("Depends", "granulaw-dev")


class TestUnpacked(InFolder):
    """In a folder of its own: whatever the programs read of ours must lie in the package."""
    def prepare(self):
        self.work = self.folder
        said("dpkg-deb", "--extract", package("granulaw"), self.work / "root")
        self.bin = self.work / "root/usr/bin"

    def run_here(self, *words, code=0):
        """Output under an environment that names nothing of the build."""
        done = run("env", "-i", "PATH=/usr/bin:/bin", f"HOME={self.work}", "OMP_NUM_THREADS=1", "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", *words,
                   cwd=self.work, code=code)
        return done.stdout + done.stderr

    def test_tool(self):
        materials = self.work / "root/usr/share/granulaw/examples/hopper/materials.toml"
        told = self.run_here(self.bin / "mpm", "table", materials, "-o", "wax.h5", "--no-cache")
        assert "from the atlas" in told
        one = ["law", "wax.h5", "--pair", "wax:wall", "--radius", "3e-3", "--velocity", "1.0", "--json"]
        packed, built = (json.loads(self.run_here(program, *one)) for program in (self.bin / "mpm", MPM))
        for key in ("e", "force_max_N", "contact_time_s"):
            assert packed[key] == built[key]
        self.run_here(self.bin / "mpm", "plot", "wax.h5", "-o", "wax.png")
        assert (self.work / "wax.png").read_bytes()[:4] == b"\x89PNG"

    def test_python(self):
        """python3-granulaw alone: no file and no library of the other packages."""
        assert not re.search(r"granulaw|liggghts|openmpi", said("dpkg-deb", "--field", package("python3-granulaw"), "Depends"))
        said("dpkg-deb", "--extract", package("python3-granulaw"), self.work / "alone")
        code = ("import granulaw; p = granulaw.Material(density=1500, youngs_modulus=1e10, poisson_ratio=0.3, yield_stress=1e8); "
                "print(granulaw.__version__, granulaw.table({'p': p}, ['p:wall']).pair().impact(2.0)['e'])")
        told = self.run_here("env", f"PYTHONPATH={self.work}/alone/usr/lib/python3/dist-packages", "/usr/bin/python3", "-c", code).split()
        assert told[0] == VERSION
        assert 0.5 < float(told[1]) < 1

    def test_atlas_is_the_package_s(self):
        """A damaged one is named in the tool's sentence: it reads this one, not another of this machine."""
        atlas = self.work / "root/usr/share/granulaw/atlas.h5"
        atlas.write_bytes(b"no HDF5")
        assert "share/granulaw/atlas.h5" in self.run_here(self.bin / "mpm", "table", ROOT / "examples/hopper/materials.toml", "-o", "x.h5", "--no-cache", code=1)

    def test_models(self):
        """The launcher finds the plug-in beside it, not that of the build."""
        loaded = self.run_here("ldd", self.bin / "liggghts-mpm")
        assert f"libgranulaw_liggghts.so => {self.bin}/../lib/libgranulaw_liggghts.so" in loaded
        (self.work / "in.deck").write_text("atom_style granular\nboundary f f f\nnewton off\ncommunicate single vel yes\nregion box block 0 1 0 1 0 1\n"
                                           "create_box 1 box\npair_style gran model mpm tangential history law none.h5 materials wax\n")
        assert "none.h5" in self.run_here("stdbuf", "-oL", self.bin / "liggghts-mpm", "-in", "in.deck", code=...)  # the model itself missed its law file

    @mark.parametrize("name", ("bin/mpm", "bin/liggghts-mpm", "lib/libgranulaw_liggghts.so"))
    def test_no_path_of_the_build(self, name):
        assert str(ROOT).encode() + b"/build" not in (self.work / "root/usr" / name).read_bytes(), name


class TestPrograms:
    """A C++ project finds the libraries of granulaw-dev and the atlas of granulaw in one place."""
    def test_find_package(self, folder):
        root, build = folder / "root", folder / "build"
        for name in ("granulaw", "granulaw-dev"):
            said("dpkg-deb", "--extract", package(name), root)
        said("cmake", "-S", ROOT / "tests/install/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={root}/usr")
        assert f"granulaw_DIR:PATH={root}/usr/" in (build / "CMakeCache.txt").read_text()
        said("cmake", "--build", build, "--target", "consumer")  # install.consumer compiles the rest
        said(build / "consumer", cwd=build)


class TestLintian:
    def test_no_errors(self):
        if not shutil.which("lintian"):
            skip("Debian's lintian is not installed")
        told = run("lintian", "--tag-display-limit", "0", "--allow-root", package("granulaw"), package("granulaw-dev"))
        print(told.stdout)
        assert [line for line in told.stdout.splitlines() if line.startswith("E:")] == []
        assert told.stderr == ""
