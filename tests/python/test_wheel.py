"""The wheel, built from this tree and installed into an environment of its own: every command, where nothing of the tree can be reached."""

import contextlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import urllib.request
import warnings
import zipfile

import pytest
from program import ROOT

sys.path.insert(0, str(ROOT / "tools"))
import wheels

pytestmark = pytest.mark.slow
LIBRARIES = pathlib.Path(sysconfig.get_path("platlib"))


def tool(*command, **options):
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, timeout=1800, **options)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    return wheels.build("{}.{}".format(*sys.version_info), sys.executable, tmp_path_factory.mktemp("wheel"))


def installed(wheel, python, folder, own=()):
    """The packages' folder of an environment with the wheel. The packages that it depends on are those of this one, beside it as pip would lay
    them, but for `own`, which are fetched for this Python."""
    environment = folder / "venv"
    tool(python, "-m", "venv", *[] if own else ["--without-pip"], environment)
    [site] = environment.glob("lib/python*/site-packages")
    pip = [environment / "bin/python", "-m", "pip"] if own else [sys.executable, "-m", "pip", "--python", environment / "bin/python"]
    if own:
        wanted = re.findall(rf"^(?:{'|'.join(own)})==.*", (ROOT / "dependencies/python.txt").read_text(), re.MULTILINE)
        tool(*pip, "install", "--no-deps", *wanted)
    for entry in LIBRARIES.iterdir():
        if not entry.name.startswith("pip") and not (site / entry.name).exists():
            (site / entry.name).symlink_to(entry)
    robots = site / "example_robot_data-6.0.0.dist-info"  # tools/setup.sh unpacks what it needs of this one
    robots.mkdir()
    (robots / "METADATA").write_text("Metadata-Version: 2.1\nName: example-robot-data\nVersion: 6.0.0\n")
    tool(*pip, "install", "--no-deps", "--no-index", wheel)
    return site


@pytest.fixture(scope="module")
def site(wheel, tmp_path_factory):
    return installed(wheel, sys.executable, tmp_path_factory.mktemp("environment"))


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
    surefoot("run", "walk_flat_ideal", "--set", "duration=2", "--record", "run.mcap", status=4)  # too short for its criteria
    return "run.mcap"


def test_the_wheel_names_nothing_of_the_tree_and_is_small(wheel):
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            assert str(ROOT).encode() not in archive.read(name), name
        data = {pathlib.PurePath(name).parts[3] for name in archive.namelist() if name.startswith("surefoot/share/")}
    assert data == {"robots", "stacks", "gaits", "scenarios", "randomisations", "campaigns"}
    assert wheel.stat().st_size < 8e6


def test_pip_refuses_it_where_the_libc_is_older_than_what_it_asks_for(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        (information,) = [name for name in archive.namelist() if name.endswith("/WHEEL")]
        assert "Tag: {}-{}-{}\n".format(*wheel.stem.split("-")[2:]) in archive.read(information).decode()
        binaries = [content for content in map(archive.read, archive.namelist()) if content.startswith(b"\x7fELF")]
    asked = max(int(minor) for content in binaries for minor in re.findall(rb"\0GLIBC_2\.(\d+)(?=\0)", content))
    assert len(binaries) == 4 and wheel.stem.endswith(f"-manylinux_2_{asked}_x86_64")
    pip = [sys.executable, "-m", "pip", "download", "--no-deps", "--no-index", "--only-binary=:all:", "-d", tmp_path, wheel, "--platform"]
    tool(*pip, f"manylinux_2_{asked}_x86_64")
    older = subprocess.run([*map(str, pip), f"manylinux_2_{asked - 1}_x86_64"], capture_output=True, text=True)
    assert older.returncode == 1 and "not a supported wheel on this platform" in older.stderr


def test_the_version_is_that_of_the_project(wheel, surefoot):
    version = wheel.name.split("-")[1]
    assert f"VERSION {version} " in (ROOT / "CMakeLists.txt").read_text()
    assert surefoot("--version").startswith(f"{version} ")
    assert surefoot.run("python", "-c", "import surefoot; print(surefoot.__version__)").strip() == version


def test_its_data_is_its_own(surefoot):
    told = json.loads(surefoot("run", "step_down", "--check", "--json"))
    assert told["description"]
    assert "anymal_b" in surefoot("list", "robots") and "step_down" in surefoot("list", "scenarios")
    assert surefoot("run", "trot", "--check")
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
    surefoot("run", "walk_flat_ideal", "--seeds", 2, "--jobs", 2, "--set", "duration=0.2", status=4)
    (surefoot.folder / "short.yaml").write_text("scenario: walk_flat_ideal\nseeds: [1]\nset: {duration: 0.2}\n")
    surefoot("campaign", "short.yaml", "--no-plots")
    assert (surefoot.folder / "results/short/rows.jsonl").exists()
    assert surefoot("campaign", "step_down_height", "--dry-run").splitlines()[0].startswith("to do ")
    assert "experiments" in surefoot("demo", "--help").lower()


def test_the_rest_works(surefoot, log):
    (surefoot.folder / "problem.jsonl").write_text('{"levels":[{"A":[[1]],"b":[2]}]}\n')
    assert json.loads(surefoot("solve", "problem.jsonl"))["x"] == [2]
    robot = "package://example-robot-data/robots/anymal_b_simple_description/robots/anymal.urdf"
    assert "LF_FOOT" in surefoot("doctor", robot, "--name", "mine", "--out", "mine.yaml")
    assert surefoot("run", "walk_flat", "--check", "--set", "robot=mine.yaml")
    assert (surefoot.folder / "mine.svg").exists()
    surefoot("mend", log, "--out", "mended.mcap")
    assert surefoot("dump", "walk_flat_ideal", "--to", "0.01").startswith("{")


VIEWED = ["run", "walk_flat_ideal", "--view", "--no-wait"]


@pytest.mark.parametrize("command", [["replay", "run.mcap"], VIEWED], ids=["log", "live"])
def test_the_page_is_in_the_program(surefoot, log, command):
    served = subprocess.Popen(["surefoot", *command, "--port", "0"], cwd=surefoot.folder, env=surefoot.environment,
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


def refused(surefoot, *words, **changes):
    """The one line that a wrong installation answers with."""
    done = subprocess.run([*map(str, words)], cwd=surefoot.folder, env=surefoot.environment | changes, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    return done.stderr.strip().splitlines()[-1]


IMPORT = ["python", "-c", "import surefoot"]


@pytest.fixture
def other_site(surefoot, tmp_path):
    """A copy of what the wheel installed, to be spoilt."""
    for path in surefoot.site.glob("surefoot*"):
        if path.is_dir():
            shutil.copytree(path, tmp_path / path.name, ignore=shutil.ignore_patterns("share", "bin"))
        else:
            shutil.copy(path, tmp_path)
    return tmp_path


@contextlib.contextmanager
def without(surefoot, package):
    (information,) = surefoot.site.glob(f"{package}-*.dist-info")
    away = information.rename(surefoot.folder / "away")
    try:
        yield
    finally:
        away.rename(information)


def test_a_missing_package_is_named_with_what_installs_it(surefoot):
    with without(surefoot, "libpinocchio"):
        assert "the package libpinocchio is missing" in refused(surefoot, "surefoot", "list", "robots")
    assert surefoot("list", "robots")


def test_a_package_of_an_extra_may_be_missing(surefoot):
    with without(surefoot, "pandas"):
        assert surefoot("list", "robots")


def test_a_package_of_another_version_is_named_with_both(surefoot, other_site):
    (information,) = other_site.glob("surefoot-*.dist-info")
    metadata = (information / "METADATA").read_text()
    (information / "METADATA").write_text(metadata.replace("mujoco-core==", "mujoco-core==9."))
    told = refused(surefoot, "python", "-m", "surefoot_installation", PYTHONPATH=str(other_site))
    assert re.search(r"mujoco-core is version \S+, and this Surefoot was built with 9\.", told)


def test_a_module_for_another_python_says_so(surefoot, other_site):
    (module,) = (other_site / "surefoot").glob("_core*.so")
    module.rename(module.with_name("_core.cpython-399-x86_64-linux-gnu.so"))
    assert "another Python (_core.cpython-399" in refused(surefoot, *IMPORT, PYTHONPATH=str(other_site))


def test_two_versions_in_one_process_are_refused(surefoot, other_site):
    shutil.rmtree(other_site / "surefoot")
    for told in (refused(surefoot, *IMPORT, PYTHONPATH=str(other_site)), refused(surefoot, "surefoot", "list", "robots", PYTHONPATH=str(other_site))):
        assert "two versions of Surefoot lie side by side" in told and str(other_site) in told


def test_other_pythons_that_are_here_walk_with_their_wheel(tmp_path_factory):
    pythons, missing = wheels.found()
    if missing:
        warnings.warn(f"no Python {', '.join(missing)} here: its wheel is not tried", stacklevel=1)
    folder, code = tmp_path_factory.mktemp("wheel"), "import mujoco, surefoot; print(surefoot.run('walk_flat_ideal', set=['duration=0.2'])['fell'])"
    for version, python in pythons.items():
        if version == "{}.{}".format(*sys.version_info):
            continue
        site = installed(wheels.build(version, python, folder), python, tmp_path_factory.mktemp(version), ["numpy", "mujoco-core"])
        surefoot = Installed(site, tmp_path_factory.mktemp("empty"))
        assert "experiments" in surefoot("demo", "--help").lower()
        assert "fell" in surefoot("run", "walk_flat_ideal", "--set", "duration=0.2", "criteria=none")
        assert surefoot.run("python", "-c", f"import sys; assert '%d.%d' % sys.version_info[:2] == '{version}'; {code}").strip() == "False"
