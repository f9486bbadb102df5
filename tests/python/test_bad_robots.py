"""Everything that can be wrong with a robot: each fault is a small edit of a good robot, and gives one message with its place and what would be valid."""

import json
import subprocess
import sys

import pytest

from marten import refusal, robot_file, written
from program import ROOT, surefoot

LIMITS = """\
limits:
  torque: 25.0
  velocity: 18.0
drives: {stall_torque: 25.0, no_load_speed: 22.0}
"""


@pytest.fixture(scope="module")
def good():
    """A robot file and its URDF, without a fault."""
    urdf = subprocess.run([sys.executable, ROOT / "examples/marten.py"], capture_output=True, text=True, check=True).stdout
    return {"marten.yaml": robot_file("urdf: marten.urdf", LIMITS), "marten.urdf": urdf.replace('"250"', '"0.25"').replace("0 -1 0", "0 1 0")}


def findings(robot):
    """What the doctor finds in the URDF, worst first."""
    found = json.loads(surefoot("doctor", robot.with_suffix(".urdf"), "--json").stdout)["findings"]
    return [f'{each["severity"]} ({each["confidence"]}): {each["subject"]} line {each["line"]}: {each["what"]} → {each["remedy"]}' for each in found]


def end(link):
    """A joint and a link at the end of the URDF."""
    return ("</robot>", f"{link}</robot>")


def of_leg(leg, joint):
    """The text of a joint up to its axis or limit."""
    return rf'(name="{leg}_{joint}"(?:.*\n){{4,5}}.*)'


def inertia_of(link, mass=None, inertia=None):
    """The edit of a link's <inertial>."""
    if mass is not None:
        return (rf'(<link name="{link}">\n.*<mass value=)"[^"]*"', rf'\1"{mass}"')
    return (rf'(<link name="{link}">\n.*\n.*)<inertia [^>]*>', rf'\1<inertia {inertia}/>')


SHANK = r'(<link name="LF_shank">\n.*\n.*\n.*\n *<collision>.*?)<cylinder radius="0.012" length="0.18"/>'
ARM = "".join(
    f'<joint name="arm{i}" type="revolute"><parent link="{"base" if i == 0 else f"arm_link{i - 1}"}"/><child link="arm_link{i}"/><origin xyz="0 0 0.1"/>'
    f'<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="5"/></joint><link name="arm_link{i}"><inertial><mass value="0.1"/>'
    f'<inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>' for i in range(25))  # fmt: skip
SHORT_ARM = ARM[: ARM.index('<joint name="arm4"')]

# The fault, its edits, and what the refusal says.
REFUSED = {
    "empty URDF": ([("(?s).+", "")], "yaml:2: urdf: marten.urdf:1: not well-formed XML: the file is empty"),
    "no text": ([("(?s).+", "\x01\x02")], "marten.urdf:1: not well-formed XML"),
    "end tag": ([("</robot>", "</robt>")], "marten.urdf:2: not well-formed XML: the element that begins here is not closed"),
    "cut off": ([(r'(?s)(<child link="LH_hip).*', r"\1")], "marten.urdf:107: not well-formed XML: an attribute here is not written as name="),
    "other format": ([("(?s).+", "<sdf/>")], "marten.urdf:1: not a URDF: the file has no <robot>"),
    "MJCF as a URDF": ([("(?s).+", "<mujoco/>")], "not a URDF: the file has no <robot>; an MJCF stands under `mjcf:`"),
    "two robots": ([("</robot>", "</robot><robot/>")], "marten.urdf:201: <robot> stands behind the <robot>; a URDF has one"),
    "no links": ([("(?s)<robot.*", "<robot/>")], "marten.urdf:1: the <robot> has no <link>"),
    "xacro": ([('(<link name="base">)', r"<xacro:leg/>\1")], "marten.urdf:3: <xacro:leg> does not belong in a URDF; run xacro first"),
    "xacro's expression": ([inertia_of("base", mass="${trunk}")], '<mass> needs value="a finite number", not "${trunk}"; run xacro first'),
    "empty robot file": ([("yaml (?s).+", "")], "marten.yaml: this file can't be read, or is empty"),
    "no YAML": ([("yaml legs:", "legs: {")], "marten.yaml:5: this is not YAML: "),
    "tab": ([("yaml   LF", "\tLF")], "marten.yaml:4: this is not YAML: ", "a line begins with a tab, valid are spaces"),
    "key twice": ([("yaml foot:\n", "name: again\nfoot:\n")], 'marten.yaml:8: the key "name" is given twice'),
    "unknown key": ([("yaml limits:", "limit:")], 'marten.yaml:10: limit: unknown key; did you mean "limits"? valid are: name, urdf'),
    "unknown inner key": ([("yaml torque: 25", "torques: 25")], 'marten.yaml:11: limits.torques: unknown key; did you mean "torque"?'),
    "no URDF named": ([("yaml urdf.*\n", "")], "urdf: this key is missing, or mjcf"),
    "URDF is not there": ([("yaml marten.urdf", "martin.urdf")], 'marten.yaml:2: urdf: there is no "martin.urdf"; looked for at: martin.urdf'),
    "package is not there": ([("yaml marten.urdf", "package://nowhere/a.urdf")], 'there is no "package://nowhere/a.urdf"', "ROS_PACKAGE_PATH"),
    "unknown foot": ([("yaml LF_foot", "LF_fot")], 'yaml:4: legs.LF.foot: unknown frame "LF_fot" in marten.urdf; did you mean "LF_foot"?'),
    "name in another case": ([("yaml LF_foot", "lf_foot")], 'legs.LF.foot: unknown frame "lf_foot"', 'did you mean "LF_foot"?'),
    "unknown base": ([("yaml name: marten", "name: marten\nbase: trunk")], 'yaml:2: base: unknown frame "trunk" in marten.urdf; valid are: base, LF_hip'),
    "base within": ([("yaml name: marten", "name: marten\nbase: LF_hip")], 'base: "LF_hip" is not the root of the URDF; valid is "base"'),
    "three legs": ([("yaml   RH.*\n", "")], "yaml:3: legs: has LF, RF, LH; valid are LF, RF, LH, RH, of six legs"),
    "more legs than there may be": ([("yaml   RH.*\n", "  RH: {foot: RH_foot}\n  A: {foot: a}\n  B: {foot: b}\n  C: {foot: c}\n")], "legs: has LF, RF, LH, RH, A, B, C; valid are"),
    "legs without names": ([(r"yaml legs:\n(.*\n){4}", "legs: 4\n")], 'yaml:3: legs: "4" is not a map of keys and values'),
    "exchanged legs": ([("yaml LF_foot", "X"), ("yaml RF_foot", "LF_foot"), ("yaml X", "RF_foot")], "yaml:4: legs.LF: in the nominal posture its foot is at x = 0.25, y = -0.16", "are two legs exchanged"),
    "foot of another leg": ([("yaml LF_foot", "RF_foot")], 'yaml:5: legs.RF.foot: "RF_foot" is the foot of legs.LF already; each has its own'),
    "shared joint": ([("yaml LF_foot", "LF_foot, joints: [RF_HAA, LF_HFE, LF_KFE]")], 'joint "RF_HAA" stands at two places, also in legs.LF.joints'),
    "joints in another order": ([("yaml LF_foot", "LF_foot, joints: [LF_HFE, LF_HAA, LF_KFE]")], 'joint "LF_HFE" moves with "LF_hip"', "a leg is HAA, HFE and KFE, from the base to the foot"),
    "two joints": ([("yaml LF_foot", "LF_foot, joints: [LF_HAA, LF_HFE]")], "legs.LF.joints: is not a list of 3 joints: HAA, HFE, KFE"),
    "foot on the thigh": ([("yaml LF_foot", "LF_thigh")], 'legs.LF: between the base and "LF_thigh" there are 2 joints that move: LF_HAA LF_HFE; a leg that walks has three'),
    "foot at the knee": ([("yaml LF_foot", "LF_shank")], 'yaml:4: legs.LF: its foot, "LF_shank", is 0 m from the knee\'s axis, and the thigh has 0.26 m; name the frame at the shank\'s end'),
    "foot inside the shank": ([(r'(name="LF_to_foot"(?:.*\n){3}.*)-0.26"', r'\1-0.05"')], 'legs.LF: its foot, "LF_foot", is 0.05 m from the knee\'s axis'),
    "no radius": ([("yaml   radius: 0.024", "  center: [0, 0, 0]")], "foot.radius: this key is missing"),
    "radius against the URDF's": ([("yaml 0.024", "0.03")], "the foot sphere of LF has radius 0.024 m", "in marten.urdf, but foot.radius and foot.center of the robot file say 0.03 m", "they must agree"),
    "radius of text": ([("yaml 0.024", "small")], 'marten.yaml:9: foot.radius: "small" is not a number of at least 0'),
    "radius NaN": ([("yaml 0.024", ".nan")], 'foot.radius: ".nan" is not a number of at least 0'),
    "torque 0": ([("yaml torque: 25.0", "torque: 0")], 'marten.yaml:11: limits.torque: "0" is not a number above 0'),
    "torque with unit": ([("yaml torque: 25.0", "torque: 25 Nm")], 'limits.torque: "25 Nm" is not a number above 0'),
    "two torques": ([("yaml torque: 25.0", "torque: [25, 25]")], "limits.torque: a list of 2 is not a list of 3 numbers, nor a map from HAA … KFE"),
    "torque of a knee": ([("yaml torque: 25.0", "torque: {KNEE: 25}")], "limits.torque.KNEE: unknown key; valid are: HAA, HFE, KFE"),
    "too weak": ([("yaml torque: 25.0", "torque: 1")], "it can't stand: with 20.44 kg, joint \"LF_KFE\" needs 7.192 N·m in the stance, and its limits.torque is 1 N·m"),
    "limits exchanged": ([("yaml limits:", "limits:\n  position_min: 1\n  position_max: -1")], "limits.position_max: must be above position_min at each of HAA, HFE and KFE"),
    "limits in degrees": ([("yaml limits:", "limits:\n  position_min: -45")], 'yaml:11: limits.position_min: "-45" is not from -20 to 20 rad'),
    "posture in degrees": ([("yaml limits:", "posture: {nominal: [0, 45, -90]}\nlimits:")], "posture.nominal: HFE at 45 rad lies outside limits.position_min and position_max, -2.2 to 2.2 rad"),
    "posture of straight knees": ([("yaml limits:", "posture: {nominal: [0, 0.4, 0]}\nlimits:")], "posture.nominal: HFE and KFE must bend the knee"),
    "gain below 0": ([("yaml limits:", "gains: {damping: -1}\nlimits:")], 'gains.damping: "-1" is not a number of at least 0'),
    "gain of a knee below 0": ([("yaml limits:", "gains: {hold: {kp: [50, 50, -1]}}\nlimits:")], 'gains.hold.kp: "-1" is not a number of at least 0'),
    "two gains": ([("yaml limits:", "gains: {hold: {kd: [5, 5]}}\nlimits:")], "gains.hold.kd: a list of 2 is not a list of 3 numbers, nor a map from HAA"),
    "gain of one joint of all": ([("yaml limits:", "gains: {damping: {KFE: 5}}\nlimits:")], "gains.damping: does not tell all of HAA, HFE and KFE"),
    "gain of a leg of text": ([("yaml LF_foot", "LF_foot, gains: {hold: {kp: {KFE: much}}}")], 'legs.LF.gains.hold.kp.KFE: "much" is not a number of at least 0'),
    "radius of a leg": ([("yaml LF_foot", "LF_foot, foot_radius: -1")], 'yaml:4: legs.LF.foot_radius: "-1" is not a number of at least 0'),
    "radius of a leg against the URDF's": ([("yaml RF_foot", "RF_foot, foot_radius: 0.03")], "the foot sphere of RF has radius 0.024 m", "of the robot file say 0.03 m", "they must agree"),
    "centre of a leg": ([("yaml LF_foot", "LF_foot, foot_center: [0, 0]")], "legs.LF.foot_center: a list of 2 is not"),
    "speed 0": ([("yaml no_load_speed: 22.0", "no_load_speed: 0")], 'drives.no_load_speed: "0" is not a number above 0'),
    "arm without a name": ([end(SHORT_ARM)], 'joint "arm0" can move but is not a joint of a leg or an arm of the description; name it under `arms:`, or make it fixed'),
    "tip that is not there": ([end(SHORT_ARM), ("yaml limits:", "arms: [{name: a, tip: hand}]\nlimits:")], 'yaml:10: arms.a.tip: unknown frame "hand" in marten.urdf; valid are'),
    "arm that shares a leg": ([("yaml limits:", "arms: [{name: a, tip: LF_shank}]\nlimits:")], 'arms.a.tip: "LF_shank" moves with joint "LF_KFE" of leg LF'),
    "posture of fewer joints": ([end(SHORT_ARM), ("yaml limits:", "arms: [{name: a, tip: arm_link3, posture: [0]}]\nlimits:")], "arms.a.posture: has 1 numbers, but the arm has 4 joints"),
    "more joints than there may be": ([end(ARM), ("yaml limits:", "arms: [{name: a, tip: arm_link24}]\nlimits:")], "arms.a: with it the robot has 37 joints; valid are at most 32"),
    "loop": ([end('<joint name="loop" type="fixed"><parent link="LF_foot"/><child link="RF_foot"/></joint>')], 'marten.urdf:201: link "RF_foot" is the child of two joints; of "RF_to_foot" and "loop" one must go'),
    "circle": ([end('<joint name="loop" type="fixed"><parent link="LF_foot"/><child link="base"/></joint>')], 'every link is the child of a joint, so that they form a loop; joint "loop" is the last of them'),
    "two trees": ([end('<link name="tail"/>')], "the links must form one tree; links without a parent: base tail"),
    "joint twice": ([('name="RF_HAA"', 'name="LF_HAA"')], 'marten.urdf:57: joint "LF_HAA" stands twice, first in line 9'),
    "link twice": ([('<link name="RF_hip"', '<link name="LF_hip"')], 'link "LF_hip" stands twice, first in line 17'),
    "link that is not there": ([('<parent link="LF_hip"/>', '<parent link="LF_hp"/>')], 'marten.urdf:20: joint "LF_HFE": unknown link "LF_hp"; there are: base LF_hip'),
    "link of the physics": ([('(<link name="base">)', r'<link name="world"/><joint name="w" type="fixed"><parent link="world"/><child link="base"/></joint>\1')], 'marten.urdf:3: link "world": the physics calls its ground so; take the link and its joint out'),
    "floating joint": ([('(<link name="base">)', r'<link name="origin"/><joint name="w" type="floating"><parent link="origin"/><child link="base"/></joint>\1')], 'yaml:2: urdf: marten.urdf:3: joint "w" is floating; the root floats without a joint'),
    "joint that slides": ([('(name="LF_KFE" type=)"revolute"', r'\1"prismatic"')], 'yaml:4: legs.LF.joints: joint "LF_KFE" is prismatic (marten.urdf:33); a leg\'s joint must be revolute'),
    "unknown kind of joint": ([('(name="LF_KFE" type=)"revolute"', r'\1"hinge"')], 'joint "LF_KFE" is hinge (marten.urdf:33)'),
    "joint without a name": ([('name="LF_KFE"', 'name=""')], "marten.urdf:33: <joint> has no name"),
    "joint without a type": ([('(name="LF_KFE") type="revolute"', r"\1")], 'marten.urdf:33: joint "LF_KFE" has no type'),
    "joint that follows": ([('<parent link="LF_thigh"/>', '<mimic joint="LF_HFE"/><parent link="LF_thigh"/>')], 'joint "LF_KFE" mimics "LF_HFE" (marten.urdf:33); a leg\'s joints must each have a drive of their own'),
    "continuous joint": ([('(name="LF_HFE" type=)"revolute"((?:.*\\n){5}.*<limit )lower="-2.2" upper="2.2" ', r'\1"continuous"\2')], 'limits.position_min: this key is missing, and the URDF does not limit joint "LF_HFE" (marten.urdf:20)'),
    "no effort": ([("yaml   torque.*\n", ""), ('effort="1000"', 'effort="0"')], 'limits.torque: this key is missing, and the URDF does not limit joint "LF_HAA" (marten.urdf:9)'),
    "limit NaN": ([('lower="-2.6"', 'lower="nan"')], 'limits.position_min: this key is missing, and the URDF does not limit joint "LF_KFE" (marten.urdf:33)'),
    "limit with unit": ([('upper="2.6"', 'upper="2.6rad"')], 'marten.urdf:38: <limit> needs upper="a finite number", not "2.6rad"'),
    "limits of the URDF exchanged": ([('lower="-2.6" upper="2.6"', 'lower="2.6" upper="-2.6"')], 'joint "LF_KFE" has -2.6 and 2.6 rad, here or in marten.urdf:33'),
    "no mass": ([inertia_of("LF_thigh", mass="0")], 'marten.urdf:28: link "LF_thigh": its mass is 0 and its inertia is not; a mass above 0 kg is valid'),
    "no mass of the base": ([inertia_of("base", mass="0")], 'link "base" moves, but with all that is fixed to it has no mass'),
    "mass NaN": ([inertia_of("LF_thigh", mass="nan")], 'marten.urdf:28: <mass> needs value="a finite number", not "nan"'),
    "mass with unit": ([inertia_of("LF_thigh", mass="1.3kg")], '<mass> needs value="a finite number", not "1.3kg"'),
    "mass below 0": ([inertia_of("LF_thigh", mass="-1.3")], 'marten.urdf:28: link "LF_thigh": mass -1.3 kg is negative; it must be 0 or more'),
    "mass in g": ([inertia_of("LF_thigh", mass="1300")], "it can't stand: with 1319.14 kg", "check this limit, and the masses in the URDF, in kg"),
    "inertia below 0": ([inertia_of("LF_thigh", inertia='ixx="-0.0076" iyy="0.0076" izz="0.0005" ixy="0" ixz="0" iyz="0"')], 'marten.urdf:28: link "LF_thigh": its inertia has a negative principal moment, -0.0076 kg·m²; all must be above 0'),
    "no inertia": ([inertia_of("LF_thigh", inertia='ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"')], 'link "LF_thigh" moves, but with all that is fixed to it has no inertia about some axis'),
    "inertia of no body": ([inertia_of("LF_thigh", inertia='ixx="0.001" iyy="0.001" izz="0.01" ixy="0" ixz="0" iyz="0"')], "has principal moments of inertia of 0.001, 0.001 and 0.01 kg·m²; in a body none is larger than the sum of the two others"),
    "inertia in mm²": ([inertia_of("LF_thigh", inertia='ixx="7590" iyy="7590" izz="542" ixy="0" ixz="0" iyz="0"')], "has a radius of gyration, √(I/m), of 76.4 m"),
    "inertia not whole": ([inertia_of("LF_thigh", inertia='iyy="0.0076" izz="0.0005" ixy="0" ixz="0" iyz="0"')], 'marten.urdf:29: <inertia> needs ixx="a finite number", and has none'),
    "axis of two numbers": ([(of_leg("LF", "KFE") + "0 1 0", r"\g<1>0 1")], 'marten.urdf:37: <axis> needs xyz="three finite numbers", not "0 1"'),
    "axis 0": ([(of_leg("LF", "KFE") + "0 1 0", r"\g<1>0 0 0")], 'marten.urdf:37: joint "LF_KFE": its axis has no direction; valid is <axis xyz="0 1 0"/>, for instance'),
    "axis across": ([(of_leg("LF", "KFE") + "0 1 0", r"\g<1>0 0 1")], 'yaml:4: legs.LF: the axis of KFE, "LF_KFE", is turned by 1.57 rad against that of HFE, "LF_HFE"'),
    "lengths in mm": ([(r'(?a)(<origin xyz="\S+ \S+ )-0.26"', r'\1-260"')], "yaml:4: legs.LF: thigh and shank have 260 and 260 m; are the origins in m?"),
    "knee the wrong way": ([(r'(name="LF_KFE"(?:.*\n){5}.*)lower="-2.6"', r'\1lower="0.2"'), (r'(name="RF_KFE"(?:.*\n){5}.*)upper="2.6"', r'\1upper="-0.2"')], "posture.nominal: this key is missing, and the joints' limits leave no posture", "LF bends forward, RF bends backward, LH bends both ways"),
    "mesh that is not there": ([(SHANK, r'\1<mesh filename="shank.stl"/>')], 'marten.urdf:44: link "LF_shank": there is no "shank.stl"; looked for at: shank.stl'),
    "mesh without a name": ([(SHANK, r"\1<mesh/>")], "marten.urdf:44: <mesh> has no filename"),
    "mesh of rubbish": ([(SHANK, r'\1<mesh filename="rubbish.stl"/>')], "invalid header in STL file 'rubbish.stl'"),
    "shape of another kind": ([(SHANK, r'\1<cone radius="1"/>')], 'marten.urdf:44: link "LF_shank": <cone> is no collision shape; valid: box, capsule, cylinder, mesh, sphere'),
    "shape of no size": ([(SHANK, r'\1<sphere radius="0"/>')], 'marten.urdf:44: link "LF_shank": the <sphere> that it collides with has a size of 0 m; it must be above 0'),
    "foot within a shape": ([(SHANK, r'\1<box size="0.1 0.1 0.4"/>')], 'a collision shape of link "LF_shank" reaches 55.1 mm below the foot sphere of LF', "must enclose what the foot stands on"),
}  # fmt: skip


@pytest.mark.parametrize("fault", REFUSED)
def test_a_fault_is_refused_with_its_place_and_what_is_valid(fault, good, tmp_path):
    edits, *said = REFUSED[fault]
    (tmp_path / "rubbish.stl").write_text("rubbish")
    message = refusal(written(tmp_path, good, edits))
    for part in said:
        assert part in message


# The fault, its edits, and parts of what the doctor finds, with no error before it.
FOUND = {
    "one leg of two joints": ([('(name="LF_KFE" type=)"revolute"', r'\1"fixed"')], 'error (certain): joint "LF_HAA" line 9: the limb that begins here is neither a leg (it has 2 joints, a leg has 3) nor an arm', "add what is missing"),
    "joint that slides": ([('(name="LF_KFE" type=)"revolute"', r'\1"prismatic"')], 'joint "LF_KFE" is prismatic', 'set type="revolute" (or continuous)'),
    "joint that follows": ([('<parent link="LF_thigh"/>', '<mimic joint="LF_HFE"/><parent link="LF_thigh"/>')], 'joint "LF_KFE" mimics another', "take out <mimic>"),
    "root that floats": ([('(<link name="base">)', r'<link name="origin"/><joint name="w" type="floating"><parent link="origin"/><child link="base"/></joint>\1')], 'joint "w" line 3: the whole robot hangs on this floating joint of the root "origin"', 'so that "base" is the root'),
    "mass in g": ([inertia_of("LF_thigh", mass="1300")], 'error (likely): link "LF_thigh" line 28: it has 1300 of the 1319 kg of all links', "is its mass in g? Divide it by 1000"),
    "all masses in g": ([(r'(?a)<mass value="(\d+)\.?(\d*)"', r'<mass value="\1\g<2>000"')], "error (likely): robot", "are the masses in g?"),
    "mass below 0": ([inertia_of("LF_thigh", mass="-1.3")], 'error (certain): link "LF_thigh" line 28: its mass is negative, -1.3 kg'),
    "no mass": ([inertia_of("LF_thigh", mass="0")], 'link "LF_thigh" line 28: its mass is 0, and its inertia is not', "a number above 0 is valid"),
    "inertia below 0": ([inertia_of("LF_thigh", inertia='ixx="-0.0076" iyy="0.0076" izz="0.0005" ixy="0" ixz="0" iyz="0"')], "its inertia has a negative principal moment, -0.0076 kg·m²", "correct the signs in <inertia>"),
    "inertia of no body": ([inertia_of("LF_thigh", inertia='ixx="0.001" iyy="0.001" izz="0.01" ixy="0" ixz="0" iyz="0"')], "it has moments of inertia that no body has: 0.001, 0.001, 0.01 kg·m²"),
    "inertia in mm²": ([inertia_of("LF_thigh", inertia='ixx="7590" iyy="7590" izz="542" ixy="0" ixz="0" iyz="0"')], "error (", "is <inertia> in kg·mm² (divide by 1e6)"),
    "lengths in mm": ([(r'(?a)(<origin xyz="\S+ \S+ )-0.26"', r'\1-260"')], "thigh and shank have 520 m together in LF RF LH RH", "are the origins in mm? Divide them by 1000"),
    "length in mm": ([(r'(<origin xyz="\S+ \S+ )-0.26"', r'\1-260"')], 'joint "LF_KFE" line 33: thigh and shank have 260.3 m together in LF'),
    "no foot": ([(r'(?s) *<joint name="LF_to_foot".*?</joint>\n *<link name="LF_foot".*?</link>\n', "")], 'link "LF_shank" line 41: the shank seems to end here, near the knee: the foot is missing of LF', "add a link with a collision sphere at the end of the shank"),
    "foot inside the shank": ([(r'(name="LF_to_foot"(?:.*\n){3}.*)-0.26"', r'\1-0.05"')], "the shank seems to end here, near the knee"),
    "no foot sphere": ([(r"(?a)<collision>.*sphere.*</collision>", "")], 'error (certain): link "LF_foot" line 52: these feet collide with nothing, so foot.radius is a guess, 0.026 m: LF_foot RF_foot LH_foot RH_foot', "measure the foot"),
    "axis turned round": ([(of_leg("LF", "KFE") + "0 1 0", r"\g<1>0 -1 0")], 'error (likely): joint "LF_KFE" line 33: the KFE of LF turns the other way than those of the other legs', "change the sign of its <axis>"),
    "hip axis across": ([(of_leg("RH", "HAA") + "1 0 0", r"\g<1>0 0 1")], 'error (likely): joint "RH_HAA"', "the axis of HAA is turned by 1.57 rad against x of the base", "1 0 0 in the base's frame is valid"),
    "feet in mm": ([(r'(?a)<sphere radius="0.024"', '<sphere radius="24"')], "its foot sphere has a radius of 24 m", "is <sphere radius> in mm?"),
    "origin in degrees": ([(r'(?a)(name="LF_HAA"(?:.*\n){3}.*xyz="\S+ \S+ 0")', r'\1 rpy="0 0 90"')], 'error (certain): joint "LF_HAA" line 9', "is rpy in degrees?"),
    "axis across": ([(of_leg("LF", "KFE") + "0 1 0", r"\g<1>0 0 1")], "the knee's axis is turned by 1.57 rad against that of \"LF_HFE\"", "correct its <axis>"),
    "knee the wrong way": ([(r'(name="LF_KFE"(?:.*\n){5}.*)lower="-2.6"', r'\1lower="0.2"'), (r'(name="RF_KFE"(?:.*\n){5}.*)upper="2.6"', r'\1upper="-0.2"')], "the knee of RF bends backward only, that of LF forward only", "exchange and negate lower and upper"),
    "knee that does not bend": ([('lower="-2.6" upper="2.6"', 'lower="-0.1" upper="0.1"')], "by their limits the knees of LF bend by less than 0.5 rad to either side"),
    "no limits": ([(r'(name="LF_HFE"(?:.*\n){5}) *<limit.*/>', r"\1")], "joint line 20: the URDF has no effort limit: LF_HFE", "fill in limits.torque of the robot file"),
    "placeholder of an effort": ([], "warning (likely): joints line 9: the effort limit looks like a placeholder, far above what standing needs (at most 4.91 N·m): all joints of the legs, 1000 N·m"),
    "effort too weak": ([('(?a)effort="1000"', 'effort="1"')], "error (likely): joints", "to stand takes more torque than the limit"),
    "longer leg": ([(r'(name="RF_KFE"(?:.*\n){3}.*)-0.26', r"\1-0.30")], "warning (likely): joint \"RF_KFE\"", "left and right differ, LF and RF, thigh, HFE axis to KFE axis: 0.26 against 0.3 m"),
    "looks back": ([(r'(?a)(name="[LR][FH]_HAA"(?:.*\n){3}.*xyz=")(-?)0.25 (-?)0.09', lambda m: m[1] + ("" if m[2] else "-") + "0.25 " + ("" if m[3] else "-") + "0.09"), (r'(?a)(name="[LR][FH]_HFE"(?:.*\n){3}.*xyz="0 )(-?)0.07', lambda m: m[1] + ("" if m[2] else "-") + "0.07")], "warning (guess)", "by its name it belongs to", "does the base look along x, with y to the left?"),
    "looks along y": ([(r'(?a)(name="[LR][FH]_HAA"(?:.*\n){3}.*xyz=")(\S+) (\S+) 0"', r'\1\3 \2 0" rpy="0 0 1.5708"')], "error (likely)", "most HFE axes do not lie along y of the base"),
    "mesh that is not there": ([(SHANK, r'\1<mesh filename="shank.stl"/>')], "error (certain): walk_flat", 'there is no "shank.stl"'),
    "arm": ([end(SHORT_ARM)], "note (likely)", "an arm begins here: arm0 arm1 arm2 arm3", "give it a posture under `arms:`"),
}  # fmt: skip


@pytest.mark.parametrize("fault", FOUND)
def test_the_doctor_finds_a_fault_before_what_follows_from_it(fault, good, tmp_path):
    edits, *said = FOUND[fault]
    found = findings(written(tmp_path, good, edits))
    fits = [all(part in each for part in said) for each in found]
    assert any(fits), "\n".join(found)
    assert not any(each.startswith("error") for each in found[: fits.index(True)])


@pytest.mark.parametrize("edits, said", [
    ([(r'(name="LF_HAA"(?:.*\n){5}) *<limit.*/>', r"\1")], ["limits.torque", "limits.velocity", "limits.position_min -1.2 rad of LF_HAA"]),
    ([(r"(?a)<collision>.*sphere.*</collision>", "")], ["foot.radius 0.026 m"]),
])  # fmt: skip
def test_a_run_tells_numbers_that_are_guessed(edits, said, good, tmp_path):
    robot = written(tmp_path, good, edits)
    script = f"import surefoot; r = surefoot.run('walk_flat', robot=surefoot.Robot({str(robot.with_suffix('.urdf'))!r}), set=['duration=1']); print(r.notes)"
    notes = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout
    assert "guessed for marten, not measured: " in notes
    for part in said:
        assert part in notes


def test_a_good_robot_is_not_refused(good, tmp_path):
    robot = written(tmp_path, good, [])
    assert surefoot("run", "walk_flat", "--check", "--set", f"robot={robot}").stderr == ""
    assert not any(each.startswith("error") for each in findings(robot))


def test_legs_may_have_feet_and_gains_of_their_own(good, tmp_path):
    edits = [(r'(<link name="RF_foot">\n.*\n.*\n.*\n.*)0.024', r"\g<1>0.03"), ("yaml RF_foot", "RF_foot, foot_radius: 0.03, gains: {hold: {kp: {KFE: 60}}}")]
    robot = written(tmp_path, good, edits)
    assert surefoot("run", "walk_flat", "--check", "--set", f"robot={robot}").stderr == ""


def test_a_robot_walks_on_points(good, tmp_path):
    robot = written(tmp_path, good, [(r"(?a)<collision>.*sphere.*</collision>", ""), ("yaml radius: 0.024", "radius: 0\n  center: [0, 0, -0.024]")])
    result = surefoot("run", "walk_flat", "--set", f"robot={robot}")
    assert result.returncode == 0, result
    assert "sphere" not in result.stdout + result.stderr


@pytest.mark.parametrize("edits, said", [
    ([], "note: not in the file of marten, so that is taken: posture with knees bent by 0.8 rad; gains of ANYmal B, to size: hold"),
    ([("yaml drives.*\n", "")], "so that is taken: drives as strong and fast as limits; posture"),
    ([("yaml   torque.*\n", "")], "warning: limits.torque of all joints is up to 1000 N·m, far above the"),
    ([("yaml   velocity.*\n", "")], "warning: limits.velocity of all joints is up to 1000 rad/s, above 100: a placeholder?"),
    ([(r"(?a)<collision>.*sphere.*</collision>", "")], 'note: a massless foot sphere was added to "LF_foot"'),
    ([(SHANK, r'\1<mesh filename="shank.dae"/>')], "note: collision meshes that are neither .stl nor .obj were left out"),
])  # fmt: skip
def test_what_stands_in_for_a_missing_number_is_told(edits, said, good, tmp_path):
    robot = written(tmp_path, good, edits)
    result = surefoot("run", "walk_flat", "--check", "--set", f"robot={robot}")
    assert said in result.stdout + result.stderr
