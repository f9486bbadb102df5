"""Wheels of this tree: which Pythons they are for, which of these this machine has, and how one is built.

`wheels.py FOLDER` builds one for each Python that is found, and says which are not. From Python 3.12 on, the stable ABI
holds, and one wheel does for all. The libraries that the program is linked with are .venv's for every Python, so that
ccache has every object but the module's.
"""

import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
VERSIONS = ["3.11", "3.12", "3.13"]
STABLE_ABI_SINCE = (3, 12)
# What pip would fetch into an environment of its own for the build; Debian 12's CMake is too old for the stable ABI;
# one much newer orders the compiler's arguments differently, and ccache would know nothing.
TOOLS = r"^(?:nanobind|scikit-build-core|pathspec|packaging|numpy)==.*"
CMAKE = "cmake==3.26.4"


def run(*command, **options):
    subprocess.run([*map(str, command)], check=True, **options)


def is_version(python, version):
    """Whether it starts, and can make environments."""
    code = f"import sys, venv, ensurepip; sys.exit('%d.%d' % sys.version_info[:2] != '{version}')"
    return subprocess.run([python, "-c", code], capture_output=True).returncode == 0


def find(version):
    """The interpreter of a version: .venv's, one on the PATH, or one that pyenv has; None without."""
    candidates = [ROOT / ".venv/bin/python", shutil.which(f"python{version}")]
    if shutil.which("pyenv"):
        folder = pathlib.Path(subprocess.run(["pyenv", "root"], capture_output=True, text=True, check=True).stdout.strip())
        candidates += sorted(folder.glob(f"versions/{version}.*/bin/python"))
    return next((path for path in map(str, filter(None, candidates)) if is_version(path, version)), None)


def found():
    """Versions with their interpreters, and the versions that this machine lacks."""
    pythons = {version: find(version) for version in VERSIONS}
    return {version: path for version, path in pythons.items() if path}, [version for version, path in pythons.items() if not path]


def tag(version):
    numbers = tuple(map(int, version.split(".")))
    return "cp312-abi3" if numbers >= STABLE_ABI_SINCE else f"cp{numbers[0]}{numbers[1]}-cp{numbers[0]}{numbers[1]}"


def builder(version, python):
    """An interpreter with what builds: .venv's has it, another gets an environment in build/."""
    if pathlib.Path(python).parent == ROOT / ".venv/bin":
        return python
    environment = ROOT / f"build/wheel-python{version}"
    wanted = [*re.findall(TOOLS, (ROOT / "dependencies/python.txt").read_text(), re.MULTILINE), CMAKE]
    stamp = environment / "wanted.txt"
    if not stamp.exists() or stamp.read_text().split() != wanted:
        run(python, "-m", "venv", "--clear", environment)
        run(environment / "bin/python", "-m", "pip", "install", "-q", "--no-deps", *wanted)
        stamp.write_text("\n".join(wanted))
    return str(environment / "bin/python")


def made(python, folder, **settings):
    """The wheel that scikit-build-core makes."""
    # As the tree's own build, for ccache.
    environment = os.environ | {"CC": "/usr/bin/cc", "CXX": "/usr/bin/c++", "PATH": f"{pathlib.Path(python).parent}:{os.environ['PATH']}"}
    settings = {"cmake.define.SUREFOOT_WARNINGS_AS_ERRORS": "ON", "cmake.define.SUREFOOT_PYTHON": ROOT / ".venv/bin/python", **settings}
    run(python, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "--wheel-dir", folder,
        *(f"--config-settings={name}={value}" for name, value in settings.items()), ".", cwd=ROOT, env=environment)  # fmt: skip
    [wheel] = pathlib.Path(folder).glob("surefoot-*.whl")
    return wheel


def manylinux(wheel):
    """The platform tag by the newest glibc that its programs and libraries ask for: pip then refuses it where the libc is older."""
    with zipfile.ZipFile(wheel) as archive, tempfile.TemporaryDirectory() as folder:
        files = [archive.extract(name, folder) for name in archive.namelist() if archive.open(name).read(4) == b"\x7fELF"]
        asked = subprocess.run(["readelf", "--version-info", *files], capture_output=True, text=True, check=True).stdout
    return f"manylinux_2_{max(map(int, re.findall(r'GLIBC_2[.]([0-9]+)', asked)))}_{platform.machine()}"


def build(version, python, folder):
    """The wheel for a version, built unless the folder has it: once to learn which glibc it asks for, and packed again with that tag."""
    folder = pathlib.Path(folder)
    if there := [*folder.glob(f"surefoot-*-{tag(version)}-manylinux_*.whl")]:
        return there[0]
    python = builder(version, python)
    with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
        wheel = made(python, second, **{"wheel.tags": f"{tag(version)}-{manylinux(made(python, first))}"})
        folder.mkdir(parents=True, exist_ok=True)
        return pathlib.Path(shutil.move(wheel, folder))


def main(folder):
    pythons, missing = found()
    for version, python in pythons.items():
        print(version, python, build(version, python, folder))
    if missing:
        print(f"wheels: no Python {', '.join(missing)} here (on the PATH, or by pyenv), so nothing was tried with it", file=sys.stderr)


if __name__ == "__main__":
    main(*sys.argv[1:])
