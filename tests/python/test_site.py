"""The documentation site: built without a network, with every link checked, whole in both languages."""

import os
import re
import subprocess
import sys

import pytest
from program import ROOT

sys.path.insert(0, str(ROOT / "tools/site"))
import cpp_declarations
import prose


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", folder]
    done = subprocess.run(command, cwd=ROOT, env=os.environ | {"NO_MKDOCS_2_WARNING": "1"}, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder


def test_pages_load_nothing_from_a_network(site):
    pages = [*site.rglob("*.html")]
    assert len(pages) > 100
    loads = re.compile(r"<(?:script|img|link|iframe|video|source)\b[^>]*\b(?:src|href)=[\"']?(?:https?:)?//[^\s>]+")
    for page in pages:
        assert not loads.search(page.read_text()), page.name
    for style in site.rglob("*.css"):
        assert not re.search(r"(url\([\"']?|@import [\"'])(https?:)?//", style.read_text()), style.name


def test_the_fields_of_the_log_have_a_page(site):
    page = (site / "log_fields.html").read_text()
    assert "/readings" in page and "[N·m]: measured joint torques" in page


def test_formulas_are_mathml(site):
    for page, least in {"concept_dynamics": 8, "concept_tasks": 8, "solver": 10}.items():
        text = (site / f"{page}.html").read_text()
        assert text.count("<math") >= least, page
        assert "arithmatex" not in text and "$$" not in text


def test_every_public_header_has_a_page_and_all_names_that_it_promises_are_found(site):
    promised = re.findall(r"^\| `surefoot/(\w+)\.hpp` \| (.*?)(?::|\|)", (ROOT / "docs/cpp.md").read_text(), re.MULTILINE)
    assert len(promised) == len([*(ROOT / "surefoot").glob("*.hpp")])
    index = (site / "reference/cpp/index.html").read_text()
    for header, names in promised:
        assert (site / f"reference/cpp/{header}.html").exists()
        for name in re.findall(r"`(\w+)`", names):
            assert f">{name}</a>" in index, f"{header}: {name}"


def test_every_public_class_and_function_of_the_module_is_described(site):
    import surefoot

    page = (site / "reference/python.html").read_text()
    for name in [name for name in surefoot.__all__ if name != "tasks"] + ["Recorded.in_W", "Recorded.aligned_error", "Stack.before", "Controller.step"]:
        assert re.search(rf'id="(\w+)?{name.lower().replace(".", "")}"', page), name
    for name in ("surefoot.insert", "surefoot.yaml_of", "surefoot.data_frame", "surefoot.robot_of", "surefoot.check_folder", "read_scenario", "parse_stack"):
        assert f">{name}" not in page, name


HEADER = '''#pragma once

// What it is for.

namespace a {
class Forward;

/// Two numbers,
///
///     x y
///
/// as `text`.
struct Pair {
  double x = 0.0;  ///< first [m],
                   ///< measured
  int count() const { return 2; }
};

/// A class.
class Thing {
 public:
  Thing() = default;
  /// Does it, if `{` is no brace.
  [[nodiscard]] virtual bool run(const std::vector<int>& list = {}, char c = '{') noexcept;
  explicit Thing(double x) : x_(x) {}

 private:
  double x_;
};
/// One of two.
enum class Kind : int { one = 0, two = 1 };
inline constexpr double kLimit = 1e-8;  ///< of all
}  // namespace a
'''


def test_a_header_is_read_as_it_is_meant():
    pair, thing, kind, limit = cpp_declarations.read(HEADER)
    assert (pair.name, pair.declaration) == ("Pair", "struct Pair")
    assert prose.to_html(pair.about) == "<p>Two numbers,</p>\n<pre>x y</pre>\n<p>as <code>text</code>.</p>"
    assert [member.declaration for member in pair.members] == ["double x = 0.0", "int count() const"]
    assert pair.members[0].about.split() == ["first", "[m],", "measured"]
    assert [member.declaration for member in thing.members] == [
        "[[nodiscard]] virtual bool run(const std::vector<int>& list = {}, char c = '{') noexcept", "explicit Thing(double x)"]  # fmt: skip
    assert kind.name == "Kind" and "two = 1" in kind.declaration
    assert limit.name == "kLimit" and limit.about.strip() == "of all"
