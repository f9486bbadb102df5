"""MkDocs hooks: pages from outside docs/, a page for each file of the tree that a page links to, references of both languages, equations
as MathML. Nothing of the site comes from a network."""

import html
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from latex2mathml.converter import convert
from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import cpp_reference
import python_reference
import sources

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Pages whose place in the site is not that in docs/.
ELSEWHERE = {
    "README.md": "index.md",
    "python/README.md": "python.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "viewer/README.md": "view_protocol.md",
    "docs/decisions/README.md": "decisions/index.md",
}


def on_config(config):
    config.mdx_configs["toc"]["slugify"] = slug
    return config


def slug(heading, separator):
    """Anchors of headings as forges make them, so that a link works in the tree, too."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", separator)


def on_files(files, config):
    pages = sources.Pages(ROOT, ELSEWHERE | {f"docs/{file.src_uri}": file.src_uri for file in files.documentation_pages()
                                             if f"docs/{file.src_uri}" not in ELSEWHERE})  # fmt: skip
    texts = {site: (ROOT / path).read_text() for path, site in pages.site_of.items()}
    texts = {site: pages.linked(text, site) for site, text in texts.items()}
    texts |= cpp_reference.pages(ROOT) | python_reference.pages(ROOT) | {"log_fields.md": fields_of_the_log()}
    texts |= pages.linked_files()
    replaced = {"decisions/README.md", *texts}
    for file in [file for file in files if file.src_uri in replaced]:
        files.remove(file)
    for site, text in texts.items():
        files.append(File.generated(config, site, content=text))
    config.nav = with_folders(config.nav, sorted(file.src_uri for file in files.documentation_pages()))
    return files


def with_folders(nav, pages):
    """The navigation with the pages of each folder that it names."""
    if isinstance(nav, list):
        return [with_folders(entry, pages) for entry in nav]
    if isinstance(nav, dict):
        return {title: with_folders(entry, pages) for title, entry in nav.items()}
    return sorted((page for page in pages if page.startswith(nav)), key=lambda page: not page.endswith("index.md")) if nav.endswith("/") else nav


def fields_of_the_log():
    """As the program writes them now."""
    with tempfile.TemporaryDirectory() as folder:
        log = pathlib.Path(folder) / "run.mcap"
        program = os.environ.get("SUREFOOT_PROGRAM", ROOT / "build/release/bin/surefoot")
        subprocess.run([program, "run", "walk_flat_ideal", "--set", "duration=0.01", "--record", log], capture_output=True)
        return subprocess.run([sys.executable, ROOT / "tools/log_fields.py", log], capture_output=True, text=True, check=True).stdout


def on_page_markdown(markdown, **_):
    return re.sub(r"^```mermaid\n(.*?)^```$", table_of_states, markdown, flags=re.MULTILINE | re.DOTALL)


def table_of_states(diagram):
    """A state diagram as the table of its arrows: a drawing would need a library of 3 MB."""
    arrows = re.findall(r"^ *(\S+) --> (\S+?)(?:: (.*))?$", diagram[1], re.MULTILINE)
    rows = [f"| {before.replace('[*]', 'start')} | {after} | {why or ''} |" for before, after, why in arrows]
    return "\n".join(["| from | to | when |", "|---|---|---|", *rows])


FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)


def on_page_content(content, **_):
    def mathml(found):
        latex = re.sub(r"\\tag\{(.*?)\}", r"\\qquad \\text{(\1)}", html.unescape(found[3]))
        return convert(latex, display="block" if found[2] == "[" else "inline")

    return FORMULA.sub(mathml, content)
