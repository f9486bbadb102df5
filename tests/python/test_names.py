"""Dicts by names: they name what they have, and elsewhere are plain dicts."""

import copy
import pathlib
import pickle
import re

import yaml

import surefoot
from surefoot import _named

WHOLE = {"Explanation.facts", "stack_levels", "parse_stack"}  # JSON as it is; what surefoot's own Python reads


def test_every_function_and_property_that_gives_a_dict_is_listed():
    stub = (pathlib.Path(surefoot.__file__).parent / "_core.pyi").read_text()
    found, kind = set(), ""
    for line in stub.splitlines():
        if begins := re.match(r"class (\w+)", line):
            kind = begins[1] + "."
        if begins := re.match(r"( *)def (\w+).*-> .*dict\[str", line):
            found.add((kind if begins[1] else "") + begins[2])
    listed = {f"{name}.{member}" for name, members in _named.OF_OBJECTS.items() for member in members}
    assert found == listed | {*_named.OF_FUNCTIONS} | WHOLE


def test_dicts_are_pickled_and_written_as_plain_ones(log):
    recorded = surefoot.read(log)
    com = surefoot.Stack("terrain_adaptation")["com_xy"].tasks[0]
    for given in (recorded.metrics, recorded.channels, surefoot.scenarios(), surefoot.catalog()[0], com.parameters):
        assert type(given) in (_named.Named, _named.Parameters)
        sent = pickle.dumps(given)
        assert b"_named" not in sent
        for plain in (pickle.loads(sent), copy.deepcopy(given)):
            assert type(plain) is dict and str(plain) == str(given)
        for dump in (yaml.safe_dump, yaml.dump):
            assert str(yaml.safe_load(dump(given, sort_keys=False))) == str(given)
    with_numbers = next(each for each in surefoot.catalog() if each["numbers"])
    assert type(pickle.loads(pickle.dumps(with_numbers))["numbers"][0]) is dict


def test_json_as_a_whole_is_plain(log):
    recorded = surefoot.read(log)
    assert type(recorded.header) is dict
    assert type(surefoot.explain(recorded, 0.005).facts) is dict
