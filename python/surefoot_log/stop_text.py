"""Why the controller has stopped for safety, in the words of surefoot/explain/stop_text.cpp."""

JOINTS = [f"{leg}_{joint}" for leg in ("LF", "RF", "LH", "RH") for joint in ("HAA", "HFE", "KFE")]
CAUSES = {"none": "", "tilt": "the torso tilted too far", "failures": "too many ticks without a solution",
          "cannot_stand": "it could not stand up", "fallen": "it fell"}
GROUPS = {"encoders": ("encoder", "encoders"), "joint_torques": ("joint torque", "joint torques"), "imu": ("IMU", "IMU")}
VERBS = {"none": "failed", "silent": "stopped", "late": "came late", "not_a_number": "gave no numbers", "out_of_range": "left the range",
         "jump": "changed too fast", "repeats": "repeated", "contradicts": "did not fit the rest"}  # fmt: skip
OF_ONE_VALUE = ("not_a_number", "out_of_range", "jump", "repeats", "contradicts")  # the others are of all of a group at once


def stop_text(command, health):
    """Of messages on /command and /health, decoded; empty: it has not."""
    cause = command.get("cause", "none")
    if cause in CAUSES:
        return CAUSES[cause]
    one, every = GROUPS[cause]
    # What was wrong when it stopped; logs before 2.8 know only what is wrong now.
    group = command if command.get("fault", "none") != "none" else health.get(cause, {"fault": "none", "joint": -1})
    fault, joint = group["fault"], group["joint"]
    if cause == "imu":
        return f"{every} {VERBS[fault]}"  # which is of no joint
    several = " of several joints" if fault in OF_ONE_VALUE else ""
    return f"{f'{one} {JOINTS[joint]}' if 0 <= joint < len(JOINTS) else every + several} {VERBS[fault]}"
