"""Random draws that depend on a seed and a name alone: those of a scenario's `randomise:` (math/random_bits.hpp)."""

MASK = (1 << 64) - 1
GOLDEN_STEP = 0x9E3779B97F4A7C15


def mixed_bits(value):
    """The output function of splitmix64."""
    value = ((value ^ (value >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    value = ((value ^ (value >> 27)) * 0x94D049BB133111EB) & MASK
    return value ^ (value >> 31)


def uniform_of(seed, name):
    """A number in [0, 1)."""
    fnv = 0xCBF29CE484222325
    for byte in name.encode():
        fnv = ((fnv ^ byte) * 0x100000001B3) & MASK
    bits = mixed_bits(mixed_bits((seed + GOLDEN_STEP) & MASK) ^ fnv)
    return (bits >> 11) * 2.0**-53


def draw(seed, name, lower, upper):
    return lower + (upper - lower) * uniform_of(seed, name)
