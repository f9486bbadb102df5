"""Types: mypy, strict, over the package with its stub and the examples."""

import os
import subprocess
import sys

from program import ROOT

PACKAGE = ROOT / "build/release/python"
SETTINGS = "[mypy]\nstrict = True\nwarn_unused_ignores = False\n"
WITHOUT_TYPES = ["pyarrow", "matplotlib", "pandas", "PIL", "surefoot_campaign", "surefoot_report", "surefoot_log"]
SKIPPED = "ignore_missing_imports = True\nfollow_imports = skip\n"
TYPED = "[mypy-surefoot_log.recorded]\nfollow_imports = normal\n"


def checked(*files, folder):
    settings = folder / "mypy.ini"
    settings.write_text(SETTINGS + "".join(f"[mypy-{name}.*]\n{SKIPPED}" for name in WITHOUT_TYPES) + TYPED)
    done = subprocess.run([sys.executable, "-m", "mypy", "--config-file", settings, "--cache-dir", folder / "cache", *files], capture_output=True, text=True,
                          cwd=folder, env=os.environ | {"MYPYPATH": str(PACKAGE)})  # fmt: skip
    return done.stdout + done.stderr


def test_the_package_with_its_stub_is_typed_strictly(tmp_path):
    assert checked("-p", "surefoot", "-m", "surefoot_log.recorded", folder=tmp_path).startswith("Success")


def test_so_are_the_examples(tmp_path):
    examples = ROOT / "examples"
    assert checked(*sorted([*examples.glob("[0-9]*.py"), examples / "wire.py"]), folder=tmp_path).startswith("Success")


def test_a_wrong_type_is_found(tmp_path):
    (tmp_path / "wrong.py").write_text('import surefoot\n\nrobot: int = surefoot.Robot("anymal_b")\nsurefoot.tasks.ComXy(kp="much")\n'
                                       "surefoot.tasks.ComXy().kp = 3\ncontroller = surefoot.Controller('anymal_b')\n"
                                       "controller.friction = 0.3\ncontroller.set_stack(3)\n")  # fmt: skip
    said = checked("wrong.py", folder=tmp_path)
    assert "Found 5 errors" in said, said


def test_what_is_valid_is_of_the_right_type(tmp_path):
    (tmp_path / "right.py").write_text("import numpy as np\nimport surefoot\n\nlevels = ({'A': np.eye(2), 'b': np.ones(2)},)\n"
                                       "import pathlib\nfile = pathlib.Path('robot.yaml')\nsurefoot.Controller(file, stack=file).set_stack(file)\n"
                                       "surefoot.Stack(file).write(file, robot=file)\nsurefoot.run(file, robot=file, stack=file)\nsurefoot.doctor(file)\n"
                                       "surefoot.Robot(file)\n"
                                       "surefoot.solve(levels, x_ref=np.zeros(2))\nsurefoot.HierarchicalSolver().solve([*levels], x_ref=[0.0, 0.0])\n"
                                       "errors: list[type[surefoot.Error]] = [surefoot.WorldError, surefoot.FileError]\n")  # fmt: skip
    assert checked("right.py", folder=tmp_path).startswith("Success")
