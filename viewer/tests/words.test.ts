import assert from "node:assert/strict";
import { test } from "node:test";
import type { LevelState } from "../src/data/hierarchy.ts";
import { effortOf } from "../src/panels/hierarchy_panel.ts";
import { amountOf, rowsOf, boundsMotion, briefOf, metaOf, timeOf, words } from "../src/panels/level_card.ts";
import { calibrationText, modeText } from "../src/panels/head.ts";
import { logFact } from "../src/live_link.ts";
import { clockText, runStateOf, endedText, newestText, nextSpeed, pastText, playText } from "../src/panels/transport.ts";
import { beliefText, type Belief } from "../src/panels/tune_panel.ts";

const level: LevelState = {
  level: 1, name: "com_xy", unit: "m/s²", status: "met", residual: 0, rows: 2, freedom: 24, iterations: 1, time: NaN, active: [], missed: [], blocked: [],
};
const above: LevelState = { ...level, level: 0, name: "friction_cone" };

test("a clock never exceeds the whole", () => {
  for (const whole of [0.04, 12.3375, 999.9999, 1234.5678]) {
    const [time, all] = clockText(whole, whole).replace(" s", "").split(" / ").map(Number) as [number, number];
    assert.equal(time, all);
  }
  assert.equal(clockText(9.885, undefined), "9.8850 s");
});

test("any speed that the program takes has a next one of the menu", () => {
  const speeds = [0.5, 1, 2, 4, 8];
  assert.deepEqual([1, -1, 2, 9].map((steps) => nextSpeed(speeds, 3, steps)), [4, 2, 8, 8]);
  assert.deepEqual([nextSpeed(speeds, 1, 1), nextSpeed(speeds, 1, -1)], [2, 0.5]);
  assert.equal(nextSpeed(speeds, 8, 1), undefined);
});

test("the friction that was given and what the controller believes are two things", () => {
  const feet = (...friction: number[]): Belief[] => friction.map((one, k) => ({ name: ["LF", "RF", "LH", "RH"][k] as string, friction: one }));
  assert.equal(beliefText(feet(0.5, 0.5, 0.5, 0.5), 0.5), "The controller believes μ = 0.50 of every foot now.");
  assert.equal(beliefText(feet(0.5, 0.31, 0.5, 0.42), 0.5), "The controller believes now, after slips: LF 0.50, RF 0.31, LH 0.50, RH 0.42.");
  assert.equal(beliefText(feet(NaN, 0.5, 0.5, 0.5), 0.5), "");
});

test("a level's second line says what matters most: who holds it back, its limits, its size", () => {
  assert.equal(briefOf(level, [above, level]), "2 rows");
  const active = [{ name: "LF_KFE", state: 1, by: 0 }, { name: "RF_KFE", state: -1, by: 0 }];
  assert.equal(briefOf({ ...level, status: "at limit", active }, [above, level]), "2 rows: LF_KFE (upper), …");
  const blocked = [{ by: 0, row: "LF 1", cost: 1 }, { by: 0, row: "LF 2", cost: 0.5 }];
  assert.equal(briefOf({ ...level, status: "gives way", active, blocked }, [above, level]), "to friction cone", "as it gives way");
  assert.equal(briefOf({ ...level, status: "minimised", blocked }, [above, level]), "held back by friction cone");
  assert.equal(briefOf({ ...level, status: "met", blocked }, [above, level]), "2 rows", "what is met is not held back");
});

test("sizes and times are told in words", () => {
  assert.equal(metaOf(level), "2 rows · leaves 24 degrees of freedom to the levels below · 1 iteration");
  assert.equal(effortOf(11, 119, [level]), "All levels: 11.0 µs, 1 iteration · tick: 119 µs");
  assert.equal(effortOf(0, 1.23, [{ rows: 0, iterations: 0 }]), "Tick: 1.23 µs");
  assert.equal(effortOf(NaN, NaN, [level]), "1 iteration");
  assert.deepEqual([3.456, 12.3, NaN].map((time) => timeOf({ rows: 2, time })), ["3.46 µs", "12.3 µs", "–"]);
  assert.equal(timeOf({ rows: 0, time: 0.1 }), "", "what asks for nothing takes no time worth telling");
});

test("who looks back is told where the run is, and what the space bar does there", () => {
  const status = { paused: false, ended: null };
  const runState = [runStateOf(status, true), runStateOf({ ...status, paused: true }, true), runStateOf({ paused: true, ended: "fell" }, true), runStateOf(status, false)];
  assert.deepEqual(runState.map((one) => pastText(48.1249, one)), ["past; the run is at 48.1 s", "past; the run is paused at 48.1 s", "past; the run ended at 48.1 s", "past; the newest is 48.1 s"]);
  const [now, past, log] = [{ live: true, past: false }, { live: true, past: true }, { live: false, past: false }];
  assert.deepEqual([true, false].map((running) => playText(now, running)), ["pause the run (space)", "let the run go on (space)"]);
  for (const running of [true, false]) assert.match(playText(past, running), /the run is left alone/);
  assert.match(playText(now, true, false), /the run is left alone/, "of a page that only looks");
  assert.deepEqual([true, false].map((running) => playText(log, running)), ["pause (space)", "play (space)"]);
});

test("of a program that is no longer heard it is told what is known, never that its run is live", () => {
  const [runs, paused, ended] = [{ paused: false, ended: null }, { paused: true, ended: null }, { paused: false, ended: "fell" }];
  const modes = [runs, paused, ended, undefined].map((status) => [true, false].map((heard) => modeText({ past: false }, runStateOf(status, heard))));
  assert.deepEqual(modes, [["live", "not known"], ["paused", "not known"], ["ended", "ended"], ["not known", "not known"]]);
  assert.equal(modeText({ past: true }, runStateOf(runs, false)), "past");
  assert.deepEqual([true, false].map((heard) => endedText("", runStateOf(runs, heard))), ["not yet", "not known"]);
  assert.equal(endedText("fell", runStateOf(ended, false)), "fell");
});

test("of a robot that calibrates it is told how long that goes on, of the present alone", () => {
  const [now, past] = [{ past: false }, { past: true }];
  assert.deepEqual([modeText(now, "runs", true), modeText(now, "paused", true), modeText(past, "runs", true)], ["calibrating", "paused", "past"]);
  assert.deepEqual([calibrationText(now, 5.2), calibrationText(now, 0), calibrationText(now, null), calibrationText(past, 5.2)], ["6 s left, then it walks", "once more", "", ""]);
});

test("where a run has ended there is nothing to let go on", () => {
  const [now, past] = [{ live: true, past: false }, { live: true, past: true }];
  assert.deepEqual([true, false].map((may) => playText(now, false, may, "ended")), ["the run has ended; ↺ begins it again", "the run has ended"]);
  assert.match(playText(past, false, true, "ended"), /play on from here/);
});

test("of a program that says nothing neither its log nor what can be done with its run is told as of one that is there", () => {
  const [now, past] = [{ live: true, past: false }, { live: true, past: true }];
  assert.equal(playText(now, true, true, "unheard"), "the program says nothing: the run can't be paused");
  assert.match(playText(past, true, true, "unheard"), /stop here/);
  const runStates = ["runs", "paused", "ended", "unheard"] as const;
  assert.deepEqual(runStates.map((runState) => logFact("/tmp/run.mcap", runState)), ["recording run.mcap", "recording run.mcap", "recorded in run.mcap", "log: run.mcap"]);
});

test("the button that leads to the newest picture is not called live where nothing is", () => {
  const texts = (["runs", "ended", "unheard"] as const).map((runState) => [false, true].map((back) => newestText(back, runState)[0]));
  assert.deepEqual(texts, [["Live", "To now"], ["The end", "To the end"], ["Newest", "To newest"]]);
});

test("a limit of lengths or angles keeps something from going beyond it, one of forces is reached", () => {
  assert.deepEqual(["m/s²", "rad/s²", "N", "N·m"].map((unit) => boundsMotion({ unit })), [true, true, false, false]);
  assert.deepEqual([1, -1, 3, -3].map((bound) => words(bound, true)),
    ["kept below its upper bound", "kept above its lower bound", "not kept below its upper bound", "not kept above its lower bound"]);
  assert.deepEqual([1, -1, 3, -3].map((bound) => words(bound, false)), ["at its upper bound", "at its lower bound", "above its bound", "below its bound"]);
});

test("a row beyond its bound says by how much, where that is known", () => {
  assert.deepEqual([{ state: -3, by: -12.5 }, { state: 3, by: 0.3 }, { state: 1, by: 0 }, { state: 3, by: NaN }].map((row) => amountOf(row, "N")),
    [" by 12.5 N", " by 0.300 N", "", ""]);
});

test("a level that gives way says which of its rows it missed, one that is never content does not", () => {
  const active = [{ name: "RF +x", state: 3, by: 0.3 }], missed = [{ name: "x", state: 2, by: -0.31 }];
  assert.equal(rowsOf({ active, missed, status: "gives way", unit: "N" }), "RF +x above its bound by 0.300 N, x missed by 0.310 N");
  assert.equal(rowsOf({ active: [], missed, status: "minimised", unit: "N" }), "");
});
