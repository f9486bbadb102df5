"""A small robot that tests make wrong: its file, and what the program says of it."""

import re

from program import complaint


def robot_file(description, limits):
    """The text of its robot file. `description`: the key and the name of its URDF or MJCF; `limits`: all that stands behind the feet."""
    return f"""\
name: marten
{description}
legs:
  LF: {{foot: LF_foot}}
  RF: {{foot: RF_foot}}
  LH: {{foot: LH_foot}}
  RH: {{foot: RH_foot}}
foot:
  radius: 0.024
{limits}"""


def written(folder, good, edits):
    """
    The robot in a folder, after edits of the kind (what, replacement). `good`: its file and its description, by name. An edit whose first
    text begins with "yaml " is one of the robot file, else of the description; with "(?a)" it is made at all places, else at the first.
    """
    files = dict(good)
    robot, description = files
    for what, replacement in edits:
        name = robot if what.startswith("yaml ") else description
        files[name], count = re.subn(what.removeprefix("yaml "), replacement, files[name], count=0 if what.startswith("(?a)") else 1)
        assert count, what
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder / robot


def refusal(robot):
    """What `run` says, without the robot's folder."""
    return complaint("run", "walk_flat", "--check", "--set", f"robot={robot}").replace(f"{robot.parent}/", "")
