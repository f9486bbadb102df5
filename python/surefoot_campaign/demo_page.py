"""The demo's overview as one HTML page without network: of each experiment a picture, its figure against the paper's, and good or bad."""

from surefoot_campaign.metrics import about, arrow
from surefoot_campaign.text import escape

HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Surefoot: the paper's experiments</title>
<style>
:root { --ok: #14703c; --bad: #b3261e; --found: #5f6368; --line: #ddd; color-scheme: light dark; }
body { font: 15px/1.45 system-ui, sans-serif; max-width: 84rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; margin: 0; }
h2 { font-size: 1.05rem; margin: 0; }
a { color: inherit; }
.sum { font-size: 1.15rem; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(24rem, 1fr)); gap: 1.2rem; }
article { border: 1px solid var(--line); border-top: .45rem solid var(--tone); border-radius: .4rem; padding: .8rem 1rem; }
article img { width: 100%; aspect-ratio: 2; object-fit: cover; object-position: right; border-radius: .2rem; background: #fff; }
.top { display: flex; justify-content: space-between; gap: 1rem; align-items: baseline; }
.verdict { color: var(--tone); font-weight: 700; white-space: nowrap; }
.figure { font-size: 1.9rem; font-weight: 650; line-height: 1.2; margin: .4rem 0 .2rem; }
.figure small { display: block; font-size: .9rem; font-weight: 400; line-height: 1.35; }
.paper { margin: 0; font-size: 1rem; }
.soft, .rest { color: var(--found); font-size: .88rem; margin: .3rem 0 0; }
.ok { --tone: var(--ok); } .bad { --tone: var(--bad); } .found { --tone: var(--found); }
</style>
</head>
<body>
<h1>The paper's experiments</h1>
<p>A four-legged robot that does not see the ground walks, steps down and up, and is pushed: simulated just now, with the paper's figure below each
of ours. Green came out as it must; a picture leads to the run's report.</p>
"""
STYLES = {"✓": ("ok", "✓ as it must be"), "✗": ("bad", "✗ not as it must be"), "cut off": ("found", "seeds cut off")}
AS_FOUND = ("found", "as found")  # any result is one


def card(row):
    style, verdict = STYLES.get(row.verdict, AS_FOUND)
    name = escape(row.name)
    linked = f'<a href="{escape(row.report)}">{name}</a>' if row.report else name
    told = f"{about(row.headline_metric).get('help', '')} {arrow(row.headline_metric)}".strip() or row.headline_metric
    picture = f'<a href="{escape(row.report)}"><img loading="lazy" alt="{name}" src="{escape(row.picture)}"></a>\n' if row.picture else ""
    paper = f'<p class="paper">paper: {escape(row.headline_paper)}</p>\n' if row.headline_paper else ""
    seeds = f'<p class="rest">random seeds: {escape(row.seeds)}</p>\n' if row.seeds else ""
    return (f'<article class="{style}">\n{picture}<div class="top"><h2>{linked}</h2><span class="verdict">{verdict}</span></div>\n'
            f'<p class="figure">{escape(row.headline)} <small title="{escape(row.headline_metric)}">{escape(told)}</small></p>\n{paper}'
            f'<p class="rest">{escape(row.measured)}</p>\n{seeds}<p class="soft">{escape(row.description)}</p>\n</article>\n')  # fmt: skip


def in_order(rows, first):
    return sorted(rows, key=lambda row: row.name != first)


def counted(rows):
    good, bad, cut = (sum(row.verdict == verdict for row in rows) for verdict in STYLES)
    return (f"{good} as they must be" + (f", {bad} not" if bad else "") + (f", {cut} cut off" if cut else "")
            + f"; {len(rows) - good - bad - cut} show what happens, as found")  # fmt: skip


def demo_page(rows, summary, first=""):
    """`first`: the name of the one that stands before the others."""
    return f'{HEAD}<p class="sum">{counted(rows)}</p>\n<div class="cards">\n{"".join(map(card, in_order(rows, first)))}</div>\n<p class="soft">{escape(summary)}</p>\n</body>\n</html>\n'
