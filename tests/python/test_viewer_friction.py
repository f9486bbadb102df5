"""What the viewer's page tells of friction is what the controller's own pyramids leave."""

import re

import pytest

from conftest import record
from live_page import Served
from log_file import messages
from viewer_page import channel, go_to, show

LEGS = ("LF", "RF", "LH", "RH")


@pytest.fixture(scope="module")
def slippery(tmp_path_factory):
    """A log of a controller that believes in so little friction that its pyramids hold its forces."""
    path = tmp_path_factory.mktemp("log") / "slippery.mcap"
    return record(path, "--set", "planner.force.friction=0.1", "--set", "stack=terrain_adaptation", duration=3)


def legs_at_a_face(hierarchy):
    rows = [row["row"] for row in hierarchy["active"] if row["level"] == "friction_cone" and abs(row["state"]) == 1]
    return {row.split()[0] for row in rows if " slip " in row}


def test_a_foot_whose_pyramid_is_active_uses_all_of_its_friction(browser, slippery):
    found = [(tick, legs_at_a_face(one)) for tick, one in enumerate(messages(slippery, "/hierarchy"))]
    found = [(tick, legs) for tick, legs in found if legs]
    assert len(found) > 10, "a slippery walk"
    with Served("replay", slippery) as replay:
        show(browser, replay.link)
        browser.click("#tab-state")
        weight = 9.81 * replay.session()["header"]["robot"]["mass"]
        for tick, held in found[:: len(found) // 5]:
            go_to(browser, tick)
            browser.wait(f"document.querySelector('#state dd')?.textContent.endsWith(', tick {tick}')")  # texts follow ten times a second
            uses = {leg: channel(browser, f"commanded.friction_use.{leg}")[0] for leg in LEGS}
            carries = {leg: channel(browser, f"commanded.normal_force.{leg}")[0] for leg in LEGS}
            told = {leg: f"{100 * use:.0f} %" for leg, use in uses.items() if use is not None and carries[leg] >= 0.02 * weight}
            assert {f"{100 * uses[leg]:.0f} %" for leg in held} == {"100 %"}
            shown = browser.run("[...document.querySelectorAll('.label.use:not([hidden])')].map(one => [one.className, one.textContent])")
            assert len(shown) > 0
            for name, text in shown:
                leg = LEGS[int(re.search(r"leg(\d)", name)[1])]
                assert text == f"{leg} {told[leg]}" and ("bad" in name) == (uses[leg] >= 0.9), (tick, name, text)
            state = browser.run("Object.fromEntries([...document.querySelectorAll('#state dt')].map(one => [one.textContent, one.nextSibling.textContent]))")
            assert state["Pyramid used"] == ", ".join(f"{leg} {text}" for leg, text in told.items())
    legend = browser.run("document.querySelector('[data-legend=friction]').textContent")
    assert legend.startswith("Share of the pyramid used") and "> 90 %" in legend
