import assert from "node:assert/strict";
import { test } from "node:test";
import { paceText, speedText } from "../src/data/speed.ts";

const status = (more = {}) => ({ paused: false, ended: null, speed: 1, real_factor: 1, ...more });

test("a run that can't go as fast as was asked for says so", () => {
  assert.equal(paceText(status()), "1× real time");
  assert.equal(paceText(status({ real_factor: 0.42 })), "0.42× of 1× asked: the program's machine is busy");
  assert.equal(paceText(status({ speed: 8, real_factor: 3.04 })), "3× of 8× asked: the program's machine is busy");
  assert.equal(paceText(status({ speed: 0.25, real_factor: 0.25 })), "1/4× real time");
  assert.equal(paceText(status({ real_factor: 4.71 })), "4.7× real time", "of a calibration that nobody looks at");
});

test("of a speed that was asked for just now nothing is known yet, and of a run that stands nothing is said", () => {
  assert.equal(paceText(status({ speed: 8, real_factor: 0 })), "8× real time");
  assert.equal(paceText(status({ real_factor: 0.1, paused: true })), "");
  assert.equal(paceText(status({ real_factor: 0.1, ended: "fell" })), "");
});

test("speeds are told as fractions, also those that no menu has", () => {
  assert.deepEqual([1 / 32, 0.5, 1, 8, 3, 0.3].map(speedText), ["1/32×", "1/2×", "1×", "8×", "3×", "0.3×"]);
});
