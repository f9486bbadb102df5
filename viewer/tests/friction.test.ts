import assert from "node:assert/strict";
import { test } from "node:test";
import { frictionState, marginClass, pyramidAxes, pyramidCorners } from "../src/math/friction.ts";
import { rotate } from "../src/scene/terrain_geometry.ts";
import { randomNumbers } from "./make.ts";

const close = (a: number, b: number, what = ""): void => assert.ok(Math.abs(a - b) < 1e-9, `${what} ${a} is not ${b}`);
const FLAT = [1, 0, 0, 0, 1, 0, 0, 0, 1];

/** A random rotation, row by row. */
function randomRotation(random: () => number): number[] {
  const q = Array.from({ length: 4 }, () => random() - 0.5);
  const size = Math.hypot(...q);
  const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => rotate(q.map((one) => one / size), axis));
  return [0, 1, 2].flatMap((row) => columns.map((column) => column[row] as number));
}

test("a force along the normal has all of its friction left", () => {
  const state = frictionState([0, 0, 100], [0, 0, 1], 0.5);
  close(state.margin, 50);
  close(state.share, 1);
});

test("the margin is μ f_n − |f_t| on any ground", () => {
  const random = randomNumbers(3);
  for (let run = 0; run < 200; ++run) {
    const R = randomRotation(random);
    const local = [random() - 0.5, random() - 0.5, random()] as const;
    const force = [0, 1, 2].map((i) => local[0] * (R[3 * i] as number) + local[1] * (R[3 * i + 1] as number) + local[2] * (R[3 * i + 2] as number));
    const state = frictionState(force, [R[2] as number, R[5] as number, R[8] as number], 0.4);
    close(state.normal, local[2]);
    close(state.margin, 0.4 * local[2] - Math.hypot(local[0], local[1]));
  }
});

test("a foot that pulls at the ground has no friction left", () => {
  assert.equal(marginClass(frictionState([0, 0, -5], [0, 0, 1], 0.5).share), "bad");
});

test("classes of the margin go from good over near to bad", () => {
  assert.deepEqual([0.9, 0.3, 0.05, -1].map(marginClass), ["good", "near", "bad", "bad"]);
});

test("the pyramid's corners lie where both tangential parts are at their limit", () => {
  const random = randomNumbers(4);
  for (let run = 0; run < 50; ++run) {
    const R = randomRotation(random);
    const part = (p: number[], column: number): number => [0, 1, 2].reduce((sum, i) => sum + (p[i] as number) * (R[3 * i + column] as number), 0);
    const corners = pyramidCorners(R, 0.3, 80);
    for (const corner of corners) {
      close(Math.abs(part(corner, 0)), 24);
      close(Math.abs(part(corner, 1)), 24);
      close(part(corner, 2), 80);
    }
    assert.equal(new Set(corners.map((corner) => `${part(corner, 0) > 0} ${part(corner, 1) > 0}`)).size, 4);
  }
});

test("axes with gravity keep the heading and stand upright", () => {
  const tilted = [0.8, -0.6, 0, 0.48, 0.64, -0.6, 0.36, 0.48, 0.8];
  const axes = pyramidAxes(tilted, true);
  assert.deepEqual(axes.slice(6), [0, 0, 1]);
  close(Math.atan2(axes[3] as number, axes[0] as number), Math.atan2(0.48, 0.8));
  assert.equal(pyramidAxes(FLAT, false), FLAT);
});
