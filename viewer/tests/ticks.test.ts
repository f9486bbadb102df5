import assert from "node:assert/strict";
import { test } from "node:test";
import { ticksOf, tickTexts } from "../src/data/ticks.ts";
import { randomNumbers } from "./make.ts";

test("an axis has two numbers at least, all of them within it, and no more than there is room for", () => {
  const random = randomNumbers(5);
  for (let round = 0; round < 5000; ++round) {
    const size = 10 ** (12 * random() - 6), low = size * (2 * random() - 1), high = low + size * (0.01 + random()), most = 1 + Math.floor(6 * random());
    const ticks = ticksOf(low, high, most);
    const slack = 1e-6 * (high - low);
    assert.ok(ticks.length >= 2 && ticks.length <= Math.max(2, most), `${low} to ${high}, ${most}: ${ticks}`);
    assert.ok(ticks.every((tick) => tick >= low - slack && tick <= high + slack), `${low} to ${high}: ${ticks}`);
    assert.equal(new Set(tickTexts(ticks)).size, ticks.length, `${low} to ${high}: ${tickTexts(ticks)}`);
  }
});

test("the numbers of an axis are easy ones, with zero where it is within", () => {
  assert.deepEqual(ticksOf(0, 640, 4), [0, 200, 400, 600]);
  assert.deepEqual(ticksOf(-0.4, 0.45, 3), [-0.4, 0, 0.4]);
  assert.deepEqual(tickTexts(ticksOf(-0.29, 0.21, 3)), ["−0.2", "0", "0.2"]);
  assert.deepEqual(tickTexts(ticksOf(1000.02, 1000.31, 3)), ["1000.1", "1000.2", "1000.3"]);
  assert.deepEqual(ticksOf(3, 3, 4), []);
});
