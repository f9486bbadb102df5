import assert from "node:assert/strict";
import { test } from "node:test";
import type { Frame } from "../src/data/frame.ts";
import { bend, Posture, type Jointed } from "../src/scene/posture.ts";
import { schemaOf } from "./make.ts";

const NAMES = ["HAA", "HFE", "KFE"];

function jointed(...angles: number[]): Jointed {
  const joints = Object.fromEntries(NAMES.map((name, j) => [name, { angle: angles[j] }]));
  return { joints, setJointValue: (name, value) => ((joints[name] as { angle: unknown }).angle = value) };
}

const anglesOf = (robot: Jointed): unknown[] => NAMES.map((name) => robot.joints[name]?.angle);

function frameOf(p: number[], q: number[]): Frame {
  const schema = schemaOf({ "state.p_WB": 3, "state.q_WB": 4, "state.q": 3 });
  return { schema, tick: 0, time: 0, values: Float32Array.from([...p, 1, 0, 0, 0, ...q]), active: [], blocking: [] };
}

test("a robot stands where its base is, also while an encoder says nothing", () => {
  const posture = new Posture(3);
  assert.ok(posture.read(frameOf([1, 2, 3], [0.25, NaN, -0.5]), "state", "state"));
  assert.deepEqual([posture.p_SB, posture.q], [[1, 2, 3], [0.25, NaN, -0.5]]);
  assert.ok(!posture.read(frameOf([1, NaN, 3], [0, 0, 0]), "state", "state"));
  assert.ok(!posture.read(frameOf([1, 2, 3], [0, 0, 0]), "truth", "truth"), "a log without it");
  assert.ok(posture.read(frameOf([1, 2, 3], [0, 0, 0]), "state", "truth"));
  assert.deepEqual(posture.q, [NaN, NaN, NaN], "nothing of the tick before");
});

test("a joint whose angle is not known stands as the true robot has it, without one where it was", () => {
  const ghost = jointed(1, 2, 3);
  bend(ghost, NAMES, [0.25, NaN, -0.5], jointed(7, 8, 9));
  assert.deepEqual(anglesOf(ghost), [0.25, 8, -0.5]);
  bend(ghost, NAMES, [NaN, 0.75, NaN]);
  assert.deepEqual(anglesOf(ghost), [0.25, 0.75, -0.5]);
});
