#!/usr/bin/env -S python3 -I -S
"""Stands for the program: answers `run SCENARIO --seed N --set key=value … --json [--check]` at once, also with `--option=value`.

`mode` says what it does: walk, crash, abort, hang, interrupted, babble, refuse or slow. Every run is noted in $FAKE_LOG.
"""

import hashlib
import json
import os
import pathlib
import signal
import sys
import time

KEYS = ["height", "mass", "mode", "gait", "broken_seed", "noted"]
METRICS = {
    "com_error_max_m": {"worst": "greatest", "by_clock": False, "unit": "mm", "scale": 1000, "better": "smaller", "first": True, "help": "COM"},
    "speed_mps": {"worst": "least", "by_clock": False, "unit": "m/s", "scale": 1, "better": "larger", "first": True, "help": "speed"},
    "tick_us.median": {"worst": "greatest", "by_clock": True, "unit": "µs", "scale": 1, "better": "smaller", "first": True, "help": "time"},
}


def refuse(message):
    sys.exit(print(f"surefoot: {message}", file=sys.stderr) or 2)


def main(words):
    if words[:2] == ["list", "metrics"]:
        return print(json.dumps({name.removesuffix(".median"): about for name, about in METRICS.items()})) or 0
    if words[0] != "run":
        refuse(f'unknown command "{words[0]}"')
    scenario, words = words[1], [part for word in words[2:] for part in (word.split("=", 1) if word.startswith("--") else [word])]
    seed, parameters, flags = 0, {}, []
    while words:
        word = words.pop(0)
        if word == "--seed":
            seed = int(words.pop(0))
        elif word == "--set":
            while words and not words[0].startswith("--"):
                key, value = words.pop(0).split("=", 1)
                if key not in KEYS:
                    refuse(f"--set {key}={value}: {key}: unknown key; valid are: {', '.join(KEYS)}")
                parameters[key] = value
        else:
            flags.append(word)
    if scenario not in ("fake", "other") and not pathlib.Path(scenario).is_file():
        refuse(f'unknown scenario "{scenario}"; valid are: fake, other')
    text = pathlib.Path(scenario).read_text() if scenario.endswith(".yaml") else scenario
    sources_hash = hashlib.sha256(text.encode()).hexdigest()[:16]
    if "--check" in flags:
        if float(parameters.get("mass", 0)) < 0:
            refuse(f"--set mass={parameters['mass']}: mass: \"{parameters['mass']}\" is not a number of at least 0")
        print(json.dumps({"version": "1", "commit": "abc", "sources_hash": sources_hash, "metrics": METRICS, "notes": ["a note"] if "noted" in parameters else [],
                          "scenario": "fake", "robot": "fake", "stack": "walk", "estimation": "truth", "foot_force_sensor": False, "description": "a fake",
                          "has_goal": False, "success_rate": 1.0, "paper": {"com_error_max_m": "≤ 3.4 mm"}}))  # fmt: skip
        return 0
    if log := os.environ.get("FAKE_LOG"):
        with open(log, "a") as file:
            file.write(json.dumps([scenario, seed, parameters]) + "\n")
    broken = "broken_seed" not in parameters or int(parameters["broken_seed"]) == seed
    mode = parameters.get("mode", "walk") if broken else "walk"
    if mode == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    if mode == "abort":
        print("assertion failed", file=sys.stderr)
        os.abort()
    if mode == "interrupted":
        refuse("interrupted: no results")
    if mode == "refuse":
        refuse("period: 0.3 s is not a whole multiple of the timestep")
    if mode == "hang":
        child = os.spawnlp(os.P_NOWAIT, "sleep", "sleep", "1000")
        pathlib.Path(os.environ["FAKE_LOG"]).with_name("pids").write_text(f"{os.getpid()} {child}")
        time.sleep(1000)
    if mode == "babble":
        print("no JSON")
        return 0
    if mode == "slow":
        time.sleep(0.15)
    height, mass = float(parameters.get("height", 0.1)), float(parameters.get("mass", 0))
    chance = int(hashlib.sha256(f"{seed} {height} {mass}".encode()).hexdigest()[:8], 16) / 2**32
    succeeded = chance < 1.05 - 2.2 * abs(height) - 0.05 * mass
    error = (0.002 + abs(height) * 0.03 + 0.0005 * mass) * (1 + 0.3 * chance)
    result = {
        "scenario": "fake", "succeeded": succeeded, "reason": "goal reached" if succeeded else "fell", "fell": not succeeded,
        "goal_reached": None, "com_error_max_m": error, "speed_mps": 0.1, "tick_us": {"median": time.monotonic()},
        "seed": seed, "version": "1", "criteria": [{"metric": "fell", "passed": succeeded}], "drawn": {"friction": 0.5},
        "sources_hash": sources_hash, "notes": ["a note"] if "noted" in parameters else [],
    }  # fmt: skip
    if "noted" in parameters:
        print("surefoot: warning: a note\nsurefoot: warning: x.mp4 was not filmed", file=sys.stderr)
    print(json.dumps(result))
    return 0 if succeeded else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
