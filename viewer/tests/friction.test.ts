import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import type { Frame } from "../src/data/frame.ts";
import { percent, pyramidCorners, pyramidHeight, useClass } from "../src/math/friction.ts";
import { rotate } from "../src/math/geometry.ts";
import type { Picture } from "../src/overlays/overlay.ts";
import { FrictionPyramids } from "../src/overlays/pyramids.ts";
import { sentences } from "../src/panels/state_panel.ts";
import { coloursOf, paletteOf } from "../src/scene/palette.ts";
import { randomNumbers, schemaOf } from "./make.ts";

const close = (a: number, b: number, what = ""): void => assert.ok(Math.abs(a - b) < 1e-9, `${what} ${a} is not ${b}`);

/** A random orientation. */
function randomTurn(random: () => number): number[] {
  const q = Array.from({ length: 4 }, () => random() - 0.5);
  const size = Math.hypot(...q);
  return q.map((one) => one / size);
}

/** The part of v along an axis of P. */
const part = (q_WP: number[], v: number[], axis: number[]): number =>
  rotate(q_WP, axis).reduce((sum, one, i) => sum + one * (v[i] as number), 0);

test("classes of what is used go from good over near to bad, which a face is", () => {
  assert.deepEqual([0, 0.5, 0.7, 0.95, 1, 1.3].map(useClass), ["good", "good", "near", "bad", "bad", "bad"]);
});

test("a pyramid is as high as its force, and never too low to be seen", () => {
  assert.equal(pyramidHeight(200, 300, 0.002), 0.4);
  assert.equal(pyramidHeight(900, 300, 0.002), 0.6);
  assert.equal(pyramidHeight(7, 300, 0.002), 0.1);
});

test("the pyramid's corners lie where both tangential parts are at their limit", () => {
  const random = randomNumbers(4);
  for (let run = 0; run < 50; ++run) {
    const q_WP = randomTurn(random);
    const corners = pyramidCorners(q_WP, 0.3, 80);
    for (const corner of corners) {
      close(Math.abs(part(q_WP, corner, [1, 0, 0])), 24);
      close(Math.abs(part(q_WP, corner, [0, 1, 0])), 24);
      close(part(q_WP, corner, [0, 0, 1]), 80);
    }
    assert.equal(new Set(corners.map((corner) => `${part(q_WP, corner, [1, 0, 0]) > 0} ${part(q_WP, corner, [0, 1, 0]) > 0}`)).size, 4);
  }
});

test("the corners go around the axis counter-clockwise", () => {
  const [a, b] = pyramidCorners([1, 0, 0, 0], 0.5, 10) as [number[], number[]];
  assert.deepEqual([a, b], [[5, 5, 10], [-5, 5, 10]]);
});

test("the state tells what each foot that carries uses of its friction pyramid", () => {
  const schema = schemaOf({ "commanded.friction_use.LF": 1, "commanded.friction_use.RF": 1, "commanded.friction_use.LH": 1, "commanded.friction_use.RH": 1 });
  const frame: Frame = { schema, tick: 0, time: 0, values: new Float32Array([0.254, NaN, 1, 1.04]), active: [], blocking: [] };
  assert.deepEqual(sentences(frame).find(([name]) => name === "Pyramid used"), ["Pyramid used", "LF 25 %, LH 100 %, RH 104 %"]);
  frame.values.fill(NaN);
  assert.equal(new Map(sentences(frame)).get("Pyramid used"), "");
  assert.equal(percent(0), "0 %");
});

test("the pyramid that is drawn is the one that held the force, with the share that is used", () => {
  const q_WP = randomTurn(randomNumbers(9));
  const schema = schemaOf({ "commanded.friction_use.RF": 1, "commanded.normal_force.RF": 1, "commanded.q_WP.RF": 4, "commanded.pyramid_friction.RF": 1, "model.p_WF.RF": 3 });
  const frame: Frame = { schema, tick: 0, time: 0, values: new Float32Array([0.93, 200, ...q_WP, 0.3, 1, 2, 3]), active: [], blocking: [] };
  const put: [string, string, boolean][] = [];
  const spared: THREE.Vector3[][] = [];
  const labels = { put: (_: THREE.Vector3, ...told: [string, string, boolean]) => put.push(told), spare: (points: THREE.Vector3[]) => spared.push(points.map((point) => point.clone())) };
  const picture = { frame, header: { robot: { foot_radius: 0.03 } }, labels, newton: 0.002, colours: coloursOf(paletteOf(false)), beliefToWorld: new THREE.Matrix4() };
  const overlay = new FrictionPyramids();
  overlay.update(picture as unknown as Picture);
  assert.deepEqual(put, [["RF 93 %", "use leg1 bad", true]]);
  assert.deepEqual(spared.map((points) => points.length), [5], "the pyramid itself is to be seen beside its number");
  const [sides] = overlay.root.children[1]?.children as [THREE.Mesh<THREE.BufferGeometry, THREE.Material>];
  assert.deepEqual([...overlay.root.children.map(({ visible }) => visible), sides.material.depthTest], [false, true, false], "seen through the leg that it stands at");
  const drawn = sides.geometry.getAttribute("position").array.slice(0, 15);
  const tip = [1, 2, 2.97];
  [tip, ...pyramidCorners(q_WP, 0.3, 0.4).map((corner) => corner.map((one, i) => one + (tip[i] as number)))].flat().forEach((one, i) =>
    assert.ok(Math.abs(one - (drawn[i] as number)) < 1e-6));
  assert.ok((spared[0] ?? []).every((point) => [0, 1, 2, 3, 4].some((k) => point.distanceTo(new THREE.Vector3().fromArray(drawn, 3 * k)) < 1e-5)));
  assert.deepEqual([...sides.geometry.getAttribute("color").array.slice(0, 3)], [...new Float32Array(new THREE.Color(paletteOf(false).margin.bad).toArray())]);
});

test("of a pyramid that is half used it is to be seen how much, too", () => {
  const schema = schemaOf({ "commanded.friction_use.LH": 1, "commanded.normal_force.LH": 1, "commanded.q_WP.LH": 4, "commanded.pyramid_friction.LH": 1, "model.p_WF.LH": 3 });
  for (const use of [0.2, 0.73]) {
    const frame: Frame = { schema, tick: 0, time: 0, values: new Float32Array([use, 200, 1, 0, 0, 0, 0.3, 0, 0, 0.03]), active: [], blocking: [] };
    let spared = 0;
    const picture = { frame, header: { robot: { foot_radius: 0.03 } }, labels: { put: () => {}, spare: () => ++spared }, newton: 0.002, colours: coloursOf(paletteOf(false)), beliefToWorld: new THREE.Matrix4() };
    const overlay = new FrictionPyramids();
      overlay.update(picture as unknown as Picture);
    assert.equal(spared, 1);
  }
});

test("a foot that carries next to nothing has no share and no pyramid, and none is higher than the robot's weight", () => {
  const schema = schemaOf({ "commanded.friction_use.LF": 1, "commanded.normal_force.LF": 1, "commanded.q_WP.LF": 4, "commanded.pyramid_friction.LF": 1, "model.p_WF.LF": 3 });
  const values = new Float32Array([77.33, 0.015 * schema.weight, 1, 0, 0, 0, 0.3, 0, 0, 0.03]);
  const frame: Frame = { schema, tick: 0, time: 0, values, active: [], blocking: [] };
  const put: string[] = [];
  const labels = { put: (_: THREE.Vector3, text: string) => put.push(text), spare: () => {} };
  const picture = { frame, header: { robot: { foot_radius: 0.03 } }, labels, newton: 0.002, colours: coloursOf(paletteOf(false)), beliefToWorld: new THREE.Matrix4() };
  const overlay = new FrictionPyramids();
  overlay.update(picture as unknown as Picture);
  assert.equal(new Map(sentences(frame)).get("Pyramid used"), "");
  assert.deepEqual(put, []);
  values.set([0.5, 40 * schema.weight]);
  overlay.update(picture as unknown as Picture);
  assert.deepEqual(put, ["LF 50 %"]);
  const [sides] = overlay.root.children[0]?.children as [THREE.Mesh];
  close(sides.geometry.getAttribute("position").getZ(1), new Float32Array([0.002 * schema.weight])[0] as number);
});
