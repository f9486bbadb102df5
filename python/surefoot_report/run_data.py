"""What the report shows of a log, as arrays over its ticks."""

from functools import reduce
from math import prod
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.json

from surefoot_campaign.errors import InputError
from surefoot_log.frames import ITERATION_CAP, legs_of
from surefoot_log.log_file import SUMMARY

STANCE, UNLOADING, _, SEARCH = range(4)
PHASES = ["stance", "unloading", "swing", "search"]
ROUNDING = 1e-6  # a residual or cost up to it is none
PART = 1 << 20  # bytes that are decoded at once

NUMBER, WHOLE, TEXT, TRUE = pa.float64(), pa.int64(), pa.string(), pa.bool_()
VECTOR, MATRIX = pa.list_(NUMBER), pa.list_(pa.list_(NUMBER))


def schemas(legs):
    """What is read of each topic's messages."""

    def of_legs(kind):
        return pa.struct([(leg, kind) for leg in legs])

    foot = pa.struct([("phase", TEXT), ("force_min", NUMBER), ("force_max", NUMBER)])
    return {
        "/state": [("p_WB", VECTOR), ("q_WB", VECTOR), ("v_WB", VECTOR)],
        "/plan": [("feet", of_legs(foot)), ("torso", pa.struct([("q_WB", VECTOR), ("height", NUMBER)])), ("com", pa.struct([("p", VECTOR)])),
                  ("R_WC", MATRIX), ("calibration", TEXT), ("events", pa.list_(pa.struct([("event", WHOLE)]))), ("event", WHOLE)],
        "/model": [("p_WCom", VECTOR), ("p_WF", of_legs(VECTOR)), ("p_WH", of_legs(VECTOR)), ("force", of_legs(VECTOR))],
        "/hierarchy": [("status", WHOLE), ("failed_level", WHOLE), ("levels", pa.list_(pa.struct([("name", TEXT), ("residual", NUMBER)]))),
                       ("active", pa.list_(pa.struct([("level", TEXT), ("row", TEXT), ("id", WHOLE), ("state", WHOLE)]))),
                       ("blocking_is_known", TRUE),
                       ("blocked_by", pa.list_(pa.struct([("level", TEXT), ("by", TEXT), ("row", TEXT), ("id", WHOLE), ("cost", NUMBER)])))],
        "/command": [("torque", VECTOR), ("mode", TEXT)],
        "/truth": [("p_SB", VECTOR), ("q_SB", VECTOR), ("v_SB", VECTOR), ("p_SCom", VECTOR), ("p_SF", of_legs(VECTOR)),
                   ("feet", of_legs(pa.struct([("force", VECTOR), ("normal", VECTOR)]))), ("torque", VECTOR)],
        "/timings": [("total", NUMBER)],
    }  # fmt: skip


TOPICS = schemas(()).keys()
APART = {"/truth", "/timings"}  # a tick is whole without them


class Topic:
    """The messages on a topic, decoded part by part."""

    def __init__(self, name, path, schema):
        self._name, self._path, self._schema = name, path, pa.schema(schema)
        self._times, self._waiting, self._size, self._parts = [], [], 0, []

    def add(self, message):
        self._times.append(message.time)
        self._waiting.append(bytes(message.data))
        self._size += len(message.data) + 1
        if self._size > PART:
            self._decode()

    def _decode(self):
        options = pyarrow.json.ParseOptions(explicit_schema=self._schema, unexpected_field_behavior="ignore")
        reading = pyarrow.json.ReadOptions(block_size=self._size)
        try:
            part = pyarrow.json.read_json(pa.BufferReader(b"\n".join(self._waiting)), reading, options)
        except pa.ArrowInvalid as error:
            raise InputError(f"{self._path}: a message on {self._name} is not what it should be: {error}") from None
        if part.num_rows != len(self._waiting):
            raise InputError(f"{self._path}: a message on {self._name} is not what it should be: one JSON object")
        self._parts.append(part)
        self._waiting, self._size = [], 0

    def finish(self):
        """The times [ns] and the table."""
        if self._waiting:
            self._decode()
        table = pa.concat_tables(self._parts) if self._parts else self._schema.empty_table()
        return np.array(self._times, np.int64), table.combine_chunks()


def part_of(table, path):
    """A column, or a member of one: "com.p"."""
    name, *members = path.split(".")
    column = table[name].combine_chunks()
    return pc.struct_field(column, members) if members else column


def numbers(table, path, *shape):
    """An array of numbers, or of vectors and matrices of that shape; what is not known is NaN."""
    values = part_of(table, path)
    for _ in shape:
        values = values.flatten()
    if len(values) != table.num_rows * prod(shape):  # older logs lack it
        return np.full((table.num_rows, *shape), np.nan)
    return values.to_numpy(zero_copy_only=False).astype(float).reshape(table.num_rows, *shape)


def by_leg(table, path, *shape, member=""):
    legs = [leg.name for leg in part_of(table, path).type]
    return np.stack([numbers(table, f"{path}.{leg}{member}", *shape) for leg in legs], axis=1)


def flags(table, path):
    return pc.fill_null(part_of(table, path), False).to_numpy(zero_copy_only=False)


def codes(column, names, other=-1):
    """The place of each text among the names."""
    return pc.fill_null(pc.index_in(column, value_set=pa.array(names, TEXT)), other).to_numpy(zero_copy_only=False).astype(int)


def matrices(q):
    """Rotation matrices of quaternions w, x, y, z."""
    w, x, y, z = np.moveaxis(q, -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]  # fmt: skip
    return np.moveaxis(np.array([[np.broadcast_to(cell, w.shape) for cell in row] for row in rows]), (0, 1), (-2, -1))


def turns(yaw):
    """Rotation matrices about z."""
    half = 0.5 * np.asarray(yaw)
    return matrices(np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], axis=-1))


def chosen(rows, which):
    """Some of the rows that `lists_of` gives."""
    return {name: column[which] for name, column in rows.items()}


def stretches(inside, time, period):
    """Begin and end of each stretch of time in which `inside` holds."""
    edges = np.diff(np.concatenate([[0], np.asarray(inside, int), [0]]))
    begins, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [(float(time[begin]), float(time[end - 1] + period)) for begin, end in zip(begins, ends)]


def lists_of(table, path, levels, named):
    """The rows of a list of each tick, a column for each member; `named`: members that are levels, which become numbers."""
    column = part_of(table, path)
    rows = {"tick": pc.list_parent_indices(column).to_numpy(zero_copy_only=False)}
    for member in (field.name for field in column.type.value_type):
        values = pc.struct_field(column.flatten(), [member])
        rows[member] = codes(values, levels) if member in named else values.to_numpy(zero_copy_only=False)
    return rows


def event_times(plan, time):
    """The times of each event, by its number. Logs before 2.12 have one event a tick."""
    rows, single = lists_of(plan, "events", [], set()), np.nan_to_num(numbers(plan, "event")).astype(int)
    ticks, events = np.concatenate([rows["tick"], np.flatnonzero(single)]), np.concatenate([rows["event"], single[single != 0]])
    return {int(event): time[ticks[events == event].astype(int)] for event in np.unique(events)}


def residuals(table, levels):
    """The residual of each tick and level. If a solve was cut off, the level that it ended in and those behind it have none."""
    rows, failed = lists_of(table, "levels", levels, {"name"}), numbers(table, "failed_level")
    failed[(numbers(table, "status") != ITERATION_CAP) | ~(failed >= 0)] = np.inf
    place = np.arange(len(rows["tick"])) - np.searchsorted(rows["tick"], rows["tick"])
    found = np.full((table.num_rows, len(levels)), np.nan)
    found[rows["tick"], rows["name"]] = np.where(place < failed[rows["tick"]], rows["residual"].astype(float), np.nan)
    return found


def level_names(header, table):
    """Those of the header, then others that came while it ran."""
    others = pc.unique(pc.struct_field(part_of(table, "levels").flatten(), ["name"])).to_pylist()
    return header["level_names"] + [name for name in others if name not in header["level_names"]]


def laid_by_feet(contact, believed, true):
    """Rotations and positions of the controller's W in the simulator's S, by the feet that stand (model/belief_frame.hpp). Where fewer than two stand,
    or their places are not known, those of the tick before."""
    count = contact.sum(axis=1)
    known = (count >= 2) & np.isfinite(believed).all(axis=(1, 2)) & np.isfinite(true).all(axis=(1, 2))
    R, p = np.broadcast_to(np.eye(3), (len(known) + 1, 3, 3)).copy(), np.zeros((len(known) + 1, 3))  # the last: of ticks before all that are known
    weights = (contact / np.maximum(count, 1)[:, None])[known, :, None]
    here, there = ((weights * points[known]).sum(axis=1) for points in (believed, true))
    a, b = believed[known] - here[:, None], true[known] - there[:, None]
    sine, cosine = ((weights[..., 0] * part).sum(axis=1) for part in (a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0],
                                                                      a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]))  # fmt: skip
    R[:-1][known] = turns(np.arctan2(sine, cosine))
    p[:-1][known] = there - np.einsum("nij,nj->ni", R[:-1][known], here)
    latest = np.maximum.accumulate(np.where(known, np.arange(len(known)), -1))
    return R[latest], p[latest]


def read_run(log):
    """Throws InputError as LogFile does, and if the log holds no tick."""
    topics = {name: Topic(name, log.path, schema) for name, schema in schemas(legs_of(log.header)).items()}
    changes = 0
    for message in log.messages({*TOPICS, "/changes"}):
        if message.topic == "/changes":
            changes += 1
        else:
            topics[message.topic].add(message)
    return made_run(log, {name: topic.finish() for name, topic in topics.items()}, changes)


def of_ticks(log, tables):
    """The times [ns] of the ticks that are whole, and their tables."""
    times = reduce(np.intersect1d, [tables[name][0] for name in TOPICS - APART])
    if not len(times):
        raise log.no_tick("report")
    return times, {name: rows_at(*tables[name], times) for name in TOPICS - {"/timings"}}


def rows_at(have, table, times):
    """The rows of these times; nulls where there is none."""
    if np.array_equal(have, times):
        return table
    places = np.searchsorted(have, times)
    return table.take(pa.array(places, mask=~np.isin(times, have))) if len(have) else pa.Table.from_pylist([{}] * len(times), schema=table.schema)


def pose_of(world, base, points):
    """Base and its velocity, COM and feet, named with their world: p_WB, or p_SB."""
    pose = {f"{quantity}_{world}B": numbers(base, f"{quantity}_{world}B", size) for quantity, size in (("p", 3), ("q", 4), ("v", 3))}
    return SimpleNamespace(**pose, **{f"p_{world}Com": numbers(points, f"p_{world}Com", 3), f"p_{world}F": by_leg(points, f"p_{world}F", 3)})


def seen(belief, truth):
    """The truth where the log has it, in S; else what the controller believed, in W."""
    known = np.isfinite(truth.p_SB[:, 0])
    return SimpleNamespace(**{name: np.where(known.reshape(-1, *[1] * (values.ndim - 1)), values, getattr(belief, name.replace("_S", "_W")))
                              for name, values in vars(truth).items()})  # fmt: skip


def made_run(log, tables, num_changes):
    """Arrays over the ticks; NaN is not known."""
    times, tick = of_ticks(log, tables)
    plan, model, hierarchy, command, truth = (tick[name] for name in ("/plan", "/model", "/hierarchy", "/command", "/truth"))
    run = SimpleNamespace(header=log.header, time=1e-9 * times, period=log.header["control_period"], num_changes=num_changes, problem=log.problem)
    run.legs = legs_of(log.header)
    run.span = run.time[0], run.time[-1] + run.period
    run.summary, run.has_truth = log.attachments.get(SUMMARY, b"").decode(errors="replace"), len(tables["/truth"][0]) > 0
    run.events = log.events
    run.totals = numbers(tables["/timings"][1], "total")  # wall clock of each tick [µs]

    run.belief, run.truth = pose_of("W", tick["/state"], model), pose_of("S", truth, truth)
    run.seen = seen(run.belief, run.truth)
    run.p_WH, run.force = by_leg(model, "p_WH", 3), by_leg(model, "force", 3)  # hips, and forces of the solution
    force, normal = (by_leg(truth, "feet", 3, member=f".{name}") for name in ("force", "normal"))
    run.normal_force = (normal * force).sum(axis=2)  # the true one [N]
    run.torque, run.mode = numbers(command, "torque", len(log.header["robot"]["torque_limit"])), part_of(command, "mode").to_numpy(zero_copy_only=False).astype(str)

    run.phase = np.stack([codes(part_of(plan, f"feet.{leg}.phase"), PHASES, STANCE) for leg in run.legs], axis=1)
    run.contact = run.phase <= UNLOADING
    run.force_limits = np.stack([by_leg(plan, "feet", member=f".{name}") for name in ("force_min", "force_max")], axis=2)
    run.torso_q, run.R_WC = numbers(plan, "torso.q_WB", 4), numbers(plan, "R_WC", 3, 3)
    run.event_times = event_times(plan, run.time)
    run.calibrates = codes(part_of(plan, "calibration"), ["none", None], 2) == 2
    run.R_SW, p = laid_by_feet(run.contact, run.belief.p_WF, run.truth.p_SF)  # takes W to S
    desired = np.einsum("nij,nj->ni", run.R_SW, np.column_stack([numbers(plan, "com.p", 2), numbers(plan, "torso.height")])) + p
    run.desired_com, run.desired_height = desired[:, :2], desired[:, 2]  # in S, or in W where there is no truth

    run.levels, run.explained = level_names(log.header, hierarchy), flags(hierarchy, "blocking_is_known")
    run.residual = residuals(hierarchy, run.levels)
    solved = np.isfinite(run.residual)
    active, blocked = lists_of(hierarchy, "active", run.levels, {"level"}), lists_of(hierarchy, "blocked_by", run.levels, {"level", "by"})
    run.active = chosen(active, solved[active["tick"], active["level"]])  # at a bound or beyond it
    is_told = run.explained[blocked["tick"]] & (blocked["cost"].astype(float) > ROUNDING) & solved[blocked["tick"], blocked["level"]]
    run.blocked = chosen(blocked, is_told)  # rows that held a level back
    return run
