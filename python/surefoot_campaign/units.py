"""Units of metrics and of the parameters whose last word leaves no doubt; a spec can name others."""

METRIC_ENDINGS = {"_mps": "m/s", "_rad": "rad", "_nm": "N·m", "_us": "µs", "_s": "s", "_m": "m"}
IN_METRES = ["distance_m", "base_height_end_m", "limb_extension_max_m"]  # lengths of the robot's size; others are read in mm
LAST_WORDS = {
    "m": ["height", "edge", "tread", "apex", "half_length", "max_step", "reach_max", "feet_beyond_x", "walk_on"],
    "s": ["duration", "swing_duration", "same_side_duration", "switch_duration", "start_duration", "ramp_up", "ramp_down",
          "period", "timestep", "delay"],
    "kg": ["mass"],
    "rad": ["yaw", "pitch", "roll"],
}  # fmt: skip
PATHS = {"initial.x": "m", "initial.y": "m", "initial.z": "m"}


def ending_of(stem):
    return next((ending for ending in METRIC_ENDINGS if stem.endswith(ending)), "")


def metric_label(name):
    """`com_error_max_m` as "com_error_max [m]"."""
    stem, *member = name.split(".")
    ending = ending_of(stem)
    return label(".".join([stem.removesuffix(ending), *member]), METRIC_ENDINGS.get(ending, ""))


def unit_of_metric(name):
    """The unit that people read a metric in, and its scale. Both are fixed, so that runs compare."""
    stem = name.split(".")[0]
    unit = METRIC_ENDINGS.get(ending_of(stem), "")
    return ("mm", 1e3) if unit == "m" and stem not in IN_METRES else (unit, 1.0)


def unit_of_parameter(name, spec):
    if name in spec.units:
        return spec.units[name]
    if name in PATHS:
        return PATHS[name]
    if ".force." in name:
        return "N"
    last = name.split(".")[-1]
    return next((unit for unit, words in LAST_WORDS.items() if last in words), "")


def label(name, unit):
    return f"{name} [{unit}]" if unit else name
