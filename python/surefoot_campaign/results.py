"""The table of all finished runs, in the order of the plan: CSV and Parquet with the same columns."""

import csv
import hashlib
import io
from dataclasses import dataclass

from surefoot_campaign.outcome import number_at
from surefoot_campaign.program import yaml_text
from surefoot_campaign.spec import CASE
from surefoot_campaign.statistics import is_number

# Members of a result that other columns have already.
LEFT_OUT = {"scenario", "stack", "seed", "version", "succeeded", "reason", "sources_hash", "estimation", "foot_force_sensor"}
WALL_TIME = "wall_time_s"


@dataclass
class Record:
    """A run of the plan and its row."""

    run: object
    row: dict

    @property
    def succeeded(self):
        return self.row["outcome"] == "succeeded"

    @property
    def is_judged(self):
        return self.row["outcome"] != "not_judged"

    def metric(self, name):
        return number_at(self.row["result"], name)


def records_of(plan, rows):
    """The runs of the plan that have a row, whatever else the journal holds."""
    return [Record(run, rows[run.id]) for run in plan.runs if run.id in rows]


def values_of(records, metric):
    """The values of a metric that are known."""
    return [value for record in records if (value := record.metric(metric)) is not None]


def flat(result, prefix=""):
    """{"tick_us": {"p99": 1}} -> {"tick_us.p99": 1}; lists have no column."""
    cells = {}
    for key, value in result.items():
        if isinstance(value, dict):
            cells |= flat(value, f"{prefix}{key}.")
        elif not isinstance(value, list) and not (prefix == "" and key in LEFT_OUT):
            cells[prefix + key] = value
    return cells


def missed(result):
    """Names of the criteria that a run missed."""
    return [c["metric"] for c in result.get("criteria", []) if c.get("passed") is False]


def cells_of(record):
    run, row = record.run, record.row
    result = row["result"] or {}
    cells = {"id": run.id, "scenario": run.scenario, "seed": run.seed, "version": run.version}
    if run.case is not None:
        cells[CASE] = run.case
    cells |= {key: plain(value) for key, value in run.parameters.items()}
    cells |= {"outcome": row["outcome"], "reason": row["reason"], "missed": " ".join(missed(result))}
    return cells | flat(result) | {WALL_TIME: row["wall_time_s"]}


def plain(value):
    """A parameter's value as a cell."""
    return value if isinstance(value, (bool, int, float, str)) else yaml_text(value)


def csv_table(rows):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(map(csv_text, row) for row in rows)
    return text.getvalue()


class Table:
    """Columns by name; those that the machine's clock decides stand last, and count for nothing in the digest."""

    def __init__(self, plan, records):
        rows = [cells_of(record) for record in records]
        names = list(dict.fromkeys(name for row in rows for name in row))
        by_clock = {name for name, about in plan.metrics.items() if about["by_clock"]} | {WALL_TIME}
        self.compared = [name for name in names if name not in by_clock]
        self.names = self.compared + [name for name in names if name in by_clock]
        self.columns = {name: [row.get(name) for row in rows] for name in self.names}

    def csv(self, names):
        return csv_table([names, *zip(*(self.columns[name] for name in names))])

    def digest(self):
        """Equal for equal results."""
        return hashlib.sha256(self.csv(self.compared).encode()).hexdigest()[:16]

    def write(self, folder):
        (folder / "runs.csv").write_text(self.csv(self.names), encoding="utf-8")
        write_parquet(self.columns, folder / "runs.parquet")


def csv_text(value):
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else value


def arrow_column(values):
    """Numbers as double, so that a column's type does not depend on whether its values happen to be whole."""
    import pyarrow

    present = [value for value in values if value is not None]
    if not present:
        return pyarrow.nulls(len(values), pyarrow.float64())
    if all(isinstance(value, bool) for value in present):
        return pyarrow.array(values, pyarrow.bool_())
    if all(is_number(value) for value in present):
        return pyarrow.array([None if value is None else float(value) for value in values], pyarrow.float64())
    texts = [value if value is None or isinstance(value, str) else csv_text(value) for value in values]
    return pyarrow.array([None if text is None else str(text) for text in texts], pyarrow.string())


def write_parquet(columns, path):
    import pyarrow
    import pyarrow.parquet

    arrays = {name: arrow_column(values) for name, values in columns.items()}
    if "seed" in arrays:
        arrays["seed"] = arrays["seed"].cast(pyarrow.int64())
    pyarrow.parquet.write_table(pyarrow.table(arrays), path)
