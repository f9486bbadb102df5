"""Prints the URDF of a robot, legs on a long torso. Without arguments the hexapod, robots/hexapod.urdf: six legs of three hinges.
tools/hexapod.py > robots/hexapod.urdf
tools/hexapod.py --legs 4 --further YAW TOE > quadruped.urdf    # YAW about z ahead of the HAA, TOE about y behind the KFE
tools/hexapod.py --further TOE --of H > hexapod.urdf    # of the hind legs alone; F: front, M: middle"""

import argparse

LENGTH, WIDTH, HEIGHT = 1.2, 0.24, 0.14  # m, of the torso
TORSO, HIP, THIGH, SHANK, FOOT = 22.0, 1.2, 1.8, 0.35, 0.08  # kg
SEGMENT = 0.28  # m, of thigh and shank
TOE = 0.1  # m, of it above the foot
RADIUS = 0.03  # m, of the foot
PAIRS = {6: {"F": 0.5, "M": 0.0, "H": -0.5}, 4: {"F": 0.36, "H": -0.36}}  # m, hips ahead of the torso's centre, by number of legs
EFFORT, SPEED = 60.0, 12.0  # N·m, rad/s


def inertial(mass, size, z=0.0):
    """Of a box."""
    a, b, c = (side * side for side in size)
    return (f'<inertial><origin xyz="0 0 {z}"/><mass value="{mass}"/><inertia ixx="{mass * (b + c) / 12:.4g}" iyy="{mass * (a + c) / 12:.4g}" '
            f'izz="{mass * (a + b) / 12:.4g}" ixy="0" ixz="0" iyz="0"/></inertial>')


def shape(geometry, z=0.0):
    place = f'<origin xyz="0 0 {z}"/><geometry>{geometry}</geometry>'
    return f"<visual>{place}</visual><collision>{place}</collision>"


def link(name, *parts):
    return [f'  <link name="{name}">', *(f"    {part}" for part in parts), "  </link>"]


def joint(name, parent, child, xyz, axis=None, limit=0.0):
    hinge = f'<axis xyz="{axis}"/><limit lower="{-limit}" upper="{limit}" effort="{EFFORT}" velocity="{SPEED}"/>' if axis else ""
    return [f'  <joint name="{name}" type="{"revolute" if axis else "fixed"}"><parent link="{parent}"/><child link="{child}"/>'
            f'<origin xyz="{xyz}"/>{hinge}</joint>']


def bone(name, mass, centre, length):
    rod = f'<cylinder radius="0.02" length="{length - 0.08:.2f}"/>'
    return link(name, inertial(mass, (0.05, 0.05, length), -length / centre), shape(rod, -length / 2))


def leg(name, x, side, further):
    parent, place, shank, lines = "torso", f"{x} {side * 0.13} 0", SEGMENT, []
    if "YAW" in further:
        lines += [*joint(f"{name}_YAW", parent, f"{name}_coxa", place, "0 0 1", 0.6), *link(f"{name}_coxa", inertial(HIP, (0.1, 0.1, 0.1)))]
        parent, place = f"{name}_coxa", "0 0 0"
    lines += [
        *joint(f"{name}_HAA", parent, f"{name}_hip", place, "1 0 0", 0.8),
        *link(f"{name}_hip", inertial(HIP, (0.1, 0.1, 0.1))),
        *joint(f"{name}_HFE", f"{name}_hip", f"{name}_thigh", f"0 {side * 0.09} 0", "0 1 0", 2.2),
        *bone(f"{name}_thigh", THIGH, 3, SEGMENT),
        *joint(f"{name}_KFE", f"{name}_thigh", f"{name}_shank", f"0 0 {-SEGMENT}", "0 1 0", 2.6),
    ]
    parent = f"{name}_shank"
    if "TOE" in further:
        shank -= TOE
        lines += [*bone(parent, SHANK, 2, shank), *joint(f"{name}_TOE", parent, f"{name}_toe", f"0 0 {-shank}", "0 1 0", 0.8)]
        parent, shank = f"{name}_toe", TOE
    return [
        *lines,
        *bone(parent, SHANK, 2, shank),
        *joint(f"{name}_ANKLE", parent, f"{name}_foot", f"0 0 {-shank}"),
        *link(f"{name}_foot", inertial(FOOT, (RADIUS, RADIUS, RADIUS)), shape(f'<sphere radius="{RADIUS}"/>')),
    ]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--legs", type=int, choices=PAIRS, default=6)
    parser.add_argument("--further", nargs="*", choices=["YAW", "TOE"], default=[])
    parser.add_argument("--of", nargs="*", choices=["F", "M", "H"], default=["F", "M", "H"], help="pairs of legs that have them")
    args = parser.parse_args()
    pairs = PAIRS[args.legs]
    torso = link("torso", inertial(TORSO, (LENGTH, WIDTH, HEIGHT)), shape(f'<box size="{LENGTH} {WIDTH - 0.08:.2f} {HEIGHT}"/>'))
    further = {pair: args.further if pair in args.of else [] for pair in pairs}
    legs = [line for pair, x in pairs.items() for name, side in (("L", 1), ("R", -1)) for line in leg(name + pair, x, side, further[pair])]
    name = "hexapod" if args.legs == 6 else "quadruped"
    print('<?xml version="1.0"?>', f'<robot name="{name}">', *torso, *legs, "</robot>", sep="\n")
