"""The wheel, built from this tree and installed into an environment of its own: every command, where nothing of the tree can be reached."""

import json
import os
import pathlib
import subprocess
import sys
import sysconfig
import urllib.request
import zipfile

import pytest
from program import ROOT

pytestmark = pytest.mark.slow
# As the tree's own build, so that ccache has every object already.
COMPILERS = {"CC": "/usr/bin/cc", "CXX": "/usr/bin/c++"}
SETTINGS = ["--config-settings=cmake.define.SUREFOOT_WARNINGS_AS_ERRORS=ON"]
LIBRARIES = pathlib.Path(sysconfig.get_path("platlib"))


def tool(*command, **options):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=1800, **options)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    tool(sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", *SETTINGS, "--wheel-dir", folder, ".",
         cwd=ROOT, env=os.environ | COMPILERS)  # fmt: skip
    [file] = folder.glob("*.whl")
    return file


@pytest.fixture(scope="module")
def site(wheel, tmp_path_factory):
    """An environment with the wheel. The packages that it depends on are those of this one, beside it as pip would lay them."""
    environment = tmp_path_factory.mktemp("environment") / "venv"
    tool(sys.executable, "-m", "venv", "--without-pip", environment)
    [site] = environment.glob("lib/python*/site-packages")
    for entry in LIBRARIES.iterdir():
        if entry.name != "pip":
            (site / entry.name).symlink_to(entry)
    tool(sys.executable, "-m", "pip", "--python", environment / "bin/python", "install", "--no-deps", "--no-index", wheel)
    return site


class Installed:
    """Calls of `surefoot`, in an empty folder."""

    def __init__(self, site, folder):
        self.site, self.bin, self.folder = site, site.parents[2] / "bin", folder
        ours = {"PYTHONPATH", *(name for name in os.environ if name.startswith("SUREFOOT_"))}
        self.environment = {name: value for name, value in os.environ.items() if name not in ours}
        self.environment["PATH"] = f"{self.bin}:{os.environ['PATH']}"

    def run(self, *words, status=0):
        done = subprocess.run([*map(str, words)], cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=600)
        assert done.returncode == status, done.stdout + done.stderr
        return done.stdout

    def __call__(self, *words, status=0):
        return self.run("surefoot", *words, status=status)


@pytest.fixture(scope="module")
def surefoot(site, tmp_path_factory):
    return Installed(site, tmp_path_factory.mktemp("empty"))


@pytest.fixture(scope="module")
def log(surefoot):
    surefoot("run", "walk_flat_ideal", "--set", "duration=2", "--record", "run.mcap", status=1)  # too short for its criteria
    return "run.mcap"


def test_the_wheel_names_nothing_of_the_tree_and_is_small(wheel):
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            assert str(ROOT).encode() not in archive.read(name), name
        data = {pathlib.PurePath(name).parts[3] for name in archive.namelist() if name.startswith("surefoot/share/")}
    assert data == {"robots", "stacks", "scenarios", "randomisations", "campaigns"}
    assert wheel.stat().st_size < 8e6


def test_the_version_is_that_of_the_project(wheel, surefoot):
    version = wheel.name.split("-")[1]
    assert f"VERSION {version} " in (ROOT / "CMakeLists.txt").read_text()
    assert surefoot("--version").startswith(f"{version} ")
    assert surefoot.run("python", "-c", "import surefoot; print(surefoot.__version__)").strip() == version


def test_its_data_is_its_own(surefoot):
    told = json.loads(surefoot("run", "step_down", "--check", "--json"))
    assert told["description"]
    assert "anymal_b" in surefoot("list", "robots") and "step_down" in surefoot("list", "scenarios")
    where = "import surefoot; print(surefoot.load_scenario('step_down').file)"
    assert pathlib.Path(surefoot.run("python", "-c", where).strip()) == surefoot.site / "surefoot/share/surefoot/scenarios/step_down.yaml"


def test_programs_of_the_log_work(surefoot, log):
    surefoot("replay", log, "--verify")
    assert "walk_flat_ideal" in surefoot("info", log)
    assert surefoot("explain", log, "--at", "1.5")
    surefoot("export", log, "--csv", "run.csv", "--parquet", "run.parquet")
    surefoot("video", log, "--out", "run.mp4", "--from", "1", "--to", "1.2", "--size", "320x180")
    surefoot("report", log, "--out", "report", "--no-pictures")
    for name in ("run.csv", "run.parquet", "run.mp4", "report/index.html"):
        assert (surefoot.folder / name).stat().st_size > 1000, name


def test_many_runs_work(surefoot):
    surefoot("run", "walk_flat_ideal", "--seeds", 2, "--jobs", 2, "--set", "duration=0.2", status=1)
    (surefoot.folder / "short.yaml").write_text("scenario: walk_flat_ideal\nseeds: [1]\nset: {duration: 0.2}\n")
    surefoot("campaign", "short.yaml", "--no-plots")
    assert (surefoot.folder / "results/short/rows.jsonl").exists()
    assert surefoot("campaign", "step_down_height", "--dry-run").splitlines()[0].startswith("to do ")
    assert "experiments" in surefoot("demo", "--help").lower()


def test_the_rest_works(surefoot):
    (surefoot.folder / "problem.jsonl").write_text('{"levels":[{"A":[[1]],"b":[2]}]}\n')
    assert json.loads(surefoot("solve", "problem.jsonl"))["x"] == [2]
    robot = "package://example-robot-data/robots/anymal_b_simple_description/robots/anymal.urdf"
    assert "LF_FOOT" in surefoot("doctor", robot)
    assert surefoot("dump", "walk_flat_ideal", "--to", "0.01").startswith("{")


def test_the_page_is_in_the_program(surefoot, log):
    served = subprocess.Popen(["surefoot", "replay", log, "--port", "0"], cwd=surefoot.folder, env=surefoot.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)  # fmt: skip
    try:
        address = next(word for line in served.stdout for word in line.split() if word.startswith("http://"))
        with urllib.request.urlopen(address, timeout=30) as page:
            assert b"<title>" in page.read()
    finally:
        served.terminate()
        served.wait(30)


def test_the_module_goes_with_pinocchio_and_mujoco_in_one_process(surefoot):
    code = """
import importlib.util, mujoco, surefoot
if importlib.util.find_spec("pinocchio"):
    import pinocchio
scenario = surefoot.load_scenario("walk_flat_ideal", set=["duration=0.1"])
plant = surefoot.Plant(scenario)
controller = surefoot.Controller(scenario, plant)
plant.write(controller.step(plant.read(), scenario.user(0)))
model = mujoco.MjModel.from_xml_string("<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>")
mujoco.mj_step(model, mujoco.MjData(model))
libraries = {line.split()[-1] for line in open("/proc/self/maps") if "libmujoco" in line or "libpinocchio_default" in line}
print(len(libraries))
"""
    assert surefoot.run("python", "-c", code).strip() == "2"
