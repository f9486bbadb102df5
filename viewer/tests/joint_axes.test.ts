import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { JointAxes } from "../src/overlays/joints.ts";
import type { Picture } from "../src/overlays/overlay.ts";

test("each joint that is known has its name at the tip of its axis", () => {
  const put: [string, number[]][] = [];
  const labels = { put: (p: THREE.Vector3, text: string) => void put.push([text, p.toArray()]) };
  const axisOf = (name: string, place: THREE.Vector3, axis: THREE.Vector3): boolean => {
    place.set(1, 2, 3);
    axis.set(0, name === "LF_HAA" ? 0 : 1, name === "LF_HAA" ? 1 : 0);
    return name !== "gone";
  };
  const overlay = new JointAxes();
  overlay.update({ labels, axisOf, header: { robot: { joint_names: ["LF_HAA", "gone", "LF_HFE"] } } } as unknown as Picture);
  assert.deepEqual(put.map(([name]) => name), ["LF_HAA", "LF_HFE"]);
  assert.deepEqual(put.map(([, place]) => place.map((x) => Number(x.toFixed(2)))), [[1, 2, 3.12], [1, 2.12, 3]]);
});
