"""The demo's overview as one HTML page without network: its table, each line with a link to its report."""

from surefoot_campaign.text import escape

HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Surefoot: the paper's experiments</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; max-width: 80rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .45rem .7rem; border-bottom: 1px solid #ddd; }
th { border-bottom: 2px solid #666; }
td small { color: #666; }
.ok { color: #14703c; } .bad { color: #b3261e; }
</style>
</head>
<body>
<h1>The paper's experiments</h1>
"""
COLUMNS = ["experiment", "measured", "random seeds", "", "paper"]
STYLES = {"✓": "ok", "✗": "bad"}


def line(row):
    name = escape(row.name)
    linked = f'<a href="{escape(row.report)}">{name}</a>' if row.report else name
    verdict = f'<span class="{STYLES.get(row.verdict, "")}">{row.verdict}</span>'
    cells = [f"{linked}<br><small>{escape(row.description)}</small>", escape(row.measured), escape(row.seeds), verdict, escape(row.paper)]
    return f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>\n"


def demo_page(rows, summary):
    head = "".join(f"<th>{name}</th>" for name in COLUMNS)
    return f"{HEAD}<p>{escape(summary)}</p>\n<table>\n<tr>{head}</tr>\n{''.join(map(line, rows))}</table>\n</body>\n</html>\n"
