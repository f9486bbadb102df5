"""surefoot.campaign() on runs of the program: tables, cases, arrays and stacks."""

import pathlib
import sys

import numpy as np
import pytest

import surefoot
from program import ROOT


def test_a_campaign_gives_tables_and_compares_cases_seed_by_seed(tmp_path, monkeypatch):
    spec = {"name": "short", "scenario": "walk_flat_ideal", "seeds": [1, 2], "set": {"duration": 0.2},
            "cases": {"as it is": {}, "heavier": {"disturbances.payload.mass": 5.0}}}  # fmt: skip
    found = surefoot.campaign(spec, out=tmp_path / "results", jobs=1)
    assert found.table.num_rows == 4 and set(found.table["case"].to_pylist()) == {"as it is", "heavier"}
    assert sum(found.points[0]["outcomes"].values()) == 2 and found.pairs[0]["against"] == "as it is" and repr(found).startswith("<campaign short: ")
    assert list(found.frame["seed"]) == found.table["seed"].to_pylist()
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ModuleNotFoundError, match="pandas is not installed: `pip install pandas`, or use `.table`"):
        found.frame
    with pytest.raises(surefoot.Error, match="seeds"):
        surefoot.campaign({"scenario": "walk_flat"})
    with pytest.raises(surefoot.Error, match="choose another with out=$"):
        surefoot.campaign(spec | {"name": "other"}, out=tmp_path / "results", jobs=1)


@pytest.mark.parametrize("criteria, told", [({}, "2 not judged"), ({"criteria": None}, "2 of 2 runs succeeded")])
def test_of_a_campaign_runs_that_are_not_judged_are_told(tmp_path, criteria, told):
    spec = {"name": "short", "scenario": "walk_flat_ideal", "seeds": [1, 2], "set": {"duration": 0.05} | criteria}
    assert repr(surefoot.campaign(spec, out=tmp_path / "results", jobs=1)).startswith(f"<campaign short: {told}: ")


def test_a_campaign_takes_arrays_ranges_and_paths(tmp_path):
    spec = {"scenario": ROOT / "scenarios/walk_flat_ideal.yaml", "set": {"duration": np.float32(0.05)}, "grid": {"initial.x": np.linspace(0, 1, 2)}}
    names = set()
    for seeds in (np.arange(1, 3), range(1, 3), [np.int64(1), np.int64(2)], (1, 2)):
        found = surefoot.campaign(spec | {"seeds": seeds}, out=tmp_path / "results", jobs=1)
        names.add(found.summary["name"])
        assert sorted(found.table["seed"].to_pylist()) == [1, 1, 2, 2] and set(found.table["initial.x"].to_pylist()) == {0.0, 1.0}
    assert len(names) == 1, "equal specs are one campaign"


def test_campaigns_without_a_name_do_not_get_into_each_others_way(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    spec = {"scenario": "walk_flat_ideal", "seeds": [1, 2], "set": {"duration": 0.05, "user": [{"time": 0, "velocity": [0.1, 0]}]}}
    first, second = surefoot.campaign(spec, jobs=1), surefoot.campaign(spec | {"seeds": [3]}, jobs=1)
    assert first.folder != second.folder and first.frame["seed"].tolist() == [1, 2] and second.frame["seed"].tolist() == [3]
    assert surefoot.campaign(spec, jobs=1).folder == first.folder
    named = [surefoot.campaign(spec | {"name": "mine", "seeds": [seed]}, jobs=1) for seed in (4, 5)]
    assert [one.frame["seed"].tolist() for one in named] == [[4], [5]]


def test_a_campaign_compares_stacks(tmp_path):
    stack = surefoot.Stack("terrain_adaptation")
    spec = {"scenario": "walk_flat_ideal", "seeds": [1], "set": {"duration": 0.3}, "cases": {"as it is": {"stack": stack}, "soft": {"stack": stack.tune("com_xy", kp=20)}}}
    found = surefoot.campaign(spec, out=tmp_path / "results", jobs=1)
    assert [pathlib.Path(each).name for each in found.table["stack"].to_pylist()] == ["terrain_adaptation.yaml", "terrain_adaptation_2.yaml"]
    torques = dict(zip(found.table["case"].to_pylist(), found.table["torques_hash"].to_pylist(), strict=True))
    here = surefoot.run("walk_flat_ideal", seed=1, set=["duration=0.3"], stack=stack.tune("com_xy", kp=20)).torques_hash
    assert torques["soft"] == f"{here:016x}" != torques["as it is"]
    spec["cases"]["soft"]["stack"] = stack.tune("com_xy", kp=30)
    with pytest.raises(surefoot.Error, match="results has results of another stack terrain_adaptation_2; another `out`"):
        surefoot.campaign(spec, out=tmp_path / "results", jobs=1)

    class Mine(surefoot.OwnTask):
        max_rows = 1

        def rows(self, tick):
            return None

    with pytest.raises(surefoot.Error, match="stack terrain_adaptation has the task mine, which only this process knows"):
        surefoot.campaign({"scenario": "walk_flat_ideal", "seeds": [1], "set": {"stack": stack.last(Mine("mine"))}}, out=tmp_path / "other")
    with pytest.raises(surefoot.Error, match="spec: stack is a Stack; one under `set`, .* would be valid"):
        surefoot.campaign({"scenario": "walk_flat_ideal", "seeds": [1], "stack": stack, "grid": {"robot": ["anymal_b", "hyq"]}}, out=tmp_path / "other")


def test_a_stack_of_a_campaign_is_written_for_the_robot_of_its_runs(tmp_path):
    stack = surefoot.Stack("terrain_adaptation")
    spec = {"scenario": "walk_flat_ideal", "seeds": [1], "set": {"duration": 0.05}}
    by_case = {name: {"robot": name, "stack": stack} for name in ("anymal_b", "solo12")}
    found = surefoot.campaign(spec | {"cases": by_case}, out=tmp_path / "cases", jobs=1)
    texts = [pathlib.Path(file).read_text() for file in found.table["stack"].to_pylist()]
    assert texts == [stack.text(surefoot.Robot(name)) for name in by_case] and texts[0] != texts[1]
    robots = ["anymal_b", "solo12"]
    for varied in (
        {"grid": {"robot": robots}, "set": {"stack": stack}}, {"grid": {"robot": robots, "stack": [stack, stack.tune("com_xy", kp=300)]}},
        {"cases": {"own": {}, "small": {"robot": "solo12"}}, "set": {"stack": stack}},
        {"cases": {"own": {"stack": stack}, "other": {}}, "grid": {"robot": robots}},
    ):  # fmt: skip
        with pytest.raises(surefoot.Error, match="stack terrain_adaptation has other numbers for each of the robots .*solo12.*; a case for each robot"):
            surefoot.campaign(spec | varied, out=tmp_path / "other", jobs=1)
    assert not (tmp_path / "other").exists()
    own = surefoot.Stack(name="own").last(*(task for level in stack.levels() for task in level.tasks))
    spec = spec | {"set": {"duration": 0.05, "stack": own}, "grid": {"robot": ["anymal_b", "anymal_b_kinova"]}}
    same = surefoot.campaign(spec, out=tmp_path / "same", jobs=1)
    assert same.table.num_rows == 2, "numbers that are given are those of every robot"
