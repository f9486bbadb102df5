"""What the documents quote is what stands in the files that they name."""

import json
import re
import subprocess
import sys

import pytest
from campaign_folder import CampaignFolder
from conftest import record
from program import PROGRAM, ROOT, SHORT, surefoot


def lines(text):
    """The lines of a text without blank ones and without the spaces between words."""
    return ["".join(line.split()) for line in text.splitlines() if line.strip()]


def cpp_blocks(text):
    """Each C++ block of a document, with the example whose name stands last before it."""
    for block in re.finditer(r"^```cpp\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        names = re.findall(r"\((examples/\w+\.cpp)\)", text[: block.start()])
        assert names, f"no example is named before\n{block[1]}"
        yield block[1], names[-1]


def test_the_cpp_of_the_readme_stands_line_by_line_in_the_example_that_it_names():
    blocks = list(cpp_blocks((ROOT / "README.md").read_text()))
    assert blocks
    for block, example in blocks:
        remaining = iter(lines((ROOT / example).read_text()))
        for line in lines(block):
            assert line in remaining, f"{example} has no such line, or not there: {line}"


def blocks_of(document, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", (ROOT / document).read_text(), re.MULTILINE | re.DOTALL)




def test_the_numbers_in_a_stack_file_if_there_are_any_count_its_levels():
    for file in sorted((ROOT / "stacks").glob("*.yaml")):
        numbers = re.findall(r"^  - task: \w+ *# *(\d+)", file.read_text(), re.MULTILINE)
        levels = len(re.findall(r"^  - ", file.read_text(), re.MULTILINE))
        assert [int(number) for number in numbers] in ([], list(range(1, levels + 1))), file.name
    table = (ROOT / "stacks/terrain_adaptation.yaml").read_text()
    assert "# 11" in table  # the paper's Table I


@pytest.mark.slow
def test_the_stairs_of_scenarios_are_walked_down_and_that_is_a_success(tmp_path):
    (stairs,) = [block for block in blocks_of("docs/scenarios.md", "yaml") if "# stairs.yaml" in block]
    (tmp_path / "stairs.yaml").write_text(stairs)
    done = surefoot("run", "stairs.yaml", "--json", cwd=tmp_path)
    result = json.loads(done.stdout)
    assert done.returncode == 0 and result["succeeded"] and result["goal_reached"], result["criteria"]
    assert {c["metric"] for c in result["criteria"]} == {"fell", "goal_reached", "max_tilt_rad"}
    assert "14 cm" not in surefoot("run", "stairs.yaml", *SHORT, cwd=tmp_path).stdout


def test_what_the_readme_says_that_explain_begins_with_is_what_it_prints(tmp_path):
    (quoted,) = blocks_of("README.md", "text")
    (time,) = re.findall(r"explain run\.mcap --at ([\d.]+)", (ROOT / "README.md").read_text())
    record(tmp_path / "run.mcap", scenario="step_down", duration=float(time) + 0.1)
    assert surefoot("explain", tmp_path / "run.mcap", "--at", time).stdout.splitlines()[2] == quoted.strip()


def test_the_stack_of_the_readme_is_one(tmp_path):
    (stack,) = blocks_of("README.md", "yaml")
    (tmp_path / "mine.yaml").write_text(stack)
    assert surefoot("run", "step_down", "--check", "--set", f"stack={tmp_path / 'mine.yaml'}").returncode == 0


def test_legs_have_the_same_colours_in_the_picture_the_page_and_the_report():
    def colours(text, pattern):
        return [re.findall(r"[0-9a-f]{6}", one) for one in re.findall(pattern, text)]

    variables = "; ".join(rf"--c{i}: #\w{{6}}" for i in range(6))
    picture = colours((ROOT / "viewer/src/scene/palette.ts").read_text(), r"legs: \[0x[^\]]*\]")
    assert len(picture) == 2, "light and dark"
    for file in ("viewer/src/style/page.css", "python/surefoot_report/page.css"):
        assert colours((ROOT / file).read_text(), variables) == picture, file


def anchor_of(heading):
    words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def test_links_within_the_documents_lead_to_a_file_and_a_heading():
    pages = [page for folder in (".", "docs", "docs/decisions", "python", "viewer") for page in (ROOT / folder).glob("*.md")]
    anchors = {page.resolve(): {anchor_of(heading) for heading in re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)} for page in pages}
    links = [(page, *link.partition("#")[::2]) for page in pages for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text())]
    within = [(page, (page.parent / file if file else page).resolve(), anchor) for page, file, anchor in links if "://" not in file]
    assert len(within) > 100
    for page, target, anchor in within:
        assert target.exists(), f"{page.name}: {target}"
        assert not anchor or target not in anchors or anchor in anchors[target], f"{page.name}: {target.name}#{anchor}"


def test_every_header_that_users_include_stands_in_the_table_of_cpp():
    table = (ROOT / "docs/cpp.md").read_text().split("| `#include` |")[1].split("\n\n")[0]
    headers = {f"surefoot/{path.name}" for path in (ROOT / "surefoot").glob("*.hpp")}
    assert set(re.findall(r"^\| `(surefoot/\w+\.hpp)`", table, re.MULTILINE)) == headers


def installed_headers():
    listed = subprocess.run([sys.executable, ROOT / "tools/installed_headers.py"], capture_output=True, text=True, check=True).stdout
    return [ROOT / header for header in listed.split(";")]


def test_what_cpp_calls_stands_in_an_installed_header():
    called = set(re.findall(r"`(?:\w+::)*([a-z]\w+)\(", (ROOT / "docs/cpp.md").read_text()))
    declared = "".join(header.read_text() for header in installed_headers())
    assert {"check_task", "step"} < called
    assert not [name for name in sorted(called) if not re.search(rf"\b{name}\(", declared)]


def test_each_example_of_a_part_of_ones_own_is_built_with_the_installed_library():
    parts = set(re.findall(r"\.\./examples/(\w+)\.cpp", (ROOT / "docs/cpp.md").read_text()))
    built = (ROOT / "tests/install/CMakeLists.txt").read_text()
    assert len(parts) > 4
    assert not [part for part in sorted(parts) if f" {part}" not in built]


def test_every_campaign_that_ships_stands_in_the_table_of_campaigns():
    ships = {file.stem for file in (ROOT / "campaigns").glob("*.yaml")}
    table = (ROOT / "docs/campaigns.md").read_text().split("What ships in")[1].split("\n\n")[1]
    assert set(re.findall(r"^\| \[(\w+)\]\(\.\./campaigns/\1\.yaml\)", table, re.MULTILINE)) == ships


def test_the_spec_that_campaigns_explains_is_one_that_runs(tmp_path):
    (spec,) = [block for block in blocks_of("docs/campaigns.md", "yaml") if block.startswith("name: ")]
    done = CampaignFolder(tmp_path, PROGRAM).write(spec).run("--dry-run")
    assert "3600 runs, 0 done, 3600 to do" in done.stdout, done.stderr


def kept_runs():
    """Of the tables of robots with model mismatch in docs/results.md."""
    sys.path.insert(0, str(ROOT / "tools"))
    try:
        import campaign_table
    finally:
        sys.path.remove(str(ROOT / "tools"))
    runs = [run for name in ("blind", "heights") for run in campaign_table.read(ROOT / f"docs/results/{name}.csv")]
    return campaign_table, campaign_table.by_scenario(runs)


def rows_of(document, head):
    """The cells of each row of the table under this head."""
    (table,) = re.findall(rf"^{re.escape(head)}.*?\n\n", (ROOT / document).read_text() + "\n\n", re.MULTILINE | re.DOTALL)
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[2:] if row]
    return [(re.match(r"`(\w+)`", name)[1], cells) for name, *cells in rows]


def test_what_the_documents_say_of_campaigns_stands_in_the_runs_that_are_kept():
    campaign_table, scenarios = kept_runs()
    succeeds = rows_of("docs/results.md", "| scenario | | succeed")
    contacts = rows_of("docs/results.md", campaign_table.CONTACTS)
    assert len(succeeds) > 10 and len(contacts) > 10
    for scenario, (_, *cells) in succeeds:
        assert cells == campaign_table.cells(scenarios[scenario]), scenario
    for scenario, (_, *cells) in rows_of("README.md", "| scenario | | succeed"):
        assert cells == campaign_table.cells(scenarios[scenario])[: len(cells)], scenario
    for scenario, cells in contacts:
        assert cells == campaign_table.contacts(scenarios[scenario]), scenario
