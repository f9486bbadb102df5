#!/usr/bin/env python3
"""Follows the Containerfile without a container engine: a stage is a folder that debootstrap fills, its lines are done there.

  tools/try_container.py [FOLDER] [-- WORDS...]    build/container by default; WORDS instead of the container's own (`demo`)

A line that was done is not done again. Needs root, debootstrap, 6 GB of disk and the network (Debian's mirror and Python's
registry). Two idle cores take half an hour.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SUITES = {"debian:12-slim": "bookworm", "debian:13-slim": "trixie"}
# Mounts vanish with their namespace; names and certificates are this machine's.
IN_CHROOT = """
set -e
mount -t proc proc "$1/proc"
mount --rbind /dev "$1/dev"
touch "$1/etc/resolv.conf" "$1/certificates.crt"
mount --bind "$(realpath /etc/resolv.conf)" "$1/etc/resolv.conf"
mount --bind "$(realpath /etc/ssl/certs/ca-certificates.crt)" "$1/certificates.crt"
exec chroot "$1" env -i -C "$2" HOME=/root DEBIAN_FRONTEND=noninteractive {certificates} "${@:3}"
""".replace("{certificates}", " ".join(f"{name}=/certificates.crt" for name in ("SSL_CERT_FILE", "PIP_CERT", "NODE_EXTRA_CA_CERTS")))


def run(*command):
    subprocess.run([*map(str, command)], check=True, stdout=sys.stderr)


class Stage:
    """A folder as a root, what is set in it, and how many of its lines were done."""

    def __init__(self, folder, image):
        self.root, self.done_file, self.lines = folder / "root", folder / "done.txt", 0
        self.variables, self.place = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}, "/"
        self.entry, self.words = [], []
        if not self.done_file.exists():
            shutil.rmtree(folder, ignore_errors=True)
            self.root.mkdir(parents=True)
            run("debootstrap", "--variant=minbase", SUITES[image], self.root)
            self.done_file.write_text("0")

    def execute(self, words):
        """In the stage's root; replaces nothing of this process."""
        set_to = [f"{name}={value}" for name, value in self.variables.items()]
        command = ["unshare", "--mount", "bash", "-c", IN_CHROOT, "bash", self.root, self.place, *set_to, *words]
        subprocess.run([*map(str, command)], check=True)

    def once(self, action):
        self.lines += 1
        if self.lines > int(self.done_file.read_text()):
            action()
            self.done_file.write_text(str(self.lines))


def instructions(text):
    """Pairs of an instruction and the rest of its line."""
    for line in re.sub(r"\\\n", " ", text).splitlines():
        if line.strip() and not line.startswith("#"):
            yield line.split(maxsplit=1)


def committed(pattern, target):
    """A COPY from the tree: the files of the last commit, which is what a fresh clone has."""
    files = subprocess.run(["git", "-C", ROOT, "archive", "HEAD", *([] if pattern == "." else [pattern])], check=True, capture_output=True).stdout
    target.mkdir(parents=True, exist_ok=True)
    strip = [] if pattern == "." else [f"--strip-components={pattern.count('/')}"]
    subprocess.run(["tar", "-x", "-C", target, *strip], input=files, check=True)


def copy(stages, stage, words):
    *options, source, target = words
    place = stage.root / target.lstrip("/")
    if options:
        [other] = options
        run("cp", "-a", stages[other.removeprefix("--from=")].root / source.lstrip("/"), place.parent if place.exists() else place)
    else:
        committed(source, place)


def build(folder):
    """The last stage, with all lines done."""
    stages, stage = {}, None
    for number, (instruction, rest) in enumerate(instructions((ROOT / "Containerfile").read_text())):
        print(f"try_container: {instruction} {rest}", file=sys.stderr, flush=True)
        if instruction == "FROM":
            image, *name = re.split(r" AS ", rest)
            stage = stages[name[0] if name else "last"] = Stage(folder / f"stage{number}", image)
        elif instruction == "RUN":
            stage.once(lambda rest=rest: stage.execute(["/bin/sh", "-c", rest]))
        elif instruction == "COPY":
            stage.once(lambda rest=rest: copy(stages, stage, shlex.split(rest)))
        elif instruction == "ENV":
            name, value = rest.split("=", 1)
            stage.variables[name] = value.replace("$PATH", stage.variables["PATH"])
        elif instruction == "WORKDIR":
            stage.place = rest
            (stage.root / rest.lstrip("/")).mkdir(parents=True, exist_ok=True)
        elif instruction == "ENTRYPOINT":
            stage.entry = json.loads(rest)
        elif instruction == "CMD":
            stage.words = json.loads(rest)
        else:
            sys.exit(f"try_container: {instruction} is not known here; teach tools/try_container.py")
    return stage


def main(arguments):
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        sys.exit("try_container: needs root and debootstrap (`apt-get install debootstrap`)")
    words = arguments[arguments.index("--") + 1 :] if "--" in arguments else []
    folders = arguments[: arguments.index("--")] if "--" in arguments else arguments
    stage = build(pathlib.Path(folders[0] if folders else ROOT / "build/container").resolve())
    stage.execute([*stage.entry, *(words or stage.words)])


if __name__ == "__main__":
    main(sys.argv[1:])
