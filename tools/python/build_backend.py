"""What pip calls (PEP 517): CMake builds the module, which becomes a wheel."""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
OFF = ("BUILD_PLUGIN", "MPI", "BUILD_TESTS", "BUILD_BENCHMARKS")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = re.search(r"project\(granulaw VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"granulaw-{version}.dist-info"
    with tempfile.TemporaryDirectory() as build:
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DGRANULAW_PYTHON={sys.executable}",
                        *(f"-DGRANULAW_{name}=OFF" for name in OFF)], check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", "granulaw_python"], check=True)
        made = pathlib.Path(build) / "tools/python/granulaw"
        files = {f"granulaw/{file.name}": file.read_bytes() for file in sorted(made.iterdir()) if file.is_file()}
    files[f"{info}/METADATA"] = f"Metadata-Version: 2.1\nName: granulaw\nVersion: {version}\nRequires-Dist: numpy\n".encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: granulaw\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = "".join(f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip('=')},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"granulaw-{version}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return wheel
