"""Shows whether two builds command the same torques: the check for a change of structure.

    python3 tools/behaviour.py record before.json          # a few minutes: every scenario that ships
    python3 tools/behaviour.py compare before.json         # after the change: runs again, tells what differs

Each scenario runs with seeds 0 to 3, as modelled and with the mismatch of randomisations/mismatch.yaml. Kept of each run: the hash
of all its torques, and every metric that the machine's clock does not decide. Both need the same processor, as kernels
are chosen by what it can do. Names behind the file choose scenarios; `--program` names another program than
bin/surefoot. Exit code 1: something differs.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).parent.parent
SEEDS = range(4)
VARIANTS = {"as modelled": [], "mismatch": ["--set", "randomise.include=mismatch"]}
BY_CLOCK = {"tick_us", "solve_us", "realtime_factor"}
NOT_BEHAVIOUR = {"robot", "version", "commit", "sources_hash", "notes"}


def output(program, *arguments):
    done = subprocess.run([program, *arguments], stdout=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1, 3, 4):  # runs that miss their criteria, or are too short for them
        sys.exit(f"{program} {' '.join(arguments)} ended with exit code {done.returncode}")
    return done.stdout


def scenarios(program):
    return [line.split()[0] for line in output(program, "list", "scenarios").splitlines() if line.strip()]


def behaviour(run):
    """What must not change of a run."""
    return {key: value for key, value in run.items() if key not in BY_CLOCK | NOT_BEHAVIOUR}


def run(program, job):
    scenario, variant, seed = job
    print(f"{scenario}, {variant}, seed {seed}", file=sys.stderr, flush=True)
    return behaviour(json.loads(output(program, "run", scenario, "--seed", str(seed), "--json", *VARIANTS[variant])))


def record(program, names):
    """What must not change of each run, by scenario, variant and seed."""
    jobs = [(name, variant, seed) for name in names for variant in VARIANTS for seed in SEEDS]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = pool.map(lambda job: run(program, job), jobs)
        return {", ".join(map(str, job)): found for job, found in zip(jobs, runs)}


def differences(before, after):
    """A line for each run that differs: the keys that do."""
    for name, new in after.items():
        old = before[name]
        changed = sorted(key for key in old.keys() | new.keys() if old.get(key) != new.get(key))
        if changed:
            yield f"{name}: {', '.join(changed)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["record", "compare"])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("names", nargs="*", help="scenarios; default: all that ship, or all of the file")
    parser.add_argument("--program", default=str(ROOT / "bin/surefoot"))
    arguments = parser.parse_args()

    if arguments.what == "record":
        table = record(arguments.program, arguments.names or scenarios(arguments.program))
        arguments.file.write_text(json.dumps(table, indent=1))
        print(f"{len(table)} runs recorded in {arguments.file}")
        return 0
    before = json.loads(arguments.file.read_text())
    recorded = dict.fromkeys(name.rsplit(", ", 2)[0] for name in before)
    after = record(arguments.program, arguments.names or recorded)
    lines = list(differences(before, after))
    print("\n".join(lines + [f"{len(lines)} of {len(after)} runs differ"]))
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
