import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { channelsOf, LEGS } from "../src/data/schema.ts";
import { FrameTable } from "../src/data/table.ts";
import type { Frame } from "../src/data/frame.ts";
import { CentreOfMass } from "../src/overlays/com.ts";
import { Footholds, SwingCurves } from "../src/overlays/feet.ts";
import { WantedForces } from "../src/overlays/forces.ts";
import { standing, SupportPolygon, TerrainPlane, ZeroMomentPoint } from "../src/overlays/ground_marks.ts";
import type { Overlay, Picture } from "../src/overlays/overlay.ts";
import { coloursOf, paletteOf } from "../src/scene/palette.ts";
import { schemaOf } from "./make.ts";

const LEG_CHANNELS = LEGS.map(channelsOf);

test("a foot carries that is to carry and, where the truth is known, touches the ground", () => {
  const names = LEG_CHANNELS.flatMap(({ phase, touching }) => [phase, touching]);
  const schema = schemaOf({ ...Object.fromEntries(names.map((name) => [name, 1])), ...Object.fromEntries(LEG_CHANNELS.map(({ foot }) => [foot, 3])) });
  const feetAt = (touching: number[]): number[] => {
    const table = new FrameTable(schema, 1);
    const phases = [0, 1, 0, 2];
    table.append(0, 0, Float32Array.from([...phases.flatMap((phase, k) => [phase, touching[k] as number]), ...LEGS.flatMap((_, k) => [k, 0, 0])]), undefined);
    return standing({ frame: table.frame(0), header: { robot: { foot_radius: 0.03 } } } as Picture).map(([x]) => x);
  };
  assert.deepEqual(feetAt([1, 1, 1, 1]), [0, 1, 2]);
  assert.deepEqual(feetAt([1, 1, 0, 0]), [0, 1]);
  assert.deepEqual(feetAt([NaN, NaN, NaN, NaN]), [0, 1, 2], "as planned");
});

/** A tick with a plan and what is believed; `unused`: nothing of the plan is commanded. */
function plannedFrame(unused: boolean, time = 0): Frame {
  const schema = schemaOf({
    "told.unused": 1, "plan.com.zmp": 2, "plan.com.p": 2, "plan.R_WC": 9, "plan.terrain_point": 3, "model.p_WCom": 3,
    ...Object.fromEntries(LEG_CHANNELS.flatMap(({ phase, plannedFoot, foot, force }) => [[phase, 1], [plannedFoot, 3], [foot, 3], [force, 3]])),
  });
  Object.assign(schema.channel("told.unused") as object, { values: ["", "No hierarchy was solved"] });
  const ground = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
  const legs = LEGS.flatMap((_, k) => [k < 2 ? 2 : 0, k + time, 1, 0.03, k, 1, 0.03, 0, 0, 100]);
  return { schema, tick: 0, time, values: Float32Array.from([Number(unused), 0.1, 0.2, 0.1 + time, 0.2, ...ground, 0.1, 0.2, 0.4, ...legs]), active: [], blocking: [] };
}

function pictureOf(frame: Frame, samples: Frame[]): Picture {
  const source = { sample: (_from: number, _to: number, _most: number, take: (one: Frame) => void) => samples.forEach((one) => take(one)) };
  const labels = { put: () => {}, spare: () => {} };
  return { frame, source, labels, colours: coloursOf(paletteOf(false)), header: { robot: { foot_radius: 0.03 } }, trails: true, newton: 0.001, longest: 1, beliefToWorld: new THREE.Matrix4() } as unknown as Picture;
}

/** How many lines, points and surfaces of an overlay are seen. */
function seen(root: THREE.Object3D): number {
  if (!root.visible) return 0;
  const { geometry, count } = root as THREE.InstancedMesh;
  const range = geometry === undefined ? 0 : Math.min(1, geometry.drawRange.count) * (root instanceof THREE.InstancedMesh ? count : 1);
  return root.children.reduce((sum, child) => sum + seen(child), range);
}

const PLANNED: [string, () => Overlay][] = [
  ["zero-moment point", () => new ZeroMomentPoint()], ["swing curves", () => new SwingCurves()], ["footholds", () => new Footholds()],
  ["support polygon", () => new SupportPolygon()], ["terrain plane", () => new TerrainPlane()], ["forces of the solution", () => new WantedForces()],
];

/** All of an overlay at a tick, after those before it; the feet's real ways aside, which are no plan. */
function seenOf(make: () => Overlay, frame: Frame, samples: Frame[]): number {
  const overlay = make();
  overlay.update(pictureOf(frame, samples));
  const real = overlay instanceof SwingCurves ? (overlay.root.children.at(-1) as THREE.Object3D) : undefined;
  return seen(overlay.root) - (real === undefined ? 0 : seen(real));
}

for (const [name, make] of PLANNED) {
  test(`of a plan that commands no more nothing is drawn: ${name}`, () => {
    const before = [0, 0.5, 1].map((time) => plannedFrame(false, time));
    const at = (unused: boolean): number => seenOf(make, plannedFrame(unused, 1.5), before);
    assert.ok(at(false) > 0, "while it does");
    assert.equal(at(true), 0);
  });
}

test("of the centre of mass the plan goes with a stop, and the mass stays while it is known", () => {
  const planOf = (frame: Frame): [boolean, boolean] => {
    const overlay = new CentreOfMass();
    overlay.update(pictureOf(frame, [0, 0.5, 1].map((time) => plannedFrame(false, time))));
    const plan = overlay.root.children.find((one) => one instanceof THREE.Group) as THREE.Group;
    return [overlay.root.visible, seen(plan) > 0];
  };
  assert.deepEqual(planOf(plannedFrame(false, 1.5)), [true, true]);
  assert.deepEqual(planOf(plannedFrame(true, 1.5)), [true, false]);
});

test("before a stop nothing is drawn of what a dead plan says behind it", () => {
  const frame = plannedFrame(false, 1);
  const alive = [plannedFrame(false, 0), plannedFrame(false, 1)], dead = [plannedFrame(true, 5), plannedFrame(true, 6)];
  for (const make of [() => new SwingCurves(), () => new Footholds(), () => new CentreOfMass()]) {
    const rangesOf = (samples: Frame[]): number[] => {
      const overlay = make();
      overlay.update(pictureOf(frame, samples));
      const found: number[] = [];
      overlay.root.traverse((one) => {
        if (one instanceof THREE.LineSegments) found.push(one.geometry.drawRange.count);
        if (one instanceof THREE.InstancedMesh) found.push(one.count);
      });
      return found;
    };
    assert.deepEqual(rangesOf([...alive, ...dead]), rangesOf(alive));
    assert.notDeepEqual(rangesOf(alive), rangesOf([]));
  }
});
