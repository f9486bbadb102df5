import assert from "node:assert/strict";
import { test } from "node:test";
import { MOST_LINES, stylesOf } from "../src/panels/line_styles.ts";

const different = (legs: (number | undefined)[]): number => new Set(stylesOf(legs).map((style) => JSON.stringify(style))).size;

test("no two lines of a plot look the same, as many as it takes", () => {
  for (let count = 1; count <= MOST_LINES; ++count) {
    assert.equal(different(Array.from({ length: count }, () => undefined)), count);
    assert.equal(different(Array.from({ length: count }, () => 2)), count, "of one leg");
    assert.equal(different(Array.from({ length: count }, (_, k) => k % 4)), count, "of all legs");
    assert.equal(different(Array.from({ length: count }, (_, k) => k % 6)), count, "of six legs");
  }
  assert.equal(different([0, 0, 0, 0, 0, 1, 1]), 7, "more of one leg than there are dashes");
});

test("lines of several legs have the colours of their legs, those of one leg colours of their own", () => {
  const joints = stylesOf([0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3]);
  assert.deepEqual([0, 3, 6, 9].map((k) => new Set(joints.slice(k, k + 3).map(({ colour }) => colour)).size), [1, 1, 1, 1]);
  assert.equal(new Set(joints.map(({ colour }) => colour)).size, 4);
  assert.equal(new Set(stylesOf([0, 0, 0]).map(({ colour }) => colour)).size, 3);
});
