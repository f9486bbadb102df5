"""Everything that can be wrong with a robot in MJCF: each fault is a small edit of a good one, and gives one message with its place and what would be valid."""

import json

import pytest

from marten import refusal, robot_file, written
from program import surefoot


def leg(name, front, left):
    return f"""\
    <body name="{name}_hip" pos="{0.25 * front} {0.09 * left} 0">
      <joint name="{name}_HAA" axis="1 0 0" range="-0.8 0.8"/>
      <inertial pos="0 0 0" mass="0.9" diaginertia="0.001 0.001 0.001"/>
      <body name="{name}_thigh" pos="0 {0.07 * left} 0">
        <joint name="{name}_HFE" axis="0 1 0" range="-2.2 2.2"/>
        <inertial pos="0 0 -0.09" mass="1.3" diaginertia="0.0076 0.0076 0.0005"/>
        <geom type="cylinder" size="0.025 0.1" pos="0 0 -0.13"/>
        <body name="{name}_shank" pos="0 0 -0.26">
          <joint name="{name}_KFE" axis="0 1 0" range="-2.6 2.6"/>
          <inertial pos="0 0 -0.11" mass="0.31" diaginertia="0.002 0.002 0.00003"/>
          <geom type="cylinder" size="0.012 0.09" pos="0 0 -0.12"/>
          <geom name="{name}_foot" size="0.024" pos="0 0 -0.26"/>
        </body>
      </body>
    </body>
"""


MJCF = f"""\
<mujoco model="marten">
  <compiler angle="radian" autolimits="true"/>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body name="base" pos="0 0 0.5">
    <freejoint name="root"/>
    <inertial pos="0 0 0.01" mass="10.4" diaginertia="0.05 0.23 0.25"/>
    <geom type="box" size="0.25 0.08 0.06"/>
{leg("LF", 1, 1)}{leg("RF", 1, -1)}{leg("LH", -1, 1)}{leg("RH", -1, -1)}    </body>
  </worldbody>
  <actuator>
{"".join(f'    <motor name="{name}_{joint}" joint="{name}_{joint}" ctrlrange="-25 25"/>{chr(10)}' for name in ("LF", "RF", "LH", "RH") for joint in ("HAA", "HFE", "KFE"))}  </actuator>
</mujoco>
"""

GOOD = {"marten.yaml": robot_file("mjcf: marten.xml", "limits:\n  velocity: 18.0\n"), "marten.xml": MJCF}


def of(body, what, replacement):
    """The edit of what stands first behind a body's name."""
    return (rf'(?s)(<body name="{body}".*?){what}', rf"\1{replacement}")


def at_end(element):
    """An element behind the bodies."""
    return ("  <actuator>", f"  {element}\n  <actuator>")


ARM = "".join(f'<body name="a{i}" pos="0 0 0.02"><joint name="arm{i}" axis="0 1 0" range="-1 1" actuatorfrcrange="-9 9"/><geom size="0.01" contype="0" conaffinity="0"/>' for i in range(25)) + "</body>" * 25
ARM_FILE = ("yaml limits:", "arms: [{name: neck, tip: a24}]\nlimits:")

# The fault, its edits, and what the refusal says.
REFUSED = {
    "empty": ([("(?s).+", "")], "yaml:2: mjcf: marten.xml:1: not well-formed XML: the file is empty"),
    "no text": ([("(?s).+", "\x01\x02")], "marten.xml:1: not well-formed XML"),
    "cut off": ([(r'(?s)(<body name="LH_hip).*', r"\1")], "not well-formed XML"),
    "not closed": ([("</worldbody>", "</world>")], "not well-formed XML"),
    "URDF as an MJCF": ([("(?s).+", '<robot name="x"><link name="base"/></robot>')], "not an MJCF: the file has no <mujoco>; a URDF stands under `urdf:`"),
    "other format": ([("(?s).+", "<sdf/>")], "marten.xml:1: not an MJCF: the file has no <mujoco>"),
    "no bodies": ([("(?s).+", "<mujoco/>")], "marten.xml:1: no body has a free joint; the robot's base needs one, <freejoint/>"),
    "unknown element": ([("    <geom type=\"plane\" size=\"5 5 1\"/>", "    <plane/>")], "marten.xml:4: Schema violation"),
    "unknown attribute": ([("axis=\"1 0 0\"", 'axes="1 0 0"')], "marten.xml:10: Schema violation"),
    "both descriptions": ([("yaml mjcf:", "urdf: marten.urdf\nmjcf:")], "yaml:3: mjcf: urdf stands beside it; a robot has one of them"),
    "file is not there": ([("yaml marten.xml", "martin.xml")], 'yaml:2: mjcf: there is no "martin.xml"; looked for at: martin.xml'),
    "included file is not there": ([("  <worldbody>", '  <include file="legs.xml"/>\n  <worldbody>')], "marten.xml:", "legs.xml"),
    "no free joint": ([("    <freejoint name=\"root\"/>\n", "")], "marten.xml:1: no body has a free joint"),
    "several free joints": ([("  </worldbody>", '    <body name="ball"><freejoint/><geom size="0.1"/></body>\n  </worldbody>')], 'several bodies have a free joint: "base" "ball"; only one may, the robot\'s base'),
    "free joint within": ([of("LF_hip", "<joint [^>]*>", "<freejoint/>")], "marten.xml:"),
    "unknown foot": ([("yaml LF_foot", "LF_fot")], 'yaml:4: legs.LF.foot: unknown frame "LF_fot" in marten.xml; did you mean "LF_foot"?'),
    "foot without a name": ([('name="LF_foot" ', "")], 'legs.LF.foot: unknown frame "LF_foot" in marten.xml'),
    "unknown base": ([("yaml name: marten", "name: marten\nbase: trunk")], 'yaml:2: base: unknown frame "trunk" in marten.xml'),
    "shared joint": ([("yaml LF_foot", "LF_foot, joints: [RF_HAA, LF_HFE, LF_KFE]")], 'joint "RF_HAA" stands at two places, also in legs.LF.joints'),
    "foot of another leg": ([("yaml LF_foot", "RF_foot")], 'yaml:5: legs.RF.foot: "RF_foot" is the foot of legs.LF already; each has its own'),
    "exchanged legs": ([("yaml LF_foot", "X"), ("yaml RF_foot", "LF_foot"), ("yaml X", "RF_foot")], "yaml:4: legs.LF: in the nominal posture its foot is at x = 0.25, y = -0.16", "are two legs exchanged"),
    "joint twice": ([('joint name="RF_HAA"', 'joint name="LF_HAA"')], "marten.xml:25:", "repeated name 'LF_HAA'"),
    "body twice": ([('body name="RF_hip"', 'body name="LF_hip"')], "marten.xml:24:", "repeated name 'LF_hip'"),
    "loop": ([at_end('<equality><connect body1="LF_shank" body2="RF_shank" anchor="0 0 0"/></equality>')], 'an equality constraint ties "LF_shank" to "RF_shank"; the model has no such constraints'),
    "joint that follows": ([at_end('<equality><joint joint1="LF_KFE" joint2="LF_HFE"/></equality>')], 'an equality constraint ties "LF_KFE" to "LF_HFE"'),
    "drive of a tendon": ([at_end('<tendon><fixed name="rope"><joint joint="LF_KFE" coef="1"/></fixed></tendon>'), ("  </actuator>", '    <motor name="pull" tendon="rope"/>\n  </actuator>')], 'actuator "pull" pulls a tendon or a crank; each joint of a leg needs a drive of its own'),
    "joint that slides": ([('name="LF_KFE" axis', 'name="LF_KFE" type="slide" axis')], 'yaml:4: legs.LF.joints: joint "LF_KFE" is prismatic (marten.xml:17); a leg\'s joint must be revolute'),
    "joint of a ball": ([('name="LF_KFE" axis="0 1 0" range="-2.6 2.6"', 'name="LF_KFE" type="ball"'), (".*joint=\"LF_KFE\".*\n", "")], 'joint "LF_KFE" is ball (marten.xml:17)'),
    "unknown kind of joint": ([('name="LF_KFE" axis', 'name="LF_KFE" type="hing" axis')], "marten.xml:17:", "hing"),
    "two joints in a body": ([of("LF_shank", '<joint ', '<joint name="more"/><joint ')], 'marten.xml:16: body "LF_shank" has 2 joints; it may have one, so put a body between them'),
    "leg of two joints": ([of("LF_shank", "<joint [^>]*>", ""), (".*joint=\"LF_KFE\".*\n", "")], 'legs.LF: between the base and "LF_foot" there are 2 joints that move: LF_HAA LF_HFE; a leg that walks has three'),
    "joint of no limb": ([("    </body>\n  </worldbody>", '    <body name="tail"><joint name="tail"/><geom size="0.1"/></body></body>\n  </worldbody>')], 'joint "tail" can move but is not a joint of a leg or an arm of the description; name it under `arms:`, or make it fixed'),
    "too many joints": ([("    </body>\n  </worldbody>", f"{ARM}    </body>\n  </worldbody>"), ARM_FILE], "arms.neck: with it the robot has 37 joints; valid are at most 32"),
    "arm's posture": ([("    </body>\n  </worldbody>", f"{ARM}    </body>\n  </worldbody>"), ("yaml limits:", "arms: [{name: neck, tip: a2, posture: [0, 0, 2]}, {name: head, tip: a24}]\nlimits:")], "arms."),
    "no velocity": ([("yaml   velocity.*\n", "  torque: 25\n")], 'limits.velocity: this key is missing, and the MJCF does not limit joint "LF_HAA" (marten.xml:10)'),
    "no effort": ([(".*joint=\"LF_KFE\".*\n", "")], 'limits.torque: this key is missing, and the MJCF does not limit joint "LF_KFE" (marten.xml:17)'),
    "drive of a joint that is not there": ([('joint="LF_KFE" ctrl', 'joint="LF_KNEE" ctrl')], 'marten.xml:74: actuator "LF_KFE" drives an unknown joint, "LF_KNEE"; did you mean "LF_'),
    "no range": ([('(name="LF_KFE" axis="0 1 0") range="-2.6 2.6"', r"\1")], 'limits.position_min: this key is missing, and the MJCF does not limit joint "LF_KFE" (marten.xml:17)'),
    "range exchanged": ([('range="-2.6 2.6"', 'range="2.6 -2.6"')], 'marten.xml:17: joint "LF_KFE" has a range from 2.6 to -2.6; the first must be the lower one'),
    "range NaN": ([('range="-2.6 2.6"', 'range="nan 2.6"')], 'marten.xml:17: joint "LF_KFE" has a range from nan to 2.6'),
    "range with unit": ([('range="-2.6 2.6"', 'range="-2.6rad 2.6"')], "marten.xml:17:"),
    "radians taken for degrees": ([(' angle="radian"', "")], "posture.nominal: this key is missing, and the joints' limits leave no posture"),
    "too weak": ([('(?a)ctrlrange="-25 25"', 'ctrlrange="-1 1"')], "it can't stand: with 20.44 kg", "its limits.torque is 1 N·m"),
    "no mass": ([of("LF_thigh", 'mass="1.3"', 'mass="0"')], 'marten.xml:12: body "LF_thigh" moves, but has no mass or no inertia about some axis; all must be above 0'),
    "nothing that weighs": ([of("LF_hip", "<inertial [^>]*>", "")], 'marten.xml:9: body "LF_hip" moves, but has no mass'),
    "mass NaN": ([of("LF_thigh", 'mass="1.3"', 'mass="nan"')], 'marten.xml:12: body "LF_thigh": the mass of its <inertial> is not a finite number'),
    "mass with unit": ([of("LF_thigh", 'mass="1.3"', 'mass="1.3kg"')], "marten.xml:14:"),
    "mass below 0": ([of("LF_thigh", 'mass="1.3"', 'mass="-1.3"')], 'marten.xml:12: body "LF_thigh": the mass of its <inertial> is -1.3 kg; it must be 0 or more'),
    "mass in g": ([of("LF_thigh", 'mass="1.3"', 'mass="1300"')], "it can't stand: with 1319.14 kg", "in kg"),
    "inertia below 0": ([of("LF_thigh", 'diaginertia="0.0076', 'diaginertia="-0.0076')], 'marten.xml:12: body "LF_thigh": its inertia has a negative principal moment, -0.0076 kg·m²; all must be above 0'),
    "inertia NaN": ([of("LF_thigh", 'diaginertia="0.0076', 'diaginertia="nan')], 'marten.xml:12: body "LF_thigh": the diaginertia of its <inertial> is not finite'),
    "no inertia": ([of("LF_thigh", 'diaginertia="0.0076 0.0076 0.0005"', 'diaginertia="0 0 0"')], 'marten.xml:12: body "LF_thigh" moves, but has no mass or no inertia about some axis'),
    "inertia of no body": ([of("LF_thigh", 'diaginertia="0.0076 0.0076 0.0005"', 'diaginertia="0.001 0.001 0.01"')], 'marten.xml:12: body "LF_thigh": of its principal moments of inertia one is larger than the sum of the two others'),
    "inertia in mm²": ([of("LF_thigh", 'diaginertia="0.0076 0.0076 0.0005"', 'diaginertia="7590 7590 542"')], "has a radius of gyration, √(I/m), of 76.4 m"),
    "inertia not whole": ([of("LF_thigh", 'diaginertia="0.0076 0.0076 0.0005"', 'diaginertia="0.0076 0.0076"')], "marten.xml:14:"),
    "axis 0": ([of("LF_shank", 'axis="0 1 0"', 'axis="0 0 0"')], 'marten.xml:17: joint "LF_KFE": its axis, 0 0 0, has no direction; valid is axis="0 1 0"'),
    "axis NaN": ([of("LF_shank", 'axis="0 1 0"', 'axis="0 nan 0"')], 'marten.xml:17: joint "LF_KFE": its axis'),
    "axis across": ([of("LF_shank", 'axis="0 1 0"', 'axis="0 0 1"')], 'yaml:4: legs.LF: the axis of KFE, "LF_KFE", is turned by 1.57 rad against that of HFE, "LF_HFE"'),
    "place NaN": ([of("LF_shank", 'pos="0 0 -0.26"', 'pos="0 nan -0.26"')], 'marten.xml:16: body "LF_shank": its pos is not finite'),
    "lengths in mm": ([(r'(?a)pos="0 0 -0.26"', 'pos="0 0 -260"')], "yaml:4: legs.LF: thigh and shank have 260 and 260 m; are the"),
    "foot at the knee": ([('name="LF_foot" size="0.024" pos="0 0 -0.26"', 'name="LF_foot" size="0.024"')], 'yaml:4: legs.LF: its foot, "LF_foot", is 0 m from the knee\'s axis'),
    "knee the wrong way": ([('(name="LF_KFE" axis="0 1 0" range=)"-2.6', r'\1"0.2'), ('(name="RF_KFE" axis="0 1 0" range="-2.6) 2.6', r"\1 -0.2")], "LF bends forward, RF bends backward, LH bends both ways"),
    "mesh that is not there": ([("  <worldbody>", '  <asset><mesh name="m" file="shank.stl"/></asset>\n  <worldbody>'), of("LF_shank", "<geom [^>]*>", '<geom type="mesh" mesh="m"/>')], 'there is no "shank.stl"'),
    "mesh of rubbish": ([("  <worldbody>", '  <asset><mesh name="m" file="rubbish.stl"/></asset>\n  <worldbody>'), of("LF_shank", "<geom [^>]*>", '<geom type="mesh" mesh="m"/>')], "rubbish.stl"),
    "mesh that is not named": ([of("LF_shank", "<geom [^>]*>", '<geom type="mesh" mesh="m"/>')], 'marten.xml:19: unknown mesh "m"; valid is the name of a <mesh>, or of its file'),
    "shape of no size": ([of("LF_shank", 'size="0.012 0.09"', 'size="0 0.09"')], "marten.xml:19: size 0 must be positive in geom"),
    "shape of another kind": ([of("LF_shank", 'type="cylinder"', 'type="cone"')], "marten.xml:19:", "cone"),
    "radius against the MJCF's": ([("yaml 0.024", "0.03")], "the foot sphere of LF has radius 0.024 m", "in marten.xml, but foot.radius and foot.center of the robot file say 0.03 m", "they must agree"),
    "foot within a shape": ([of("LF_shank", '<geom type="cylinder" size="0.012 0.09"', '<geom type="box" size="0.05 0.05 0.2"')], 'a collision shape of link "LF_shank" reaches', "below the foot sphere of LF"),
    "spring": ([of("LF_shank", "<joint ", '<joint stiffness="2" ')], 'marten.xml:17: joint "LF_KFE" has stiffness; the model has no springs at joints'),
    "no gravity": ([('<body name="LF_hip"', '<body name="LF_hip" gravcomp="1"')], 'marten.xml:9: body "LF_hip" has gravcomp'),
}  # fmt: skip


@pytest.mark.parametrize("fault", REFUSED)
def test_a_fault_is_refused_with_its_place_and_what_is_valid(fault, tmp_path):
    edits, *said = REFUSED[fault]
    (tmp_path / "rubbish.stl").write_text("rubbish")
    message = refusal(written(tmp_path, GOOD, edits))
    for part in said:
        assert part in message


def test_a_good_robot_is_not_refused(tmp_path):
    robot = written(tmp_path, GOOD, [])
    assert surefoot("run", "walk_flat", "--check", "--set", f"robot={robot}").stderr == ""


def test_bodies_and_joints_need_no_names(tmp_path):
    edits = [(r'(?a)<body name="\w+"', "<body"), (r'(?a)<joint name="\w+"', "<joint"), (r'(?a)    <motor .*\n', ""), (r'(?a)axis="\d \d 0"', r'\g<0> actuatorfrcrange="-25 25"')]
    robot = written(tmp_path, GOOD, edits)
    found = json.loads(surefoot("doctor", robot.with_suffix(".xml"), "--json").stdout)
    assert [each["what"] for each in found["findings"] if each["severity"] == "error"] == []
