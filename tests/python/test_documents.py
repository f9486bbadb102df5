"""What the documents quote is what stands in the files that they name."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]


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
