import assert from "node:assert/strict";
import { test } from "node:test";
import { leverOf, type Push } from "../src/data/pushes.ts";
import { randomNumbers } from "./make.ts";

type Three = [number, number, number];
const cross = ([a, b, c]: Three, [x, y, z]: Three): Three => [b * z - c * y, c * x - a * z, a * y - b * x];
const near = (a: Three, b: Three): void => a.forEach((value, k) => assert.ok(Math.abs(value - (b[k] as number)) < 1e-9, `${a} and ${b}`));

test("an arrow begins in the line in which its force acts, where that is nearest to the centre of mass", () => {
  const random = randomNumbers(3);
  const three = (): Three => [random() - 0.5, random() - 0.5, random() - 0.5];
  for (let round = 0; round < 100; ++round) {
    const held = three(), force = three().map((one) => 100 * one) as Three;
    const push: Push = { body: 0, force, torque: cross(held, force) };
    const lever = leverOf(push, 1);
    near(cross(lever, force), push.torque);
    assert.ok(Math.hypot(...lever) <= Math.hypot(...held) + 1e-9);
  }
});

test("a push at the centre of mass begins there, and one with a torque that its body is too small for, too", () => {
  assert.deepEqual(leverOf({ body: 0, force: [0, 10, 0], torque: [0, 0, 0] }, 1), [0, 0, 0]);
  assert.deepEqual(leverOf({ body: 0, force: [0, 1, 0], torque: [0, 0, 5] }, 1), [0, 0, 0]);
});
