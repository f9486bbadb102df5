"""Prints the URDF of a hexapod, robots/hexapod.urdf: six legs of three hinges on a long torso. tools/hexapod.py > robots/hexapod.urdf"""

LENGTH, WIDTH, HEIGHT = 1.2, 0.24, 0.14  # m, of the torso
TORSO, HIP, THIGH, SHANK, FOOT = 22.0, 1.2, 1.8, 0.35, 0.08  # kg
SEGMENT = 0.28  # m, of thigh and shank
RADIUS = 0.03  # m, of the foot
PAIRS = {"F": 0.5, "M": 0.0, "H": -0.5}  # m, hips ahead of the torso's centre
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


def leg(name, x, side):
    rod = f'<cylinder radius="0.02" length="{SEGMENT - 0.08:.2f}"/>'
    bone = (0.05, 0.05, SEGMENT)
    return [
        *joint(f"{name}_HAA", "torso", f"{name}_hip", f"{x} {side * 0.13} 0", "1 0 0", 0.8),
        *link(f"{name}_hip", inertial(HIP, (0.1, 0.1, 0.1))),
        *joint(f"{name}_HFE", f"{name}_hip", f"{name}_thigh", f"0 {side * 0.09} 0", "0 1 0", 2.2),
        *link(f"{name}_thigh", inertial(THIGH, bone, -SEGMENT / 3), shape(rod, -SEGMENT / 2)),
        *joint(f"{name}_KFE", f"{name}_thigh", f"{name}_shank", f"0 0 {-SEGMENT}", "0 1 0", 2.6),
        *link(f"{name}_shank", inertial(SHANK, bone, -SEGMENT / 2), shape(rod, -SEGMENT / 2)),
        *joint(f"{name}_ANKLE", f"{name}_shank", f"{name}_foot", f"0 0 {-SEGMENT}"),
        *link(f"{name}_foot", inertial(FOOT, (RADIUS, RADIUS, RADIUS)), shape(f'<sphere radius="{RADIUS}"/>')),
    ]


if __name__ == "__main__":
    torso = link("torso", inertial(TORSO, (LENGTH, WIDTH, HEIGHT)), shape(f'<box size="{LENGTH} {WIDTH - 0.08:.2f} {HEIGHT}"/>'))
    legs = [line for pair, x in PAIRS.items() for name, side in (("L", 1), ("R", -1)) for line in leg(name + pair, x, side)]
    print('<?xml version="1.0"?>', '<robot name="hexapod">', *torso, *legs, "</robot>", sep="\n")
