#!/usr/bin/python3
"""A bare Debian 12 (debootstrap, minbase): the package of FOLDER is installed by apt, by the words of
the container's recipe (Dockerfile), makes a law, runs a small hopper, and goes
without a trace. Then python3-granulaw alone makes a law. Needs root, debootstrap and a Debian mirror; skipped (77) where one of them is missing.

    test_bare_debian.py FOLDER [--root DIR]

--root: a bare Debian that stays; made if it is not there. Else one is made in a temporary folder and removed."""
import argparse
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
MIRROR = os.environ.get("GRANULAW_DEBIAN_MIRROR", "http://deb.debian.org/debian")
# Files that change independently of a package's coming or going.
BOOKKEEPING = re.compile(r"/(proc|sys|dev|tmp|run|root/work|var/(log|cache|lib/(apt|dpkg|systemd|python)))(/|$)"
                         r"|/etc/ld\.so\.cache$|/var/lib/apt$")
# Ordinary words of a user, line by line; the hopper is the example's own small one.
USE = """set -e
mkdir -p /root/work && cd /root/work
mpm --version
mpm table /usr/share/granulaw/examples/hopper/materials.toml -o wax.h5
mpm law wax.h5 --pair wax:wall --radius 3e-3 --velocity 1.0
mpm plot wax.h5 -o wax.png
/usr/bin/python3 /usr/share/doc/granulaw/examples/hopper/run.py --quick --seeds 1 --models mpm -o flow
"""


PYTHON = """set -e
apt-get -q update
apt-get -q -y install --no-install-recommends /tmp/python3-granulaw_*.deb
cd /root/work
python3 -c "
import granulaw
powder = granulaw.Material(density=1500, youngs_modulus=10e9, poisson_ratio=0.3, yield_stress=100e6)
print(granulaw.table({'powder': powder}, ['powder:wall']).pair(radius=1e-3).impact(2.0)['e'])"
"""


def say(text):
    print(f"{time.monotonic() - START:5.0f} s  {text}", flush=True)


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def inside(root, script):
    """Runs a shell script in the root. Its mounts are in a namespace of their own: none is left behind, however this ends."""
    enter = (f"mount --bind /proc '{root}/proc' && mount --rbind /dev '{root}/dev' && "
             f"exec chroot '{root}' /usr/bin/env -i HOME=/root/work PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C "
             "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 /bin/sh -c \"$1\"")
    done = subprocess.run(["unshare", "--mount", "sh", "-c", enter, "sh", script], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise SystemExit(f"failed ({done.returncode}): {script}\n{(done.stdout + done.stderr)[-4000:]}")
    return done.stdout


def make_root(root):
    done = subprocess.run(["debootstrap", "--variant=minbase", "bookworm", str(root), MIRROR], capture_output=True, text=True)
    if done.returncode:
        skip(f"debootstrap has no bare Debian for us ({(done.stdout + done.stderr).strip().splitlines()[-1]})")


def files(root):
    """All paths of the root that no package manager keeps as its own book."""
    found = set()
    for folder, folders, names in os.walk(root):
        here = folder.removeprefix(str(root))
        folders[:] = [name for name in folders if not BOOKKEEPING.match(f"{here}/{name}")]
        found |= {path for path in (f"{here}/{name}" for name in (*folders, *names)) if not BOOKKEEPING.match(path)}
    return found


def require(condition, what):
    if not condition:
        raise SystemExit(f"failed: {what}")


def last_stage():
    """The commands by which the container gets the package."""
    recipe = (pathlib.Path(__file__).resolve().parents[2] / "Dockerfile").read_text()
    return re.findall(r"^RUN (.*)$", recipe[recipe.rindex("\nFROM "):], re.MULTILINE)


def examine_python(root, package):
    shutil.copy(package, root / "tmp")
    (root / "root/work").mkdir(exist_ok=True)
    e = float(inside(root, PYTHON).splitlines()[-1])
    require(0.5 < e < 1, f"import granulaw: e = {e}")
    require("liggghts" not in inside(root, "dpkg-query -W -f '${Package} '"), "python3-granulaw came with LIGGGHTS")
    say(f"python3-granulaw alone: e = {e}")


def examine(root, package):
    shutil.copy(package, root / "tmp")
    # Recommended packages only, without those that they recommend in turn: half a gigabyte less. dpkg need not
    # survive a power cut here.
    (root / "etc/dpkg/dpkg.cfg.d/unsafe").write_text("force-unsafe-io\n")
    recommended = subprocess.run(["dpkg-deb", "--field", package, "Recommends"], capture_output=True, text=True, check=True).stdout
    for line in last_stage():
        inside(root, line)
    missing = [name for name in recommended.replace(",", " ").split() if not inside(root, f"dpkg-query -W {name}").strip()]
    require(not missing, f"the recipe leaves out {missing}, which the package recommends")
    installed = files(root)
    owned = set(inside(root, "dpkg-query -L granulaw").splitlines())
    say(f"installed by apt with what it needs; {len(owned)} paths of its own")
    require("/usr/bin/mpm" in installed and "/usr/bin/mpm" in owned, "no /usr/bin/mpm")

    told = inside(root, USE)
    require("from the atlas" in inside(root, "mpm table /usr/share/granulaw/examples/hopper/materials.toml -o /tmp/x.h5"), "atlas not found")
    measured = {row["quantity"]: float(row["value"]) for row in csv.DictReader((root / "root/work/flow/hopper.csv").open())}
    require(measured.get("left behind, share") == 0, f"the hopper did not empty: {measured}")
    require(0 < measured.get("plastic share while filling", 0) < 1, f"no contact yielded: {measured}")  # so model mpm was at work
    say("law made and drawn, hopper filled and emptied:\n" + "\n".join(told.splitlines()[:12]))

    inside(root, "apt-get -q -y purge granulaw")
    left = files(root)
    trace = sorted((left - installed) | {path for path in left if "granulaw" in path})
    require(not trace, f"purged, but there is {trace}")
    lost = sorted(installed - left - owned)
    require(not lost, f"the purge took what was not its own: {lost}")
    require("granulaw" not in inside(root, "dpkg-query -W -f '${Package} '"), "dpkg still knows it")
    say("purged: no path of it is left, no other is gone")


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--root", type=pathlib.Path)
    options = options.parse_args()
    if os.geteuid() != 0:
        skip("only root makes a Debian in a folder")
    for tool in ("debootstrap", "unshare"):
        if not shutil.which(tool):
            skip(f"{tool} is not installed")
    packages = sorted(options.folder.glob("granulaw_*.deb"))
    require(len(packages) == 1, f"granulaw_*.deb: {len(packages)} of them in {options.folder}")
    with tempfile.TemporaryDirectory(prefix="bare-debian-") as folder:
        root = (options.root or pathlib.Path(folder) / "root").resolve()
        if not root.exists():
            make_root(root)
            say(f"a bare Debian 12 in {root}")
        for name in ("resolv.conf", "hosts"):
            shutil.copy(f"/etc/{name}", root / "etc" / name)
        examine(root, packages[0])
        inside(root, "apt-get -q -y autoremove --purge")
        for module in options.folder.glob("python3-granulaw_*.deb"):
            examine_python(root, module)


START = time.monotonic()
main()
