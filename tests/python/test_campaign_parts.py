"""The parts of a campaign by themselves: specs that are refused, statistics, the journal, schedulers."""

import functools
import json
import math
import random
import signal
import sys
import threading
import time
import types

import pytest
from matplotlib.collections import LineCollection, PolyCollection

from campaign_folder import CASES, SPEC, CampaignFolder, is_running
from surefoot_campaign.draws import uniform_of
from surefoot_campaign.errors import InputError
from surefoot_campaign.journal import Journal, read_rows
from surefoot_campaign.outcome import ended_from_outside, judge
from surefoot_campaign.plan import explain
from surefoot_campaign.plots import curve_figure, map_figure
from surefoot_campaign.results import Record, arrow_column
from surefoot_campaign.scheduler import LocalScheduler, Task, make_scheduler
from surefoot_campaign.spec import load_spec, yaml_text
from surefoot_campaign.statistics import Z, median, median_interval, quantile, wilson_interval
from surefoot_campaign.units import label, metric_label, unit_of_parameter


@pytest.mark.parametrize(
    "successes, trials, low, high",
    [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)],
)
def test_wilsons_interval_has_the_published_values(successes, trials, low, high):
    """Newcombe 1998, table I."""
    assert wilson_interval(successes, trials) == pytest.approx((low, high), abs=5e-5)


def test_wilsons_interval_ends_where_the_rate_is_as_far_away_as_its_own_spread_allows():
    for trials in range(1, 60):
        for successes in range(trials + 1):
            low, high = wilson_interval(successes, trials)
            p = successes / trials
            assert 0 <= low <= p <= high <= 1
            for end in (low, high):
                assert abs(p - end) == pytest.approx(Z * math.sqrt(end * (1 - end) / trials), abs=1e-9)
    assert wilson_interval(0, 0) == (0.0, 1.0)


def test_quantiles_lie_between_the_values():
    assert quantile([], 0.5) is None
    assert quantile([3.0], 0.95) == 3.0
    assert quantile([4.0, 1.0, 2.0, 3.0], 0.5) == median([4.0, 1.0, 2.0, 3.0]) == 2.5
    assert median([]) is None and median([3, 1, 2]) == 2


def test_the_interval_of_a_median_has_the_ranks_of_the_binomial_tables():
    """Conover, Practical Nonparametric Statistics, table A3 with p = 1/2: n = 6, 10, 20, 100."""
    assert median_interval(list(range(5))) is None
    for count, rank in ((6, 0), (10, 1), (20, 5), (100, 39), (2000, 955)):
        assert median_interval(list(range(count))[::-1]) == [rank, count - 1 - rank]


def test_draws_are_uniform_and_those_of_different_names_have_nothing_to_do_with_each_other():
    first, second = ([uniform_of(seed, name) for seed in range(2000)] for name in ("a", "b"))
    for values in (first, second):
        assert 0 <= min(values) and max(values) < 1
        assert sum(values) / 2000 == pytest.approx(0.5, abs=0.03)
        assert sum(value**2 for value in values) / 2000 == pytest.approx(1 / 3, abs=0.03)
    assert sum(a * b for a, b in zip(first, second)) / 2000 == pytest.approx(0.25, abs=0.03)


def read(tmp_path, text):
    (tmp_path / "s.yaml").write_text(text)
    return load_spec(tmp_path / "s.yaml")


def test_a_spec_is_read_with_its_defaults(tmp_path):
    spec = read(tmp_path, "scenario: step_down\nseeds: {count: 2}\ngrid: {a: [1, -2e-3, no, 'x y', [1, 2]]}\n")
    assert (spec.name, spec.scenarios, spec.seeds) == ("s", ["step_down"], [1, 2])
    assert spec.grid["a"] == [1, -0.002, "no", "x y", [1, 2]]
    assert [yaml_text(value) for value in spec.grid["a"]] == ["1", "-0.002", "no", '"x y"', "[1, 2]"]
    assert (spec.timeout, spec.judge) == (600.0, "com_error_max_m")


HEAD = "scenario: fake\nseeds: [1]\n"
WRONG = {
    HEAD + "sceds: 3\n": 's.yaml:3: sceds: unknown key; did you mean "seeds"? valid are: ',
    "seeds: [1]\n": "s.yaml:1: scenario: this key is missing",
    "scenario: fake\n": "s.yaml:1: seeds: this key is missing",
    "scenario: []\nseeds: [1]\n": "s.yaml:1: scenario: the list is empty",
    "scenario: [fake, fake]\nseeds: [1]\n": "s.yaml:1: scenario: fake is given twice",
    HEAD + "cases: {a: {x: 1}}\n": "s.yaml:3: cases: must be a map of at least two cases",
    HEAD + "cases: {a: {}, b: 3}\n": "s.yaml:3: cases.b: must be a map",
    HEAD + "cases: {a: {x: 1}, b: {x: 1}}\n": "s.yaml:3: cases.b: another case has the same values",
    HEAD + "cases: {a: {}, b: {x: {y: 1}}}\n": "s.yaml:3: cases.b.x: must be a value",
    HEAD + "cases: {a: {}, b: {x: 1}}\ngrid: {x: [1, 2]}\n": "s.yaml:4: grid.x: this parameter stands at line 3 already",
    "scenario: fake\nseeds: []\n": "s.yaml:2: seeds: there are none",
    "scenario: fake\nseeds: {count: 0}\n": "s.yaml:2: seeds.count: 0 is not a whole number of at least 1",
    "scenario: fake\nseeds: {first: -1, count: 2}\n": "s.yaml:2: seeds.first: -1 is not a whole number of at least 0",
    "scenario: fake\nseeds: {frist: 1, count: 2}\n": 's.yaml:2: seeds.frist: unknown key; did you mean "first"?',
    "scenario: fake\nseeds: [1, 2, 1]\n": "s.yaml:2: seeds: 1 is given twice",
    "scenario: fake\nseeds: 5\n": "s.yaml:2: seeds: must be {first: 1, count: 100} or a list of seeds",
    "scenario: fake\nseeds: {count: 99999999999}\n": "s.yaml:2: seeds.count: 99999999999 is too many; from 1 to 1000000 seeds from 1 on are valid",
    "scenario: fake\nseeds: {first: 999999999, count: 2}\n": "s.yaml:2: seeds.count: 2 is too many; from 1 to 1 seeds from 999999999 on",
    "scenario: fake\nseeds: {first: 1000000000, count: 1}\n": "s.yaml:2: seeds.first: 1000000000 is above 999999999, the largest seed",
    "scenario: fake\nseeds: [1000000000]\n": "s.yaml:2: seeds: 1000000000 is above 999999999",
    HEAD + "grid:\n  height: []\n": "s.yaml:4: grid.height: the list is empty",
    HEAD + "grid:\n  height: 3\n": "s.yaml:4: grid.height: must be a list of values",
    HEAD + "grid:\n  height: [1, 2, 1]\n": "s.yaml:4: grid.height: 1 is given twice",
    HEAD + "grid:\n  height: [1]\n  height: [2]\n": 's.yaml:5: the key "height" is given twice',
    HEAD + "grid:\n": "s.yaml:3: grid: must be a map",
    HEAD + "grid: {}\n": "s.yaml:3: grid: is empty",
    HEAD + "draw:\n  mass: [2, 1]\n": "s.yaml:4: draw.mass: lower is above upper; [1, 2] would be valid",
    HEAD + "draw:\n  mass: [2, 2]\n": "s.yaml:4: draw.mass: the range [2, 2] is empty; one value belongs under set",
    HEAD + "draw:\n  mass: [a, 2]\n": 's.yaml:4: draw.mass: "a" is not a number',
    HEAD + "draw:\n  mass: [1, 2, 3]\n": "s.yaml:4: draw.mass: must be a range [lower, upper]",
    HEAD + "grid:\n  mass: [1]\nset:\n  mass: 2\n": "s.yaml:6: set.mass: this parameter stands at line 4 already",
    HEAD + "grid:\n  a.b: [1]\nset:\n  a: 2\n": 's.yaml:4: a.b: lies below "a" of line 6',
    HEAD + "set:\n  a: {b: 2}\n": "s.yaml:4: set.a: must be a value; write keys below it with dots",
    HEAD + "timeout: 1e-9\n": "s.yaml:3: timeout: 1e-09 is not a number of at least 1 s",
    HEAD + "draw:\n  a.b: [0, 1]\nset:\n  randomise.a.b: [0, 2]\n": "s.yaml:6: randomise.a.b: a.b is given at line 4; one of them is valid",
    HEAD + "grid:\n  a.b: [0, 1]\nset:\n  randomise.a.b: [0, 2]\n": "s.yaml:6: randomise.a.b: a.b is given at line 4; one of them is valid",
    HEAD + "timeout: long\n": 's.yaml:3: timeout: "long" is not a number',
    HEAD + "name: ../x\n": 's.yaml:3: name: "../x" is no name for a folder',
    HEAD + "set: {a: 1}\nunits: {b: m}\n": "s.yaml:4: units.b: no such parameter; valid are: a",
    HEAD + "units: {b: m}\n": "s.yaml:3: units.b: no such parameter; valid are those of cases, grid, draw and set, which are not there",
    HEAD + "name: [\n": "this is not YAML",
    "- a\n": "s.yaml: must be YAML of the form",
    "": "s.yaml: must be YAML of the form",
    "a: &a [*a]\n": "s.yaml: an alias leads to itself",
}


@pytest.mark.parametrize("text", WRONG)
def test_a_wrong_spec_is_refused_with_file_line_and_key(tmp_path, text):
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    assert WRONG[text] in str(error.value)


REFUSED = {
    SPEC.replace("height:", "hieght:"): "spec.yaml:4: grid: hieght=0.1: hieght: unknown key; valid are: height, mass, ",
    SPEC.replace("[0.0, 6.9]", "[-1, 6.9]"): 'spec.yaml:6: draw: mass=-1.0: mass: "-1.0" is not a number of at least 0',
    SPEC.replace("fake", "[fake, fkae]"): 'spec.yaml:1: scenario fkae: unknown scenario "fkae"; valid are: fake, other',
    SPEC + "judge: com_error\n": 'judge: unknown metric "com_error"; did you mean "com_error_max_m"?',
    SPEC + "judge: tick_us.median\n": "judge: tick_us.median depends on the machine's clock; valid are: com_error_max_m",
    SPEC + "sceds: 3\n": "spec.yaml:9: sceds: unknown key",
    CASES.replace("{mass: 8", "{masss: 8").replace("{mode: crash", "{masss: 9, mode: crash"): "spec.yaml:5: cases.heavy: masss=8: masss: unknown key",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_the_program_does_not_know_is_refused_before_anything_runs(tmp_path, text):
    assert REFUSED[text] in CampaignFolder(tmp_path).write(text).complaint()


def test_a_scenarios_file_that_is_missing_is_told_with_all_folders_that_it_was_looked_for_in(tmp_path):
    (tmp_path / "spec.yaml").write_text(SPEC.replace("fake", "mine.yaml"))
    spec = load_spec(tmp_path / "spec.yaml")
    said = explain(spec, "mine.yaml", None, {}, 'there is no file "mine.yaml" in /here or /data/scenarios; valid are: walk_flat')
    assert said.endswith(f'there is no file "mine.yaml" in {tmp_path}, /here or /data/scenarios; valid are: walk_flat')


@pytest.mark.parametrize("wrong", [["--jobs", "0"], ["--jbos", "2"], ["--scheduler", "slurm"]])
def test_wrong_arguments_are_told_in_one_line(tmp_path, wrong):
    assert wrong[0] in CampaignFolder(tmp_path).write().complaint(*wrong)


def test_an_empty_name_of_the_folder_is_refused(tmp_path):
    said = CampaignFolder(tmp_path).write().complaint("--out", "")
    assert "--out: the name is empty; the name of a folder to write into is valid" in said
    assert sorted(file.name for file in tmp_path.iterdir()) == ["spec.yaml"]


def test_a_spec_that_is_not_there_is_told(tmp_path):
    assert "spec.yaml: this file can't be read: No such file" in CampaignFolder(tmp_path).complaint()


@pytest.mark.parametrize("torn", [b'{"id":"half', b'{"id":"half\n', b"\0\0\0\n", b"[]\n"])
def test_the_journal_drops_a_torn_last_line_only(tmp_path, torn):
    path = tmp_path / "rows.jsonl"
    with Journal(path) as journal:
        journal.append({"id": "a"})
        journal.append({"id": "b", "text": "line\nbreak"})
    whole = path.read_bytes()
    path.write_bytes(whole + torn)
    assert list(read_rows(path)) == ["a", "b"] and path.read_bytes() == whole + torn  # reading changes nothing
    with Journal(path) as journal:
        journal.append({"id": "c"})
        assert list(journal.rows) == ["a", "b", "c"]
    assert [json.loads(line)["id"] for line in path.read_text().splitlines()] == ["a", "b", "c"]


def test_the_journal_tells_a_broken_line_in_its_middle(tmp_path):
    path = tmp_path / "rows.jsonl"
    path.write_text('{"id":"a"}\nnonsense\n{"id":"b"}\n')
    with pytest.raises(InputError, match="rows.jsonl:2: "):
        Journal(path)
    assert "nonsense" in path.read_text()


TASKS = [Task(str(number), ["sh", "-c", f"echo {number}; exit {number}"], 30.0) for number in range(5)]


class FakeRay(types.ModuleType):
    """Ray's few functions that are used, without a cluster."""

    def __init__(self):
        super().__init__("ray")
        self.__spec__ = types.SimpleNamespace(name="ray")
        self.most, self.cancelled, self.started, self.lost = 0, [], False, None
        lost = type("RayError", (Exception,), {})
        self.exceptions = types.SimpleNamespace(RayError=lost, RayTaskError=type("RayTaskError", (lost,), {}))

    def is_initialized(self):
        return self.started

    def init(self, **_):
        self.started = True

    def remote(self, **_):
        return lambda function: types.SimpleNamespace(remote=lambda task: functools.partial(function, task))

    def wait(self, running, num_returns, timeout):
        self.most = max(self.most, len(running))
        return running[-1:], running[:-1]

    def get(self, reference):
        if reference.args[0].id == self.lost:
            raise self.exceptions.RayError("The worker died.\nIts node is gone.")
        return reference()

    def cancel(self, reference, force):
        self.cancelled.append(reference)


@pytest.fixture
def ray(monkeypatch):
    module = FakeRay()
    monkeypatch.setitem(sys.modules, "ray", module)
    monkeypatch.delitem(sys.modules, "surefoot_campaign.ray_scheduler", raising=False)
    yield module
    sys.modules.pop("surefoot_campaign.ray_scheduler", None)


@pytest.mark.parametrize("kind", ["local", "ray"])
def test_every_scheduler_gives_the_result_of_each_task_once(kind, ray):
    results = list(make_scheduler(kind, 2).run(TASKS))
    assert sorted(result.id for result in results) == [task.id for task in TASKS]
    for result in results:
        assert result.stdout == f"{result.id}\n" and result.status == int(result.id) and not result.timed_out


@pytest.mark.parametrize("kind", ["local", "ray"])
def test_every_scheduler_ends_what_takes_too_long(kind, ray):
    (result,) = make_scheduler(kind, 1).run([Task("a", ["sleep", "100"], 0.2)])
    assert result.timed_out and result.status < 0 and result.wall_time < 60


def test_ray_has_as_many_tasks_at_once_as_jobs_and_cancels_them_when_it_is_left(ray):
    running = make_scheduler("ray", 2).run(TASKS)
    next(running)
    running.close()
    assert ray.most == 2 and len(ray.cancelled) == 2


def test_a_task_that_ray_lost_is_a_crash_and_the_others_go_on(ray):
    ray.lost = TASKS[1].id
    results = {result.id: result for result in make_scheduler("ray", 2).run(TASKS)}
    assert len(results) == len(TASKS)
    outcome, reason, _ = judge(TASKS[1], results[ray.lost])
    assert outcome == "crashed" and reason == "exit code 255: lost by Ray: The worker died."


def test_without_ray_its_scheduler_is_refused(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    with pytest.raises(InputError, match="the Python package ray is not installed here"):
        make_scheduler("ray", 1)


def test_the_local_scheduler_ends_what_runs_when_it_is_left(tmp_path):
    pid = tmp_path / "pid"
    long = Task("long", ["sh", "-c", f"echo $$ > {pid}; exec sleep 100"], 999.0)
    quick = Task("quick", ["sh", "-c", f"until [ -s {pid} ]; do sleep 0.05; done"], 999.0)
    scheduler = LocalScheduler(2).run([long, quick])
    assert next(scheduler).id == "quick"
    assert is_running(int(pid.read_text()))
    scheduler.close()
    assert not is_running(int(pid.read_text()))


@pytest.mark.parametrize("times", [1, 2])
def test_the_local_scheduler_lets_what_runs_end_when_it_is_stopped_and_kills_it_when_asked_again(tmp_path, times):
    ready, how = tmp_path / "ready", "exit 3" if times == 1 else ":"
    stubborn = Task("long", ["sh", "-c", f"trap '{how}' TERM; touch {ready}; while :; do sleep 0.02; done"])
    scheduler = LocalScheduler(1)

    def stop():
        while not ready.exists():
            time.sleep(0.02)
        for _ in range(times):
            scheduler.stop()

    thread = threading.Thread(target=stop)
    thread.start()
    results = list(scheduler.run([stubborn, Task("never", ["true"])]))
    thread.join()
    assert [(result.id, result.status) for result in results] == [("long", 3 if times == 1 else -signal.SIGKILL)] and scheduler.stopped
    assert ended_from_outside(results[0], scheduler.stopped) == (times == 2)


def test_units_stand_where_they_are_known(tmp_path):
    spec = read(tmp_path, HEAD + "set: {disturbances.payload.mass: 1, terrain.friction: 1, a: 1}\nunits: {a: bar}\n")
    labels = [label(name, unit_of_parameter(name, spec)) for name in spec.parameters()]
    assert labels == ["disturbances.payload.mass [kg]", "terrain.friction", "a [bar]"]
    assert [metric_label(name) for name in ["com_error_max_m", "tick_us.p99", "speed_mps", "steps_taken"]] == [
        "com_error_max_m [mm]", "tick_us.p99 [µs]", "speed_mps [m/s]", "steps_taken"
    ]  # fmt: skip


def fake_campaign(tmp_path, drawn, scenarios=("fake",), seeds=80):
    """A plan and its records over parameters from 1 to 9; `drawn`: (value, COM error) of each run, which fell from 0.1 m on."""
    text = f"scenario: [{', '.join(scenarios)}]\nseeds: {{count: {seeds}}}\ndraw: {{friction: [1, 9], mass: [1, 9]}}\n"
    plan = types.SimpleNamespace(spec=read(tmp_path, text))
    records = []
    for scenario in scenarios:
        for value, error in drawn:
            run = types.SimpleNamespace(scenario=scenario, value={"friction": value, "mass": value}.get)
            result = {} if error is None else {"com_error_max_m": error}
            row = {"outcome": "succeeded" if error is not None and error < 0.1 else "failed", "result": result}
            records.append(Record(run, row))
    return plan, records


def curves(tmp_path, drawn, scenarios=("fake",), seeds=80):
    """The two axes over one of them."""
    return curve_figure(*fake_campaign(tmp_path, drawn, scenarios, seeds), "friction").axes


def test_a_plot_of_a_metric_that_no_run_has_says_so(tmp_path):
    upper, lower = curves(tmp_path, [(1.5, None), (7.5, None)])
    assert "no run has a value" in texts_of(lower) and "no run has a value" not in texts_of(upper)
    panels = map_figure(*fake_campaign(tmp_path, [(1.5, None), (7.5, None)]), "fake", ("friction", "mass")).axes
    assert ["no run has a value" in texts_of(axes) for axes in panels] == [False, True, False]  # the last: a scale
    for axes in curves(tmp_path, [(1.5, 0.01), (7.5, None)]):
        assert "no run has a value" not in texts_of(axes)


def texts_of(axes):
    return [text.get_text() for text in axes.texts]


def intervals_seen(axes):
    """(x, low, high) of each bar, and of each place of a band that has a width."""
    seen = set()
    for drawn in axes.collections:
        if isinstance(drawn, LineCollection):
            seen |= {(x, low, high) for (x, low), (_, high) in drawn.get_segments()}
        elif isinstance(drawn, PolyCollection):
            for path in drawn.get_paths():
                heights = {}
                for x, y in path.vertices:
                    heights.setdefault(x, []).append(y)
                seen |= {(x, min(of_x), max(of_x)) for x, of_x in heights.items() if len(heights) > 1}
    return sorted(seen)


def lines_drawn(axes):
    """From which place to which there is a line."""
    x, y = axes.lines[-1].get_data()
    return {(x[i], x[i + 1]) for i in range(len(x) - 1) if math.isfinite(y[i]) and math.isfinite(y[i + 1])}


def test_every_bin_shows_its_interval_and_gaps_stay_open_whatever_bins_are_empty(tmp_path):
    chance = random.Random(3)
    for _ in range(30):
        filled = {cell: chance.randint(1, 4) for cell in range(8) if chance.random() < 0.6}
        errors = [0.001, 0.002, 0.5]
        runs = [(cell + 1.2, chance.choice(errors)) for cell, count in filled.items() for _ in range(count)]
        upper, lower = curves(tmp_path, runs)
        wanted = []
        for cell, count in sorted(filled.items()):
            fallen = sum(error == 0.5 for value, error in runs if value == cell + 1.2)
            wanted.append((cell + 1.5, *(100 * end for end in wilson_interval(count - fallen, count))))
        assert [pytest.approx(interval) for interval in wanted] == intervals_seen(upper)
        assert [x for x, _, _ in intervals_seen(lower)] == [x for x, _, _ in wanted]
        for axes in (upper, lower):
            assert lines_drawn(axes) == {(cell + 1.5, cell + 2.5) for cell in filled if cell + 1 in filled}
            assert axes.get_xlim() == (1, 9)


def test_bars_of_several_scenarios_do_not_hide_each_other_and_stay_in_their_bin(tmp_path):
    for count in (2, 5, 12):
        upper, _ = curves(tmp_path, [(2.0, 0.001)], [f"s{number}" for number in range(count)], seeds=3)
        places = [x for x, _, _ in intervals_seen(upper)]
        assert len(set(places)) == count and 1 < min(places) and max(places) < 5


def test_a_fall_leaves_the_other_medians_readable(tmp_path):
    walks = [(value + 0.5, 0.001 * value) for value in range(1, 9)]
    falls, zero = [(2.2, 0.5)], [(8.5, 0.0)]
    assert curves(tmp_path, walks)[1].get_yscale() == "linear"
    assert curves(tmp_path, walks[:-1] + zero + falls)[1].get_yscale() == "linear"
    _, lower = curves(tmp_path, walks + falls)
    assert lower.get_ylabel() == "com_error_max_m [mm]"
    lowest, highest = (lower.transData.transform((1, error))[1] for error in (0.003, 0.008))
    assert highest - lowest > 0.1 * lower.bbox.height


def test_a_figure_of_a_campaign_without_values_is_made(tmp_path):
    upper, lower = curves(tmp_path, [])
    assert upper.get_xlim() == (1, 9) and intervals_seen(upper) == intervals_seen(lower) == []


def test_a_column_without_a_value_is_one_of_numbers():
    import pyarrow

    assert arrow_column([None, None]).type == pyarrow.float64() and arrow_column([None, True]).type == pyarrow.bool_()
    assert arrow_column([1, None]).to_pylist() == [1.0, None] and arrow_column(["a", None, 2.5]).to_pylist() == ["a", None, "2.5"]


def test_a_campaign_that_ships_is_told_where_its_file_is_asked_for(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match="there is no campaigns/step_down_height.yaml here; did you mean step_down_height, which ships"):
        load_spec("campaigns/step_down_height.yaml")
