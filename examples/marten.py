"""Prints the URDF of marten, a robot of 20 kg that docs/your_robot.md brings to walk. Two of its numbers and its drives' limits are wrong."""


def inertial(mass, x=0.0, y=0.0, z=0.0, *, size):
    """Of a box of this size, its centre at x, y, z."""
    a, b, c = (side * side for side in size)
    return (f'    <inertial><origin xyz="{x} {y} {z}"/><mass value="{mass}"/>\n'
            f'      <inertia ixx="{mass * (b + c) / 12:.3g}" iyy="{mass * (a + c) / 12:.3g}" izz="{mass * (a + b) / 12:.3g}" '
            'ixy="0" ixz="0" iyz="0"/></inertial>')


def shape(geometry, z=0.0):
    return "\n".join(f'    <{kind}><origin xyz="0 0 {z}"/><geometry>{geometry}</geometry></{kind}>' for kind in ("visual", "collision"))


def link(name, *parts):
    return "\n".join([f'  <link name="{name}">', *parts, "  </link>"])


def joint(name, kind, parent, child, xyz, *parts):
    return "\n".join([f'  <joint name="{name}" type="{kind}">', f'    <parent link="{parent}"/>', f'    <child link="{child}"/>',
                      f'    <origin xyz="{xyz}"/>', *(f"    {part}" for part in parts), "  </joint>"])


def leg(name, front, left):
    def hinge(kind, parent, child, xyz, axis, lower, upper):
        limit = f'<limit lower="{lower}" upper="{upper}" effort="1000" velocity="1000"/>'
        return joint(f"{name}_{kind}", "revolute", f"{parent}", f"{name}_{child}", xyz, f'<axis xyz="{axis}"/>', limit)

    return [
        hinge("HAA", "base", "hip", f"{0.25 * front} {0.09 * left} 0", "1 0 0", -0.8, 0.8),
        link(f"{name}_hip", inertial(0.9, size=(0.09, 0.07, 0.09))),
        hinge("HFE", f"{name}_hip", "thigh", f"0 {0.07 * left} 0", "0 1 0", -2.2, 2.2),
        link(f"{name}_thigh", inertial(1.3, z=-0.09, size=(0.05, 0.05, 0.26)), shape('<cylinder radius="0.025" length="0.2"/>', -0.13)),
        hinge("KFE", f"{name}_thigh", "shank", "0 0 -0.26", "0 -1 0" if name == "RH" else "0 1 0", -2.6, 2.6),
        link(f"{name}_shank", inertial(0.25, z=-0.11, size=(0.02, 0.02, 0.26)).replace('"0.25"', '"250"' if name == "LF" else '"0.25"'),
             shape('<cylinder radius="0.012" length="0.18"/>', -0.12)),
        joint(f"{name}_to_foot", "fixed", f"{name}_shank", f"{name}_foot", "0 0 -0.26"),
        link(f"{name}_foot", inertial(0.06, size=(0.04, 0.04, 0.04)), shape('<sphere radius="0.024"/>')),
    ]


if __name__ == "__main__":
    legs = [leg("LF", 1, 1), leg("RF", 1, -1), leg("LH", -1, 1), leg("RH", -1, -1)]
    trunk = link("base", inertial(10.4, z=0.01, size=(0.5, 0.2, 0.12)), shape('<box size="0.5 0.16 0.12"/>'))
    print('<?xml version="1.0"?>', '<robot name="marten">', trunk, *(part for each in legs for part in each), "</robot>", sep="\n")
