"""Importing this makes a script end with one sentence and exit code 1 where Python would print a traceback.

Import it before numpy and the like, so that a missing one is named in a sentence, too. GRANULAW_TRACEBACK=1 keeps Python's traceback."""
import os
import pathlib
import subprocess
import sys
import traceback

PACKAGES = {"PIL": "python3-pil", "mpl_toolkits": "python3-matplotlib"}  # Debian's names where they are not python3-MODULE


def sentence(kind, error, trace):
    if isinstance(error, ModuleNotFoundError) and error.name:
        module = error.name.split(".")[0]
        return f"{sys.executable} has no module '{module}': use /usr/bin/python3 and install {PACKAGES.get(module, 'python3-' + module)}"
    if isinstance(error, KeyboardInterrupt):
        return "interrupted"
    if isinstance(error, MemoryError):
        return "not enough memory"
    if isinstance(error, subprocess.CalledProcessError):
        words = error.cmd if isinstance(error.cmd, str) else " ".join(map(str, error.cmd))
        last = [line for line in str(error.stderr or error.stdout or "").splitlines() if line.strip()][-1:]
        return f"`{words}` failed ({error.returncode})" + "".join(f": {line.strip()}" for line in last)
    if isinstance(error, OSError) and (error.strerror or error.filename):
        return ": ".join(str(part) for part in (error.filename, error.strerror) if part)
    if isinstance(error, OSError) and str(error):  # of h5py and PIL
        return str(error).splitlines()[0]
    place = traceback.extract_tb(trace)[-1]
    text = (str(error).splitlines() or ["no text"])[0]
    return f"unexpected {kind.__name__} in {pathlib.Path(place.filename).name}, line {place.lineno}: {text} (GRANULAW_TRACEBACK=1 shows the whole)"


def hook(kind, error, trace):
    print(f"{pathlib.Path(sys.argv[0] or 'python').name}: {sentence(kind, error, trace)}", file=sys.stderr)


if not os.environ.get("GRANULAW_TRACEBACK"):
    sys.excepthook = hook
