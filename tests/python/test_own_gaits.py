"""Gaits written in Python within the library's planner; and what a log says of parts that are the user's own."""

import json
import warnings

import numpy as np
import pytest
from program import surefoot as program

import surefoot
from surefoot import Gait, Stack

SUPPORT, SWING, CYCLE = 0.8, 0.6, 5.6  # s


class Crawl(Gait):
    """A leg after the other, as slowly as it takes."""

    def begin(self, now):
        self.turn, self.lift_off = 0, None

    def stride_duration(self):
        return CYCLE

    def go_on(self, now):
        leg = ("RH", "RF", "LH", "LF")[self.turn % 4]
        if self.lift_off is None and now.all_down:
            if not now.user.walk or now.yields:
                return True
            self.lift_off, self.to = now.time + SUPPORT, now.foothold(leg, CYCLE)
            now.plan_com([(leg, SUPPORT, SWING, self.to)])
            now.unload(leg, self.lift_off)
        elif self.lift_off is not None and now.time >= self.lift_off and now.is_unloaded(leg):
            now.lift(leg, self.to, SWING)
            self.lift_off, self.turn = None, self.turn + 1
        return False


def walking(gait, duration=6.0, **options):
    user = "user=[{time: 0.2, walk: true, velocity: [0.1, 0], gait: mine}]"
    words = [f"duration={duration}", "planner.calibration.duration=0", "criteria=none", user]
    return surefoot.load_scenario("walk_flat_ideal", gaits={"mine": gait}, set=words, **options)


def test_a_gait_of_ones_own_lifts_legs_and_sets_them_down():
    result = surefoot.run(walking(Crawl, duration=20.0))
    assert result["steps_taken"] >= 8 and not result["fell"] and result.fault == ""
    assert result["distance_m"] > 0.3


def test_as_it_is_it_stands_and_each_controller_makes_one():
    made = []

    class Still(Gait):
        def __init__(self):
            super().__init__()
            made.append(self)

        def restart(self):
            made.append("restart")

    scenario = walking(Still, duration=1.0)
    assert scenario.gaits == ["mine"] and made == []
    assert surefoot.run(scenario)["steps_taken"] == 0
    surefoot.run(scenario)
    gaits = [each for each in made if each != "restart"]
    assert len(gaits) == 2 and gaits[0] is not gaits[1]


def test_a_command_that_changes_is_followed_from_the_next_step():
    seen = set()

    class Watching(Crawl):
        def go_on(self, now):
            seen.add(round(float(now.user.velocity[0]), 3))
            return super().go_on(now)

    user = "user=[{time: 0.2, walk: true, velocity: [0.02, 0], gait: mine}, {time: 2, walk: true, velocity: [0.04, 0], gait: mine}]"
    words = ["duration=8", "planner.calibration.duration=0", "criteria=none", user]
    surefoot.run("walk_flat_ideal", gaits={"mine": Watching}, set=words)
    assert seen == {0.02, 0.04}


def test_its_torso_bounces():
    class Bouncing(Gait):
        def begin(self, now):
            self.begins = self.now = now.time

        def go_on(self, now):
            self.now = now.time
            return super().go_on(now)

        def bounce(self):
            phase = 6.0 * (self.now - self.begins)
            return 0.01 * (1 - np.cos(phase)), 0.06 * np.sin(phase), 0.36 * np.cos(phase)

    heights = []
    surefoot.run(walking(Bouncing, duration=4.0), every_tick=lambda tick: heights.append(tick.controller.plan.torso.height))
    assert np.ptp(heights[800:]) == pytest.approx(0.02, abs=1e-3)


def test_its_torso_pitches_nose_down():
    class Nodding(Gait):
        def begin(self, now):
            self.begins = self.now = now.time

        def go_on(self, now):
            self.now = now.time
            return super().go_on(now)

        def pitch(self):
            phase = 3.0 * (self.now - self.begins)
            return 0.05 * (1 - np.cos(phase)), 0.15 * np.sin(phase), 0.45 * np.cos(phase)

    nose, rates = [], []

    def every_tick(tick):
        w, x, y, z = tick.controller.plan.torso.q_WB
        nose.append(2 * (x * z - w * y))  # height of the forward axis
        rates.append(tick.controller.plan.torso.w_WB[1])

    assert not surefoot.run(walking(Nodding, duration=4.0), every_tick=every_tick)["fell"]
    assert min(nose) == pytest.approx(-np.sin(0.1), abs=0.01) and max(nose) == pytest.approx(0, abs=0.01)
    assert max(rates) == pytest.approx(0.15, abs=0.01)


class Pairs(Gait):
    """Diagonal pairs, one after the other, from 0.5 s on."""

    pairs, swing = [("LF", "RH"), ("RF", "LH")], 0.35

    def begin(self, now):
        self.left = list(self.pairs)

    def go_on(self, now):
        if now.time > 0.5 and now.all_down and self.left:
            pair = self.left.pop(0)
            for leg in pair:
                now.lift(leg, now.foothold(leg, 1.0), self.swing)
            assert not any(map(now.is_down, pair))
        return False


@pytest.mark.parametrize("robot", ["anymal_b", "hexapod"])
def test_legs_that_are_in_the_air_together_are_all_counted(robot):
    class Steps(Pairs):
        pairs = Pairs.pairs if robot == "anymal_b" else [("LF", "RM", "LH"), ("RF", "LM", "RH")]

    taken, events = [0], []

    def every_tick(tick):
        taken.append(tick.controller.steps_taken)
        events.extend((event.name, event.leg) for event in tick.controller.plan.events)

    user = "user=[{time: 0.2, walk: true, velocity: [0.05, 0], gait: mine}]"
    words = ["duration=3", "planner.calibration.duration=0", "criteria=none", user]
    result = surefoot.run("walk_flat_ideal", robot=robot, gaits={"mine": Steps}, set=words, every_tick=every_tick)
    legs = sorted(leg for pair in Steps.pairs for leg in pair)
    assert sorted(leg for name, leg in events if name == "lift-off") == sorted(leg for name, leg in events if name == "touchdown") == legs
    assert taken[-1] == len(legs) and not result["fell"] and result.fault == ""


@pytest.mark.parametrize(("speed", "waits"), [(0.0, False), (3.0, True)])
def test_another_gait_waits_until_it_is_slow(speed, waits):
    yields = []

    class Quick(Gait):
        def go_on(self, now):
            yields.append(now.yields)
            return super().go_on(now)

    Quick.speed = lambda gait: speed
    user = "user=[{time: 0.2, walk: true, gait: mine}, {time: 1, walk: true, gait: trot}]"
    words = ["duration=2", "planner.calibration.duration=0", "criteria=none", user]
    surefoot.run("trot", gaits={"mine": Quick}, set=words)
    assert any(yields) is not waits


@pytest.mark.parametrize("is_static", [True, False])
def test_one_that_is_not_static_stops_step_by_step(is_static):
    velocities = []

    class Crawling(Crawl):
        def go_on(self, now):
            if not now.user.walk:
                velocities.append(float(now.user.velocity[0]))
            super().go_on(now)
            return False

    Crawling.is_static = lambda gait: is_static
    user = "user=[{time: 0.2, walk: true, velocity: [0.1, 0], gait: mine}, {time: 2, walk: false, velocity: [0.1, 0]}]"
    words = ["duration=6", "planner.calibration.duration=0", "criteria=none", user]
    surefoot.run("walk_flat_ideal", gaits={"mine": Crawling}, set=words)
    assert (velocities[-1] == 0.0) is not is_static


def kept(gait, now):
    if getattr(gait, "kept", None) is not None:
        return gait.kept.time
    gait.kept = now
    return now.com


def test_a_gait_without_super_init_is_one(recwarn):
    class Slow(Crawl):
        def __init__(self, cycle):
            self.cycle = cycle

        def stride_duration(self):
            return self.cycle

        def go_on(self, now):
            super().go_on(now)
            return Gait.go_on(self, now)

    assert surefoot.run(walking(lambda: Slow(CYCLE), duration=1.0)).fault == "" and not recwarn.list
    assert Slow(1.0).height() == Gait().height() == 0.0
    with pytest.raises(surefoot.Error, match=r"^Gait\(\): too many positional arguments"):
        Gait(1)


@pytest.mark.parametrize(("base", "slip", "near"), [(Gait, "goon", "go_on"), (Gait, "stride_durations", "stride_duration"), (surefoot.Planner, "restrat", "restart"),
                                                    (surefoot.Estimator, "updat", "update")])  # fmt: skip
def test_a_method_whose_name_has_a_slip_is_told_where_it_is_written(base, slip, near):
    def method(self, *given):
        return True

    said = rf"^Mine.{slip}: {base.__name__} calls no {slip}; did you mean {near}\? one of your own could be called _{slip}$"
    with pytest.warns(UserWarning, match=said) as warned:
        type("Mine", (base,), {slip: method})
    assert warned[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for names in ([slip, near], ["_" + slip], ["helps", "weight", "start"]):
            type("Mine", (base,), dict.fromkeys(names, method))


WRONG = {
    "raises": ({"go_on": lambda gait, now: 1 / 0}, 'gait "mine": ZeroDivisionError: '),
    "no truth": ({"go_on": lambda gait, now: "yes"}, "go_on returned 'yes'; True or False would be valid"),
    "no plan": ({"com": lambda gait, now: [0, 0]}, "com returned [0, 0]; a ComPlan would be valid"),
    "moves in com": ({"com": lambda gait, now: now.unload("LF", 1.0)}, "the legs are moved in begin() and go_on() only"),
    "keeps": ({"com": kept}, "this tick is over"),
    "leg": ({"begin": lambda gait, now: now.unload("XF", 1.0)}, 'no leg "XF"; before.feet has their names'),
    "lifts in the air": ({"begin": lambda gait, now: [now.lift("LF", now.foothold("LF", 1.0), 0.5) for _ in range(2)]}, "LF is in the air; a leg that stands would be valid: RF, LH, RH"),
    "unloads in the air": ({"begin": lambda gait, now: (now.lift("LF", now.foothold("LF", 1.0), 0.5), now.unload("LF", 9.0))}, "LF is in the air; a leg that stands would be valid"),
    "many steps": ({"begin": lambda gait, now: now.plan_com([("LF", 0.5, 0.4, now.foothold("LF", 1.0))] * 5)}, "steps has 5 steps; with 0 legs in the air at most 4 would be valid"),
    "cycle": ({"begin": lambda gait, now: now.foothold("LF", np.nan)}, "cycle is nan; a time [s] of at least 0 would be valid"),
    "apex": ({"begin": lambda gait, now: now.lift("LF", now.foothold("LF", 1.0), 0.5, apex=-0.1)}, "apex is -0.100000; a height [m] of at least 0 would be valid"),
    "nan": ({"begin": lambda gait, now: now.lift("LF", [0, 0, np.nan], 0.5)}, "to[2] is nan; a finite number would be valid"),
    "no bounce": ({"bounce": lambda gait: 0.1}, "bounce returned 0.1; (height, velocity, acceleration) [m, m/s, m/s²] would be valid"),
    "no pitch": ({"pitch": lambda gait: [0, 0]}, "pitch returned [0, 0]; (angle, rate, acceleration) [rad, rad/s, rad/s²] would be valid"),
    "static": ({"is_static": lambda gait: None}, "is_static returned None; True or False would be valid"),
    "in the air": ({"begin": lambda gait, now: now.lift("LF", now.foothold("LF", 1.0), 0.5), "go_on": lambda gait, now: True}, "with a foot in the air"),
}  # fmt: skip


@pytest.mark.parametrize(("methods", "said"), WRONG.values(), ids=WRONG)
def test_a_gait_that_goes_wrong_is_named_and_the_robot_sits_down(methods, said):
    with pytest.warns(RuntimeWarning, match="gait"):
        result = surefoot.run(walking(type("Mine", (Gait,), methods), duration=4.0))
    assert said in result.fault and 'gait "mine": ' in result.fault
    if "begin" not in methods:  # that is called once
        assert not result.succeeded and "own" in result.reason


def test_nan_in_its_plan_is_told():
    def com(gait, now):
        plan = now.com
        plan.p[0] = np.nan
        return plan

    with pytest.warns(RuntimeWarning, match='gait "mine": com\\(\\) gave NaN or infinity'):
        surefoot.run(walking(type("Mine", (Gait,), {"com": com}), duration=1.0))


@pytest.mark.parametrize(("make", "said"), [(dict, "gait \"mine\" is made as {}; an object of a class derived from surefoot.Gait would be valid"),
                                            (lambda: 1 / 0, "ZeroDivisionError")])  # fmt: skip
def test_what_makes_no_gait_is_refused(make, said):
    with pytest.raises(surefoot.Error, match="(?s).*" + said.replace("(", r"\(").replace("{}", r"\{\}")):
        surefoot.run(walking(make))


def verified(log):
    done = program("replay", log, "--verify", "--json")
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout)


class Nodding(surefoot.Planner):
    def update(self, user, state, dynamics, last):
        plan = super().update(user, state, dynamics, last)
        plan.torso.height += 0.01 * np.sin(3 * state.time)
        return plan


class Believing(surefoot.Estimator):
    def update(self, reading, context):
        return super().update(reading, context)


def test_a_log_says_which_parts_were_the_users_own_and_replays_what_they_gave(tmp_path):
    scenario = surefoot.load_scenario("walk_flat", set=["duration=3", "planner.calibration.duration=0"])
    parts = {"planner": Nodding(scenario), "estimator": Believing(scenario)}
    assert surefoot.run(scenario, record=tmp_path / "run.mcap", **parts)["steps_taken"] > 0
    assert surefoot.read(tmp_path / "run.mcap").header["own_parts"] == ["estimator", "planner"]
    found = verified(tmp_path / "run.mcap")
    assert found["same"] and found["ticks"] == 1200 and not found["estimated"]
    assert found["played_back"] == ["planner", "estimator"]
    text = program("replay", tmp_path / "run.mcap", "--verify").stdout
    assert "Not run again, as they are of the program that recorded the log: planner, estimator." in text
    assert "own parts    estimator, planner: the command above alone gives another run" in program("info", tmp_path / "run.mcap").stdout


def test_a_calibration_under_ones_own_planner_replays(tmp_path):
    scenario = surefoot.load_scenario("walk_flat_mismatch", seed=2, set=["duration=13"])
    surefoot.run(scenario, record=tmp_path / "run.mcap", planner=Nodding(scenario))
    assert verified(tmp_path / "run.mcap")["same"]


def test_a_log_of_ones_own_gait_replays_with_its_faults(tmp_path):
    class Stumbling(Crawl):
        def go_on(self, now):
            if abs(now.time - 4.0) < 0.01:
                raise ValueError("no idea")
            return super().go_on(now)

    with pytest.warns(RuntimeWarning, match="no idea"):
        surefoot.run(walking(Stumbling), record=tmp_path / "run.mcap")
    assert verified(tmp_path / "run.mcap")["played_back"] == ["gait mine"]


def test_a_log_of_ones_own_task_is_refused_with_its_name(tmp_path):
    class Still(surefoot.OwnTask):
        max_rows = 3

        def rows(self, tick):
            return tick.dynamics.base.J, -20 * tick.dynamics.base.v - tick.dynamics.base.Jdot_u

    stack = Stack("terrain_adaptation").replace("torso_height", Still("still"))
    surefoot.run("walk_flat_ideal", stack=stack, set=["duration=0.5"], record=tmp_path / "run.mcap")
    done = program("replay", tmp_path / "run.mcap", "--verify")
    assert done.returncode == 2
    assert "the run's task still is the user's own and was not given" in done.stderr


def test_a_run_between_its_ticks_can_take_another_stack():
    def every_tick(tick):
        if tick.time == 1.0:
            assert tick.controller.set_stack(Stack("terrain_adaptation").tune("com_xy", kp=300), duration=0.2)

    result = surefoot.run("walk_flat_ideal", stack="terrain_adaptation", set=["duration=2"], every_tick=every_tick)
    assert not result["fell"] and result.fault == ""
