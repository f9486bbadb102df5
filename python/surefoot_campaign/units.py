"""Units of the parameters whose last word leaves no doubt; a spec can name others."""

from surefoot_campaign.metrics import unit_of

LAST_WORDS = {
    "m": ["height", "edge", "tread", "apex", "half_length", "max_step", "reach_max", "feet_beyond_x", "walk_on"],
    "s": ["duration", "swing_duration", "same_side_duration", "switch_duration", "start_duration", "ramp_up", "ramp_down",
          "period", "timestep", "delay"],
    "kg": ["mass"],
    "rad": ["yaw", "pitch", "roll"],
}  # fmt: skip
PATHS = {"initial.x": "m", "initial.y": "m", "initial.z": "m"}


def metric_label(name):
    """`com_error_max_m` as "com_error_max_m [mm]", as it is drawn."""
    return label(name, unit_of(name)[0])


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
