import assert from "node:assert/strict";
import { test } from "node:test";
import type { Frame } from "../src/data/frame.ts";
import { accountOf, levelStates } from "../src/data/hierarchy.ts";
import { blockOf, schemaOf } from "./make.ts";
import { readBlock } from "../src/protocol/block.ts";
import { FrameTable } from "../src/data/table.ts";

const FIELDS = ["residual", "num_rows", "degrees_of_freedom_left", "iterations"];

function frameOf(residuals: [number, number], more: { active?: [number, number, number][]; blocking?: [number, number, number, number][]; rows?: number } = {}): Frame {
  const schema = schemaOf(Object.fromEntries(["first", "second"].flatMap((level) => FIELDS.map((field) => [`hierarchy.level.${level}.${field}`, 1]))));
  const rows = more.rows ?? 2;
  const table = new FrameTable(schema, 1);
  const values = [residuals[0], rows, 6, 1, residuals[1], rows, 0, 2];
  readBlock(blockOf([{ tick: 0, time: 0, values, ...more }]), schema.frameFloats, (...frame) => table.append(...frame));
  return table.frame(0);
}

test("levels that reach what they ask for are met", () => {
  assert.deepEqual(levelStates(frameOf([1e-12, 0])).map((level) => level.status), ["met", "met"]);
  assert.equal(accountOf(levelStates(frameOf([0, 0]))), "Every level gets what it asks for.");
});

test("a level with a row at its bound is at its limit", () => {
  const [first, second] = levelStates(frameOf([0, 0], { active: [[0, 1, 1]] }));
  assert.equal(first?.status, "at limit");
  assert.deepEqual(first?.active, [{ name: "b", level: 0, state: 1 }]);
  assert.equal(second?.status, "met");
});

test("a level with a residual that counts gives way, and it is said to what", () => {
  const states = levelStates(frameOf([0, 0.5], { active: [[0, 1, 1]], blocking: [[1, 0, 1, 0.4]] }));
  assert.equal(states[1]?.status, "gives way");
  assert.equal(accountOf(states), "second gives way to first (b), 0.50 m/s² short.");
});

test("all rows that hold a level back are named", () => {
  const rows: [number, number, number, number][] = [[1, 0, 1, 0.4], [1, 0, 0, 0.2]];
  const states = levelStates(frameOf([0, 0.5], { active: [[0, 1, 1], [0, -1, 0]], blocking: rows }));
  assert.equal(accountOf(states), "second gives way to first (b) and first (a), 0.50 m/s² short.");
});

test("what is less than people should see is not told, also beyond a bound", () => {
  assert.equal(levelStates(frameOf([0.2, 0], { active: [[0, 3, 0]] }))[0]?.status, "at limit");
});

test("a level that is never content is minimised, whatever its residual", () => {
  const frame = frameOf([200, 0]);
  Object.assign(frame.schema, { visible: [null, 0.02] });
  assert.equal(levelStates(frame)[0]?.status, "minimised");
});

test("a level without rows asks for nothing", () => {
  assert.equal(levelStates(frameOf([0, 0], { rows: 0 }))[0]?.status, "no rows");
});
