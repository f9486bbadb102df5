"""Numbers as the report writes them."""

import math

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def decimal(value, decimals):
    """At most so many decimals, without trailing zeros, with a true minus sign."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{abs(value):.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return f"−{text}" if value < 0 and text != "0" else text


def two_digits(value):
    """For values from 0 on: "42", "0.42", "1.3·10⁻⁴"."""
    power = math.floor(math.log10(value)) if value > 0 else 0
    if power >= -2:
        return decimal(value, max(0, 1 - power))
    return f"{decimal(value / 10**power, 1)}·10{str(power).translate(SUPERSCRIPTS)}"


def with_unit(text, unit):
    return f"{text} {unit}" if unit else text


def counted(count, noun):
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
