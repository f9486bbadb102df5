import assert from "node:assert/strict";
import { test } from "node:test";
import { withTold } from "../src/data/changes.ts";

const at = (time: number, text = "push"): { time: number; text: string } => ({ time, text });

test("a page that comes late knows the changes from before it came, those that both know once", () => {
  assert.deepEqual(withTold([], [at(1), at(2)]), [at(1), at(2)]);
  assert.deepEqual(withTold([at(2), at(3)], [at(1), at(2)]), [at(1), at(2), at(3)]);
});

test("two pushes of a paused run are two", () => {
  assert.deepEqual(withTold([at(2)], [at(2), at(2)]), [at(2), at(2)]);
  assert.deepEqual(withTold([at(2), at(2)], [at(2)]), [at(2), at(2)]);
});
