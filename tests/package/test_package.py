#!/usr/bin/python3
"""The Debian packages that CPack left in FOLDER.

    test_package.py FOLDER MPM SOURCES Contents|Fields|Unpacked|Programs|Lintian

MPM: the program of the build, which the packaged one must equal."""
import functools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FOLDER, MPM, SOURCES = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])


def said(*words, **how):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, stdin=subprocess.DEVNULL, **how)
    if done.returncode:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


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


class Contents(unittest.TestCase):
    def test_users_find(self):
        files = listing("granulaw")
        for path in ("bin/mpm", "bin/liggghts-mpm", "lib/libgranulaw_liggghts.so",
                     "share/granulaw/atlas.h5", "share/granulaw/plot_law.py",
                     "share/granulaw/plot_fields.py", "share/granulaw/examples/README.md",
                     "share/granulaw/examples/hopper/in.hopper", "share/granulaw/examples/hopper/materials.toml",
                     "share/granulaw/examples/common/sweep.py", "share/man/man1/mpm.1.gz", "share/man/man1/mpm-table.1.gz",
                     "share/man/man1/liggghts-mpm.1.gz", "share/bash-completion/completions/mpm", "share/doc/granulaw/copyright",
                     "share/doc/granulaw/changelog.gz", "share/doc/granulaw/examples"):
            self.assertIn(f"usr/{path}", files)
        if shutil.which("sphinx-build"):  # without it the package has no book
            self.assertIn("usr/share/doc/granulaw/html/index.html", files)
        if (pathlib.Path(MPM).parents[2] / "explorer/index.html").exists():  # of the build that made the package
            self.assertIn("usr/share/doc/granulaw/html/_static/explorer/index.html", files)

    def test_every_example(self):
        """All that git keeps of examples/."""
        packed = {path.removeprefix("usr/share/granulaw/") for path in listing("granulaw") if not path.endswith("/")}
        kept = said("git", "-C", SOURCES, "ls-files", "examples").split()
        self.assertGreater(len(kept), 30)
        self.assertLessEqual(set(kept), packed)

    def test_nothing_else(self):
        for name in ("granulaw", "granulaw-dev"):
            for path, (mode, owner) in listing(name).items():
                self.assertTrue(path == "" or "usr/".startswith(path) or path.startswith("usr/"), path)
                self.assertNotIn("__pycache__", path)
                self.assertEqual(owner, "root/root", path)
                if not mode.startswith("l"):
                    self.assertNotIn("w", mode[5] + mode[8], path)
        self.assertEqual([p for p in listing("granulaw") if p.endswith((".a", ".hpp", ".cmake"))], [])

    def test_programmers_find(self):
        files = listing("granulaw-dev")
        for path in ("lib/libgranulaw_law.a", "lib/cmake/granulaw/granulawConfig.cmake", "include/granulaw/law/law.hpp"):
            self.assertIn(f"usr/{path}", files)
        self.assertEqual([p for p in files if p in listing("granulaw") and not p.endswith("/")], [])


class Fields(unittest.TestCase):
    def field(self, name, package_name="granulaw"):
        return said("dpkg-deb", "--field", package(package_name), name).strip()

    def test_what_it_is(self):
        self.assertEqual(self.field("Package"), "granulaw")
        self.assertEqual(self.field("Version"), VERSION)
        self.assertIn(f'version: {VERSION}\n', (SOURCES / "CITATION.cff").read_text())
        self.assertTrue((SOURCES / "tools/package/changelog").read_text().startswith(f"granulaw ({VERSION}) "))
        self.assertEqual(self.field("Section"), "science")
        self.assertRegex(self.field("Maintainer"), r"^.+ <\S+@\S+>$")
        self.assertGreater(int(self.field("Installed-Size")), 5000)  # KiB; the models alone are more

    def test_what_it_needs(self):
        needs = re.split(r",\s*", self.field("Depends"))
        for need in ("liggghts (>= 3.8.0)", "liggghts (<< 3.8.1~)", "python3"):
            self.assertIn(need, needs)
        libraries = {need.split()[0] for need in needs}
        self.assertLessEqual({"libc6", "libstdc++6", "liggghts"}, libraries)
        for library in ("libhdf5-", "libfmt", "libliggghts", "libopenmpi"):  # found by dpkg-shlibdeps
            self.assertTrue(any(name.startswith(library) for name in libraries), (library, needs))
        for tool in ("python3-h5py", "python3-matplotlib", "python3-numpy"):
            self.assertIn(tool, self.field("Recommends"))
        self.assertIn(f"granulaw (= {VERSION})", self.field("Depends", "granulaw-dev"))


class Unpacked(unittest.TestCase):
    """In a folder of its own: whatever the programs read of ours must lie in the package."""
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.work)
        said("dpkg-deb", "--extract", package("granulaw"), self.work / "root")
        self.bin = self.work / "root/usr/bin"
        self.environment = {"PATH": "/usr/bin:/bin", "HOME": str(self.work), "OMP_NUM_THREADS": "1",
                            "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

    def run_here(self, *words):
        return said(*words, cwd=self.work, env=self.environment)

    def test_tool(self):
        materials = self.work / "root/usr/share/granulaw/examples/hopper/materials.toml"
        told = self.run_here(self.bin / "mpm", "table", materials, "-o", "wax.h5", "--no-cache")
        self.assertIn("from the atlas", told)
        one = ["law", "wax.h5", "--pair", "wax:wall", "--radius", "3e-3", "--velocity", "1.0", "--json"]
        packed, built = (json.loads(self.run_here(program, *one)) for program in (self.bin / "mpm", MPM))
        for key in ("e", "force_max_N", "contact_time_s"):
            self.assertEqual(packed[key], built[key])
        self.run_here(self.bin / "mpm", "plot", "wax.h5", "-o", "wax.png")
        self.assertEqual((self.work / "wax.png").read_bytes()[:4], b"\x89PNG")

    def test_atlas_is_the_package_s(self):
        """A damaged one is named in the tool's sentence: it reads this one, not another of this machine."""
        atlas = self.work / "root/usr/share/granulaw/atlas.h5"
        atlas.write_bytes(b"no HDF5")
        done = subprocess.run([self.bin / "mpm", "table", SOURCES / "examples/hopper/materials.toml", "-o", "x.h5", "--no-cache"],
                              cwd=self.work, env=self.environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("share/granulaw/atlas.h5", done.stderr)

    def test_models(self):
        """The launcher finds the plug-in beside it, not that of the build."""
        loaded = said("ldd", self.bin / "liggghts-mpm", env=self.environment)
        self.assertIn(f"libgranulaw_liggghts.so => {self.bin}/../lib/libgranulaw_liggghts.so", loaded)
        (self.work / "in.deck").write_text("atom_style granular\nboundary f f f\nnewton off\ncommunicate single vel yes\nregion box block 0 1 0 1 0 1\n"
                                           "create_box 1 box\npair_style gran model mpm tangential history law none.h5 materials wax\n")
        stopped = subprocess.run(["stdbuf", "-oL", self.bin / "liggghts-mpm", "-in", "in.deck"], cwd=self.work, env=self.environment,
                                 capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertIn("none.h5", stopped.stdout + stopped.stderr)  # the model itself missed its law file

    def test_no_path_of_the_build(self):
        for name in ("bin/mpm", "bin/liggghts-mpm", "lib/libgranulaw_liggghts.so"):
            self.assertNotIn(str(SOURCES).encode() + b"/build", (self.work / "root/usr" / name).read_bytes(), name)


class Programs(unittest.TestCase):
    """A C++ project finds the libraries of granulaw-dev and the atlas of granulaw in one place."""
    def test_find_package(self):
        with tempfile.TemporaryDirectory() as folder:
            root, build = pathlib.Path(folder) / "root", pathlib.Path(folder) / "build"
            for name in ("granulaw", "granulaw-dev"):
                said("dpkg-deb", "--extract", package(name), root)
            said("cmake", "-S", SOURCES / "tests/install/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={root}/usr")
            self.assertIn(f"granulaw_DIR:PATH={root}/usr/", (build / "CMakeCache.txt").read_text())
            said("cmake", "--build", build, "--target", "consumer")  # install.consumer compiles the rest
            said(build / "consumer", cwd=build)


class Lintian(unittest.TestCase):
    def test_no_errors(self):
        words = ["lintian", "--tag-display-limit", "0", "--allow-root", package("granulaw"), package("granulaw-dev")]
        told = subprocess.run([str(w) for w in words], capture_output=True, text=True)
        print(told.stdout)
        self.assertEqual([line for line in told.stdout.splitlines() if line.startswith("E:")], [])
        self.assertEqual(told.stderr, "")
        self.assertEqual(told.returncode, 0)


if sys.argv[4] == "Lintian" and not shutil.which("lintian"):
    print("skipped: Debian's lintian is not installed")
    sys.exit(77)
unittest.main(argv=[sys.argv[0], sys.argv[4]])
