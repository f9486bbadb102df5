"""Breaks the product on purpose, one fault of tools/faults.toml after the other, and tells which tests notice.

    python3 tools/faults.py                   # all of them, some ten minutes
    python3 tools/faults.py friction_cone     # some
    python3 tools/faults.py --list

Works on a copy of the tree in build/faults, with a build folder of its own. Exit code 1: a fault that no test noticed.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
COPY = ROOT / "build/faults"
BUILD = COPY / "build/release"  # and .venv beside it, as in any tree: so ccache knows its objects
TEST_TIMEOUT = 120  # of a test that a fault lets hang [s]


def read_faults(names):
    """The faults with these names, or all; each is one text of one file."""
    faults = tomllib.loads((ROOT / "tools/faults.toml").read_text())
    for name in names:
        if name not in faults:
            sys.exit(f"unknown fault {name}; there are: {' '.join(faults)}")
    for name, fault in faults.items():
        count = (ROOT / fault["file"]).read_text().count(fault["text"])
        if count != 1:
            sys.exit(f"{name}: its text occurs {count} times in {fault['file']}, not once: {fault['text']}")
    return {name: fault for name, fault in faults.items() if not names or name in names}


def files_of_tree():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, stdout=subprocess.PIPE,
                            text=True, check=True).stdout.splitlines()
    return {name for name in listed if (ROOT / name).is_file()}


def copy_tree():
    """Brings the copy up to date; files that are the same keep their time."""
    names = files_of_tree()
    for path in COPY.rglob("*"):
        name = path.relative_to(COPY)
        if path.is_file() and name.parts[0] not in {".venv", "build"} and str(name) not in names:
            path.unlink()
    for name in names:
        to, content = COPY / name, (ROOT / name).read_bytes()
        if to.is_file() and to.read_bytes() == content:
            continue
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_bytes(content)
        to.chmod((ROOT / name).stat().st_mode)


def configure():
    if not (COPY / ".venv").is_symlink():
        (COPY / ".venv").symlink_to(ROOT / ".venv")
    subprocess.run(["cmake", "--preset", "release", "-S", COPY], stdout=subprocess.DEVNULL, check=True)


def failing_tests(tests, jobs):
    """Builds these tests' programs, runs them until one fails and names it; None if something does not compile."""
    folders = sorted({test.split("/")[0] for test in tests})
    built = subprocess.run(["ninja", f"-j{jobs}", "-C", BUILD, *(f"test_{folder}" for folder in folders)],
                           stdout=subprocess.PIPE, text=True)
    if built.returncode != 0:
        print(built.stdout, file=sys.stderr)
        return None
    ran = subprocess.run(["ctest", "--test-dir", BUILD, "-R", f"^({'|'.join(tests)})", f"-j{jobs}", "--stop-on-failure",
                          "--no-tests=error", "--timeout", str(TEST_TIMEOUT)],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    failed = re.findall(r"^\s+\d+ - (\S+) \(", ran.stdout, re.MULTILINE)
    if ran.returncode != 0 and not failed:
        sys.exit(ran.stdout)
    return failed


def check_unbroken(faults, jobs):
    failed = failing_tests(sorted({test for fault in faults.values() for test in fault["tests"]}), jobs)
    if failed is None or failed:
        sys.exit(f"The tests must pass before anything is broken: {failed or 'they do not compile'}")


def is_caught(name, fault, jobs):
    """Breaks the copy, tests it, mends it; says what happened."""
    path = COPY / fault["file"]
    whole = path.read_text()
    path.write_text(whole.replace(fault["text"], fault["becomes"]))
    try:
        failed = failing_tests(fault["tests"], jobs)
    finally:
        path.write_text(whole)
    if failed is None:
        result = "DOES NOT COMPILE"
    elif not failed:
        result = "NOT CAUGHT"
    else:
        result = f"caught by {', '.join(failed)}"
    print(f"{name:20} {result}", flush=True)
    return bool(failed)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--list", action="store_true", help="only tells what the faults are")
    parser.add_argument("--no-check", action="store_true", help="does not run the tests of the tree as it is first")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    chosen = parser.parse_args()
    faults = read_faults(chosen.names)
    if chosen.list:
        for name, fault in faults.items():
            print(f"{name:20} {fault['is']} ({', '.join(fault['tests'])})")
        return 0
    copy_tree()
    configure()
    if not chosen.no_check:
        check_unbroken(faults, chosen.jobs)
    caught = [is_caught(name, fault, chosen.jobs) for name, fault in faults.items()]
    print(f"{sum(caught)} of {len(caught)} faults caught")
    return 0 if all(caught) else 1


if __name__ == "__main__":
    sys.exit(main())
