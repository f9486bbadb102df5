"""Units of metrics and of the parameters whose last word leaves no doubt; a spec can name others."""

METRIC_ENDINGS = {"_mps": "m/s", "_rad": "rad", "_nm": "N·m", "_us": "µs", "_s": "s", "_m": "m"}
IN_METRES = ["distance_m", "base_height_end_m", "limb_extension_max_m"]  # the robot's own size and more; others are errors and the like
LAST_WORDS = {
    "m": ["height", "edge", "tread", "apex", "half_length", "max_step", "reach_max", "feet_beyond_x", "walk_on"],
    "s": ["duration", "swing_duration", "same_side_duration", "switch_duration", "start_duration", "ramp_up", "ramp_down",
          "period", "timestep", "delay"],
    "kg": ["mass"],
    "rad": ["yaw", "pitch", "roll"],
}  # fmt: skip
PATHS = {"initial.x": "m", "initial.y": "m", "initial.z": "m"}


def metric_label(name):
    """`com_error_max_m` as "com_error_max [m]"."""
    head, *member = name.split(".")
    for ending, unit in METRIC_ENDINGS.items():
        if head.endswith(ending):
            return label(".".join([head.removesuffix(ending), *member]), unit)
    return name


def unit_of_metric(name):
    """As people read it, and its scale: always the same of a metric, so that two runs compare."""
    stem = name.split(".")[0]
    unit = next((unit for ending, unit in METRIC_ENDINGS.items() if stem.endswith(ending)), "")
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
