"""What is wrong with an installation of Surefoot, told before anything fails for it. Imports nothing of Surefoot."""

import importlib.machinery
import importlib.metadata
import importlib.util
import pathlib
import re
import sys

SITE = pathlib.Path(__file__).parent
PACKAGES = ["surefoot", "surefoot_campaign", "surefoot_log", "surefoot_report"]
LEAST_PYTHON = (3, 11)


def trouble() -> str | None:
    """A sentence that says what to do, or None."""
    return other_python() or two_versions() or missing_packages()


def this_python() -> str:
    return f"Python {sys.version_info.major}.{sys.version_info.minor}"


def other_python() -> str | None:
    if sys.version_info < LEAST_PYTHON:
        return f"this is {this_python()}, and Surefoot needs {'.'.join(map(str, LEAST_PYTHON))} or newer, as MuJoCo does"
    modules = {file.name for file in (SITE / "surefoot").glob("_core.*so")}
    if modules and not modules & {f"_core{suffix}" for suffix in importlib.machinery.EXTENSION_SUFFIXES}:
        return (f"{SITE} has Surefoot for another Python ({', '.join(modules)}), and this is {this_python()}: "
                f"install a wheel for it: `{sys.executable} -m pip install FILE.whl`")  # fmt: skip
    return None


def two_versions() -> str | None:
    """Parts of two installations in one process would not fit each other."""
    places = {name: pathlib.Path(spec.origin).resolve().parents[1] for name in PACKAGES if (spec := importlib.util.find_spec(name)) and spec.origin}
    here = pathlib.Path(__file__).resolve().parent
    for name, place in places.items():
        if place != here:
            return (f"two versions of Surefoot lie side by side: {name}{version_in(place)} comes from {place}, the rest{version_in(here)} from {here}; "
                    "uninstall one, or take its folder out of PYTHONPATH")  # fmt: skip
    return None


def version_in(place: pathlib.Path) -> str:
    found = [one.version for one in importlib.metadata.distributions(name="surefoot", path=[str(place)])]
    return f" {found[0]}" if found else ""


def missing_packages() -> str | None:
    """Those that the wheel asks for, but for its extras; a build tree asks for none."""
    mine = next(iter(importlib.metadata.distributions(name="surefoot", path=[str(SITE)])), None)
    needed = [one for one in (mine.requires or []) if "extra ==" not in one] if mine else []
    for requirement in needed:
        [(name, exact)] = re.findall(r"^([\w-]+)(?:\[.*?\])?\s*(?:==\s*([\w.]+))?", requirement)
        try:
            version = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            return f"the package {name} is missing, which Surefoot needs: `{sys.executable} -m pip install '{requirement}'`"
        if exact and version != exact:
            return (f"the package {name} is version {version}, and this Surefoot was built with {exact}: "
                    f"`{sys.executable} -m pip install '{requirement}'`")  # fmt: skip
    return None


if __name__ == "__main__":
    sys.exit(trouble())
