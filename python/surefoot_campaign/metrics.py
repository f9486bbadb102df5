"""What each metric is, as the program declares it: one name, one unit, one sense everywhere."""

import functools
import json

ARROWS = {"smaller": "↓", "larger": "↑"}
KEY = "↓ smaller is better, ↑ larger; `surefoot list metrics` says what each is"


@functools.cache
def declared():
    """Of each metric the `unit` that people read and the `scale` to it, which way is `better`, whether it is among the `first`, `help`."""
    from surefoot_log.log_file import program

    return json.loads(program("list", "metrics", "--json")[0])


def about(name):
    """Of a metric, or of a member like `tick_us.p99`; {} if there is none of that name."""
    return declared().get(name.split(".")[0], {})


def unit_of(name):
    """Unit and scale."""
    known = about(name)
    return known.get("unit", ""), known.get("scale", 1.0)


def arrow(name):
    return ARROWS.get(about(name).get("better"), "")


def is_first(name):
    return about(name).get("first", False)
