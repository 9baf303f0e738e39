"""Machine and programs with which the page was made."""
import platform
import re
import subprocess
import sys

import h5py
import matplotlib
import numpy


def _output(words, folder=None):
    """First line of what a command prints; None where it cannot be run."""
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.strip().splitlines()[0] if done.returncode == 0 and done.stdout.strip() else None


def commit(root):
    found = _output(["git", "rev-parse", "--short=12", "HEAD"], root)
    if not found:
        return "unknown (no git here)"
    return found + (", with changes that are not committed" if _output(["git", "status", "--porcelain", "-uno"], root) else "")


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            names = re.findall(r"^model name\s*: (.+)$", file.read(), re.M)
        return f"{names[0]}, {len(names)} cores"
    except (OSError, IndexError):
        return platform.processor() or "unknown"


def memory():
    try:
        with open("/proc/meminfo") as file:
            kib = int(re.search(r"MemTotal:\s*(\d+)", file.read())[1])
        return f"{kib / 2**20:.1f} GiB"
    except (OSError, TypeError):
        return "unknown"


def system():
    try:
        with open("/etc/os-release") as file:
            name = re.search(r'^PRETTY_NAME="?([^"\n]+)', file.read(), re.M)[1]
    except (OSError, TypeError):
        name = platform.system()
    return f"{name}, kernel {platform.release()}"


def liggghts(decks):
    """As the runs' own logs name it."""
    for deck in decks:
        for folders in deck.folders.values():
            for folder in folders:
                try:
                    with open(folder / "log", errors="replace") as file:
                        found = re.match(r"LIGGGHTS \(Version ([^,)]+)", file.readline())
                except OSError:
                    continue
                if found:
                    return found[1]
    return "no run here names it"


def write(page, root, mpm, decks):
    page.table(["what", "found when this page was written"], [
        ["processor", processor()], ["memory", memory()], ["system", system()], ["tree", f"commit {commit(root)}"],
        ["mpm", _output([str(mpm) if mpm.exists() else "mpm", "--version"]) or f"neither on the PATH nor built ({mpm})"], ["LIGGGHTS, of the runs", liggghts(decks)],
        ["page", f"Python {sys.version.split()[0]}, numpy {numpy.__version__}, matplotlib {matplotlib.__version__}, h5py {h5py.__version__}"]])
    page.text("Each part names the files it is from, and what these say of the commit and the machine that made them. Wall-clock is of a machine "
              "that may have had other work; CPU seconds depend on that less.")
