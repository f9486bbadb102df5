import assert from "node:assert/strict";
import { test } from "node:test";
import type { Frame } from "../src/data/frame.ts";
import { accountAt, accountOf, blendShare, levelStates, type Account, type LevelState } from "../src/data/hierarchy.ts";
import { blockOf, schemaOf, STATES } from "./make.ts";
import { readBlock } from "../src/protocol/block.ts";
import { FrameTable } from "../src/data/table.ts";
import { heldText } from "../src/panels/level_card.ts";

const FIELDS = ["residual", "num_rows", "degrees_of_freedom_left", "iterations"];

interface More {
  active?: [number, number, number, number?][];
  blocking?: [number, number, number, number][];
  rows?: number;
  states?: [string, string];
}

/** A tick of two levels; a level that has a residual gives way, unless `states` says otherwise. */
function frameOf(residuals: [number, number], { rows = 2, states = residuals.map((one) => (one > 0 ? "gives way" : "met")) as [string, string], ...more }: More = {}): Frame {
  const schema = schemaOf(Object.fromEntries(["first", "second"].flatMap((level) => [...FIELDS.map((field) => `hierarchy.level.${level}.${field}`), `told.level.${level}.state`].map((name) => [name, 1]))));
  const [first, second] = states.map((state) => STATES.indexOf(state)) as [number, number];
  const table = new FrameTable(schema, 1);
  const values = [residuals[0], rows, 6, 1, first, residuals[1], rows, 0, 2, second];
  readBlock(blockOf([{ tick: 0, time: 0, values, ...more }]), schema.frameFloats, (...frame) => table.append(...frame));
  return table.frame(0);
}

test("a level has its time from the tick's timing, and none in a log that has none", () => {
  const schema = schemaOf({ "hierarchy.level.first.residual": 1, "timings.level.first.solve": 1, "timings.level.second.solve": 1 });
  const table = new FrameTable(schema, 1);
  readBlock(blockOf([{ tick: 0, time: 0, values: [0, NaN, 2.5] }]), schema.frameFloats, (...frame) => table.append(...frame));
  assert.deepEqual(levelStates(table.frame(0)).map(({ time }) => time), [NaN, 2.5]);
  assert.deepEqual(levelStates(frameOf([0, 0])).map(({ time }) => time), [NaN, NaN]);
});

test("of a frame of which nothing is known, as a damaged log's summary has it, no rows are counted", () => {
  const states = levelStates(frameOf([NaN, NaN], { rows: NaN, states: ["", ""] }));
  assert.deepEqual(states.map(({ rows, status }) => [rows, status]), [[0, "not solved"], [0, "not solved"]]);
});

test("levels that reach what they ask for are met", () => {
  assert.deepEqual(levelStates(frameOf([0, 0])).map((level) => level.status), ["met", "met"]);
  assert.deepEqual(accountOf(levelStates(frameOf([0, 0])), ""), { kind: "good", line: "Every level gets what it asks for." });
});

test("what is exactly known of a tick stands in the place of the control loop's estimates", () => {
  const frame = frameOf([0, 2], { blocking: [[1, 0, 7, 0]] });
  const [, estimated] = levelStates(frame);
  assert.match(heldText(estimated as LevelState, levelStates(frame)), /^held back by first: [^:]* \(the control loop's estimate\)$/);
  const states = levelStates(frame, new Map([["second", { rows: [{ by: 0, row: "LF extension", cost: 2 }, { by: 0, row: "LF x", cost: NaN }], others: 3 }]]));
  assert.equal(heldText(states[1] as LevelState, states), "held back by first: LF extension costs 2.00 m/s²; first: LF x at a cost that is not known; 3 more");
});

test("an equality that was missed is no limit", () => {
  const [first, second] = levelStates(frameOf([0, 0.5], { active: [[1, 2, 0, -0.5]] }));
  assert.deepEqual(second?.missed, [{ name: "c", state: 2, by: -0.5 }]);
  assert.deepEqual([first?.missed, second?.active, second?.status], [[], [], "gives way"]);
});

test("a level with a row at its bound is at its limit", () => {
  const [first, second] = levelStates(frameOf([0, 0], { active: [[0, 1, 1]], states: ["at limit", "met"] }));
  assert.equal(first?.status, "at limit");
  assert.deepEqual(first?.active, [{ name: "b", state: 1, by: 0 }]);
  assert.equal(second?.status, "met");
});

test("a level with a residual that counts gives way, and it is said to what", () => {
  const states = levelStates(frameOf([0, 0.5], { active: [[0, 1, 1]], blocking: [[1, 0, 1, 0.4]] }));
  assert.equal(states[1]?.status, "gives way");
  assert.deepEqual(accountOf(states, ""), { kind: "bad", line: "second gives way to first (estimate)." });
});

test("of a level that is minimised and held back nobody says that it gets what it asks for", () => {
  const frame = frameOf([0, 200], { active: [[0, 1, 1]], blocking: [[1, 0, 1, 0.4]], states: ["at limit", "minimised"] });
  assert.deepEqual(accountOf(levelStates(frame), ""), { kind: "good", line: "All tasks are met; second is kept above 0 by first." });
});

/** The account of levels that give way, each to the levels that are named, mostly to the one with the longest name. */
function accountOfYielding(...yielding: [name: string, above: string[]][]): Account {
  const level = levelStates(frameOf([0, 0.5]))[1] as LevelState;
  const above = [...new Set(yielding.flatMap(([, names]) => names))];
  const states = [...above, ...yielding.map(([name]) => name)].map((name, k): LevelState => ({ ...level, level: k, name, status: "met" }));
  yielding.forEach(([, names], k) => Object.assign(states[above.length + k] as LevelState, {
    status: "gives way", others: 0, blocked: names.flatMap((name) => Array.from({ length: 30 }, (_, row) => ({ by: above.indexOf(name), row: `b${row}`, cost: name.length / (1 + row) }))),
  }));
  return accountOf(states, "");
}

test("the line says what gives way to what, also of several levels", () => {
  const lineOf = (...yielding: [string, string[]][]): string => accountOfYielding(...yielding).line;
  assert.equal(lineOf(["torso_height", ["com_xy"]]), "torso height gives way to com xy.");
  assert.equal(lineOf(["torso_height", ["limb_extension_limits"]], ["torso_roll_pitch", ["limb_extension_limits"]]), "torso height and torso roll pitch give way to limb extension limits.");
  assert.equal(lineOf(["com_xy", ["torque_limits"]], ["torso_yaw", ["com_xy", "torque_limits"]]), "com xy gives way to torque limits; torso yaw to com xy and torque limits.");
  assert.equal(lineOf(["com_xy", []], ["torso_yaw", ["com_xy"]]), "com xy gives way; torso yaw to com xy.");
  assert.equal(lineOf(["com_xy", ["torque_limits"]], ["torso_yaw", []]), "com xy gives way to torque limits; torso yaw gives way.");
  assert.equal(lineOf(["com_xy", []], ["torso_yaw", []]), "com xy and torso yaw give way.");
  assert.equal(lineOf(["torso_height", ["swing_foot", "limb_extension_limits"]], ["torso_roll_pitch", ["com_xy", "swing_foot", "limb_extension_limits"]]),
    "torso height gives way to swing foot and limb extension limits; torso roll pitch to com xy, swing foot and limb extension limits.");
  assert.equal(lineOf(["a", ["x"]], ["b", ["y"]], ["c", ["x"]]), "a and c give way to x; b to y.", "those that give way to the same are told together");
});

test("the line says whether its levels are estimated, and while they are being computed", () => {
  const states = levelStates(frameOf([0, 0.5], { active: [[0, 1, 1]], blocking: [[1, 0, 1, 0.4]] }));
  assert.equal(accountOf(states, "", { computing: true }).line, "second gives way to first (computing …).");
  for (const state of states) state.others = 0;
  assert.equal(accountOf(states, "").line, "second gives way to first.");
});

test("three levels that are held back above 0 are listed as three", () => {
  const level = levelStates(frameOf([0, 0.5], { blocking: [[1, 0, 1, 0.4]] }))[1] as LevelState;
  const states = ["a", "b", "c"].map((name): LevelState => ({ ...level, name, status: "minimised" }));
  assert.equal(accountOf(states, "").line, "All tasks are met; a, b and c are kept above 0.");
});

test("where no level has rows nothing is claimed", () => {
  const frame = frameOf([0, 0], { rows: 0, states: ["not solved", "not solved"] });
  assert.deepEqual(accountAt(frame), { kind: "none", line: "No level is solved." });
});

test("that the controller has stopped is no good news", () => {
  const states = levelStates(frameOf([0, 0], { states: ["not solved", "not solved"] }));
  assert.equal(accountOf(states, "", { stopped: true }).kind, "bad");
});

test("of a solve that was cut off nothing is said of the level that it was in and those below", () => {
  const frame = frameOf([0, 2], { active: [[1, 1, 0]], states: ["met", "not solved"] });
  const states = levelStates(frame);
  assert.deepEqual(states.map(({ status }) => status), ["met", "not solved"]);
  assert.deepEqual([states[1]?.residual, states[1]?.active], [NaN, []]);
  const cut = "The solver was cut off in second: of it and the levels below it nothing is known.";
  assert.deepEqual(accountAt(frame), { kind: "bad", line: cut });
  assert.equal(accountAt(frameOf([2, 2], { states: ["not solved", "not solved"] })).line, cut.replace("second", "first"));
});

test("of a solution that commands nothing it is told in the program's words", () => {
  const texts: Record<string, string> = { "command.mode": "sit", "told.unused": "No hierarchy was solved", "told.because": "IMU stopped", "told.stop": "IMU stopped" };
  const schema = schemaOf({ ...Object.fromEntries(Object.keys(texts).map((name) => [name, 1])), "hierarchy.level.first.num_rows": 1 });
  for (const [name, text] of Object.entries(texts)) Object.assign(schema.channel(name) as object, { values: [text] });
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from([0, 0, 0, 0, 3]), undefined);
  const { line, kind } = accountAt(table.frame(0));
  assert.deepEqual([line, kind], ["No hierarchy was solved: sit, because IMU stopped.", "bad"]);
});

test("a level's residual is plotted with the unit of its rows", () => {
  const schema = schemaOf({ "hierarchy.level.first.residual": 1, "hierarchy.level.second.residual": 1, "hierarchy.level.second.iterations": 1 });
  assert.deepEqual(schema.channels.map(({ unit }) => unit), ["N", "m/s²", ""]);
});

test("between two hierarchies no level is said to have its optimum", () => {
  const states = levelStates(frameOf([0, 0.5]));
  assert.deepEqual(accountOf(states, "", { share: 0.35 }), { kind: "bad", line: "Between two hierarchies (35 % of the way): second gives way." });
  assert.equal(accountOf(levelStates(frameOf([0, 0])), "", { share: 0 }).line, "Between two hierarchies (0 % of the way): all tasks are met.");
  assert.deepEqual(accountOf(states, "", { share: 1 }), accountOf(states, ""));
  assert.equal(blendShare(frameOf([0, 0])), 1, "of a log that has none");
});
