import assert from "node:assert/strict";
import { test } from "node:test";
import { isPulled } from "../src/data/pulls.ts";
import type { Mark } from "../src/data/source.ts";

const PERIOD = 0.0025;
const change = (time: number, text: string): Mark => ({ time, text, leg: "", kind: "change" });
const marks = [
  change(1, "push of 20 N·s at base, force (0, 100, 0) N for 0.2 s"),
  change(2, "pull at base, force (0, 40, 0) N"),
  { time: 2.5, text: "lift-off", leg: "LF", kind: "event" } as Mark,
  change(3, "the pull ends after 40 N·s"),
  change(4, "push of 20 N·s at base, force (0, 100, 0) N for 0.2 s"),
];

test("a pull is one from its begin to the last frame that has its force", () => {
  for (const [tick, pulled] of [[0, false], [1.1, false], [2, true], [2.5, true], [3 - PERIOD, true], [3, true], [3 + PERIOD, false], [4.1, false]] as const)
    assert.equal(isPulled(marks, tick, PERIOD), pulled, `${tick} s`);
});

test("a pull that has no end yet goes on, and one at another body follows at once", () => {
  assert.ok(isPulled(marks.slice(0, 3), 60, PERIOD));
  assert.ok(isPulled([...marks, change(5, "pull at base, force (1, 0, 0) N"), change(6, "the pull ends after 1 N·s"), change(6, "pull at LF_SHANK, force (1, 0, 0) N")], 6.5, PERIOD));
});
