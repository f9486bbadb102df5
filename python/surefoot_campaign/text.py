"""Names, metrics and tables as people read them."""

import html
import re

from surefoot_campaign.metrics import unit_of

CONTROL = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f]")


def printable(text):
    """Control characters, which names may hold, are escaped as in JSON (base/printable.hpp)."""
    return CONTROL.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def escape(text):
    """For HTML: <, >, & and quotes made harmless."""
    return html.escape(str(text)).replace("&#x27;", "'")


def in_words(name):
    return name.replace("_", " ")


def aligned(rows):
    """Columns, each as wide as its widest cell; short rows end early."""
    widths = {}
    for row in rows:
        widths |= {column: max(widths.get(column, 0), len(cell)) for column, cell in enumerate(row)}
    return "".join("   ".join(cell.ljust(widths[column]) for column, cell in enumerate(row)).rstrip() + "\n" for row in rows)


def rounded(value):
    return f"{value:.0f}" if abs(value) >= 100 else f"{value if abs(value) >= 1e-12 else 0.0:.3g}"


def with_unit(metric, value):
    unit, scale = unit_of(metric)
    return f"{rounded(scale * value)}{'' if unit.startswith('°') else ' '}{unit}".rstrip()


def pretty(metric, value):
    """ "0.12 mm", "yes", "–"."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        median, p99, most = (value.get(member) for member in ("median", "p99", "max"))
        return "–" if median is None else f"median {with_unit(metric, median)}" + (f", 99 % {with_unit(metric, p99)}, max {with_unit(metric, most)}" if p99 else "")
    if isinstance(value, str) or (isinstance(value, int) and not unit_of(metric)[0]):
        return str(value)
    return with_unit(metric, value)


def asked(criterion):
    """What a criterion asks for, and whether it holds: "≤ 0.5 mm ✓", "≤ 0.5 mm, not judged"."""
    limits = [f"{sign} {with_unit(criterion['metric'], criterion[key])}" for sign, key in (("≥", "min"), ("≤", "max")) if key in criterion]
    wanted = pretty("", criterion["equals"]) if "equals" in criterion else ", ".join(limits)
    return wanted + {True: " ✓", False: " ✗"}.get(criterion["passed"], ", not judged")


def asked_of(run, metric):
    """The same of a run's metric or of one of its members; empty if nothing is asked."""
    for criterion in run["criteria"]:
        name, _, member = criterion["metric"].partition(".")
        if name == metric:
            return f"{member} {asked(criterion)}".lstrip()
    return ""


def rate_text(rate):
    if not rate["trials"]:
        return "not judged"
    low, high = rate["interval"]
    return f"{rate['successes']} of {rate['trials']} (95 %: {100 * low:.0f} … {100 * high:.0f} %)"
