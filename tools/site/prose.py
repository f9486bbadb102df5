"""Comments and docstrings as HTML."""

import html
import re
import textwrap


def to_html(text):
    """Paragraphs; what is indented keeps its lines; `names` in the font of code."""
    blocks = re.split(r"\n\s*\n", textwrap.dedent(text).strip("\n"))
    return "\n".join(block_to_html(block) for block in blocks if block.strip())


def block_to_html(block):
    if all(line.startswith("  ") for line in block.splitlines()):
        return f"<pre>{html.escape(textwrap.dedent(block))}</pre>"
    lines = block.splitlines()
    if all(line.lstrip().startswith(("- ", "* ")) or line.startswith("  ") for line in lines):
        items = re.split(r"^\s*[-*] ", block, flags=re.MULTILINE)[1:]
        return "<ul>" + "".join(f"<li>{inline(item)}</li>" for item in items) + "</ul>"
    return f"<p>{inline(block)}</p>"


def inline(text):
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(" ".join(text.split()), quote=False))
