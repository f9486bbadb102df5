"""What a page commands of a live run comes to effect, and what is wrong with a command is told."""

import time

from live_page import Frames


def run_error(run, type, **members):
    with run.page() as page:
        reply = page.ask(type, **members)
    assert reply["ok"] is False
    return reply["error"]


def test_pause_step_and_speed(run):
    with run.page() as page:
        page.do("pause")
        tick = page.status(lambda status: status["paused"])["tick"]
        time.sleep(0.3)
        page.do("step", ticks=5)
        still = page.status(lambda status: status["tick"] != tick)
        page.do("speed", factor=0.125)
        page.do("resume")
        slow = page.status(lambda status: not status["paused"])
        time.sleep(1.0)
        later = page.status(lambda status: status["tick"] > slow["tick"] + 20)
        page.do("speed", factor=1.0)
    assert tick < still["tick"] <= tick + 20  # what was on the way, and the five
    assert later["time"] - slow["time"] < 1.0
    assert "valid is" in run_error(run, "speed", factor=100)


def test_a_push_moves_the_robot(run):
    with run.page() as page:
        page.do("push", body="base", impulse=[0, 15, 0], duration=0.1)
        page.change("push of 15 N·s")
        page.hear_for(1.0)
        sideways = [v[1] for v in Frames(run.session(), page.blocks).of("truth.v_SCom")]
    assert max(sideways) > 0.1
    assert "base" in run_error(run, "push", body="basis", impulse=[0, 1, 0], duration=0.1)
    assert "60 N·s" in run_error(run, "push", body="base", impulse=[0, 100, 0], duration=1)


def test_gains_order_and_friction_change(run):
    def gain(session):
        (task,) = [task for task in session["tasks"] if task["task"] == "com_xy"]
        return next(number["value"] for number in task["numbers"] if number["name"] == "kp")

    before = run.session()
    order = before["orders"][-1]["levels"]
    with run.page() as page:
        page.do("gain", level="com_xy", task="com_xy", name="kp", value=77.0)
        page.change("→ 77")
        yaw = order.index("torso_yaw")
        page.do("order", levels=[*order[: yaw - 1], order[yaw], order[yaw - 1], *order[yaw + 1 :]])
        page.change("order: torso_yaw")
        page.do("friction", value=0.25)
        page.change("→ 0.25")
        session = run.session()
        assert gain(session) == 77.0
        assert session["orders"][-1]["levels"].index("torso_yaw") == yaw - 1
        assert session["friction"] == 0.25
        assert session["generation"] > before["generation"]
        assert [channel["name"] for channel in session["channels"]] == [channel["name"] for channel in before["channels"]]
        assert page.status()["changes"] >= 3


def test_the_operator_commands_the_walk_and_gives_it_back(run):
    with run.page() as page:
        page.do("walk", walk=True, velocity=[0.05, 0.0], yaw_rate=0.1, height=0.0)
        status = page.status(lambda status: status["command"]["by"] == "operator" and status["command"]["yaw_rate"] != 0)
        assert status["command"] == {"walk": True, "velocity": [0.05, 0.0], "yaw_rate": 0.1, "height": 0.0, "gait": "", "by": "operator"}
        page.do("walk", by="scenario")
        page.status(lambda status: status["command"]["by"] == "scenario")


def test_a_reset_begins_the_run_again(run):
    with run.page() as page:
        generation = page.status()["generation"]
        page.do("reset")
        status = page.status(lambda status: status["generation"] > generation)
        assert status["time"] < 1.0
