"""Stock MuJoCo shows and checks a run without us: model, state and controls all stand in the log."""

import mujoco
import numpy as np
import pytest
from conftest import record
from log_file import attachment, messages

LEGS = ("LF", "RF", "LH", "RH")


PUSH = {"time": 0.9, "duration": 0.3}  # s; before it the robot stands still for a while


@pytest.fixture(scope="module")
def pushed_log(tmp_path_factory):
    """A run with a lateral push near its end."""
    window = [part for key, value in PUSH.items() for part in ("--set", f"disturbances.pushes.lateral.{key}={value}")]
    return record(tmp_path_factory.mktemp("log") / "push.mcap", *window, scenario="push", duration=1.3)


@pytest.fixture(scope="module", params=["log", "pushed_log"])
def run(request):
    """A recorded run, of each kind."""
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def model(run):
    return mujoco.MjModel.from_xml_string(attachment(run, "model.xml").decode())


@pytest.fixture(scope="module")
def truths(run):
    return messages(run, "/truth")[::10]


def forward(model, data, truth):
    """The physics at one tick of the log."""
    data.qpos[:], data.qvel[:], data.ctrl[:] = truth["qpos"], truth["qvel"], truth["ctrl"]
    data.xfrc_applied.flat = truth["xfrc_applied"]
    mujoco.mj_forward(model, data)


def foot_forces(model, data):
    """Sum of the contact forces on each foot sphere, in W; and the number of the other contacts."""
    forces = {leg: np.zeros(3) for leg in LEGS}
    others = 0
    for i, contact in enumerate(data.contact):
        geoms = [model.geom(int(geom)).name for geom in contact.geom]
        feet = [leg for leg in LEGS if any(leg in name and "foot" in name.lower() for name in geoms)]
        if not feet:
            others += 1
            continue
        wrench = np.zeros(6)
        mujoco.mj_contactForce(model, data, i, wrench)
        # Along the contact frame's rows, from the first geom to the second.
        force = contact.frame.reshape(3, 3).T @ wrench[:3]
        foot_is_second = "foot" in geoms[1].lower()
        forces[feet[0]] += force if foot_is_second else -force
    return forces, others


def test_the_model_is_loaded_by_stock_mujoco(model, truths):
    assert (model.nq, model.nv, model.nu) == tuple(len(truths[0][key]) for key in ("qpos", "qvel", "ctrl"))


def test_the_centre_of_mass_is_the_logged_one(model, truths):
    data = mujoco.MjData(model)
    for truth in truths:
        forward(model, data, truth)
        assert data.subtree_com[1] == pytest.approx(truth["p_SCom"], abs=1e-9), truth["time"]


def test_the_base_stands_where_the_log_says(model, truths):
    for truth in truths:
        assert truth["qpos"][:3] == truth["p_SB"]
        assert truth["qpos"][3:7] == truth["q_SB"]


def test_the_contact_forces_are_the_logged_ones(model, truths):
    data = mujoco.MjData(model)
    loaded = 0
    for truth in truths:
        forward(model, data, truth)
        forces, others = foot_forces(model, data)
        assert others == 0, truth["time"]
        for leg in LEGS:
            logged = truth["feet"][leg]["force"]
            assert forces[leg] == pytest.approx(logged, abs=0.02, rel=1e-4), (truth["time"], leg)
            loaded += logged[2] > 20.0
    assert loaded > 2 * len(truths)


def test_the_push_is_in_the_log_at_its_time_and_nothing_else(pushed_log):
    for truth in messages(pushed_log, "/truth"):
        inside = PUSH["time"] < truth["time"] - 1e-6 and truth["time"] < PUSH["time"] + PUSH["duration"]
        outside = truth["time"] < PUSH["time"] - 1e-6 or truth["time"] > PUSH["time"] + PUSH["duration"] + 0.003
        loads = [load for load in truth["xfrc_applied"] if load != 0.0]
        assert not inside or loads == pytest.approx([30.0]), truth["time"]
        assert not outside or loads == [], truth["time"]


def test_the_forces_carry_the_robot(model, truths):
    """An oracle of its own: while it stands still, weight and ground forces balance."""
    weight = 9.81 * sum(model.body_mass)
    still = [truth for truth in truths if 0.2 < truth["time"] < 0.8]
    assert still
    for truth in still:
        upwards = sum(truth["feet"][leg]["force"][2] for leg in LEGS)
        assert upwards == pytest.approx(weight, rel=0.05)
