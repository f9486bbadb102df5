import assert from "node:assert/strict";
import { test } from "node:test";
import closedLoop from "../../surefoot/closed_loop/closed_loop.cpp";
import { columnsOf, hintOf, weightOf } from "../src/data/mark_columns.ts";
import { endOf } from "../src/data/marks.ts";
import type { Mark } from "../src/data/source.ts";

const event = (time: number, text = "lift-off"): Mark => ({ time, text, leg: "LF", kind: "event" });
const mode = (time: number): Mark => ({ time, text: "command mode: hold", leg: "", kind: "mode" });

test("ten thousand events of a long walk do not hide the one that matters", () => {
  const marks = Array.from({ length: 10_000 }, (_, k) => event(0.1 * k));
  marks.splice(5000, 0, event(500.01, "stance foot slides: less force along the ground, slower"), mode(500.02));
  const columns = columnsOf(marks, 0, 1000, 200);
  assert.equal(columns.length, 200);
  assert.equal(columns.reduce((sum, { usual }) => sum + usual, 0), 10_000);
  const told = columns.filter(({ other }) => other !== undefined);
  assert.deepEqual(told.map(({ at, other }) => [at, other?.weight, other?.mark.text]), [[100, "grave", "command mode: hold"]]);
});

test("columns without marks are left out, and marks outside are", () => {
  const columns = columnsOf([event(-1), event(0), event(0.01), event(10), event(11)], 0, 10, 10);
  assert.deepEqual(columns.map(({ at, usual }) => [at, usual]), [[0, 2], [9, 1]]);
});

test("a hint tells the weightiest, and how many more there are", () => {
  const marks = [event(1), event(1.1), mode(1.2), event(5)];
  assert.equal(hintOf(marks, 1, 0.5), "1.2000 s command mode: hold, and 2 more near it");
  assert.equal(hintOf(marks, 5, 0.5), "5.0000 s LF lift-off");
  assert.equal(hintOf(marks, 8, 0.5), "");
  const hole: Mark = { time: 12.4, text: "12.40 s to 12.61 s can't be read: why", leg: "", kind: "damage" };
  assert.equal(hintOf([hole], 12.4, 0.5), "12.40 s to 12.61 s can't be read: why");
});

test("of the ends that the program knows that of its time and the goal are those of a run that went as it should", () => {
  const ends = [...closedLoop.matchAll(/case Ending::(\w+):\s+return "([^"]+)";/g)].map(([, end, why]) => [end, weightOf(endOf(1, why as string))]);
  assert.deepEqual(ends.filter(([, weight]) => weight === "change").map(([end]) => end), ["finished", "goal_reached"]);
  assert.ok(ends.filter(([, weight]) => weight === "grave").length >= 3);
});

test("what is no part of a usual walk has more weight than what is", () => {
  assert.equal(weightOf(event(0, "touchdown")), "usual");
  assert.equal(weightOf(event(0, "pushed out of balance: step to recover")), "notable");
  assert.equal(weightOf({ kind: "damage", text: "" }), "grave");
  const ends = ["ran to its end", "the whole duration", "goal reached", "fell: the base touched the ground", "the controller stopped for safety"];
  assert.deepEqual(ends.map((why) => weightOf(endOf(1, why))), ["change", "change", "change", "grave", "grave"]);
  assert.equal(hintOf([endOf(12.3, "fell")], 12.3, 0.5), "12.3000 s ended: fell");
});
