import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { LEG_CHANNELS, LEGS } from "../src/data/schema.ts";
import { FrameTable } from "../src/data/table.ts";
import { standing, ZeroMomentPoint } from "../src/overlays/ground_marks.ts";
import { SwingCurves } from "../src/overlays/feet.ts";
import type { Picture } from "../src/overlays/overlay.ts";
import { schemaOf } from "./make.ts";

test("a foot carries that is to carry and, where the truth is known, touches the ground", () => {
  const names = LEGS.flatMap((_, k) => [LEG_CHANNELS.phase[k], LEG_CHANNELS.touching[k]] as string[]);
  const schema = schemaOf({ ...Object.fromEntries(names.map((name) => [name, 1])), ...Object.fromEntries(LEG_CHANNELS.foot.map((name) => [name, 3])) });
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

test("where nothing was solved nothing is drawn as planned", () => {
  const schema = schemaOf({ "hierarchy.status": 1, "plan.com.zmp": 2, "plan.R_WC": 9, "plan.terrain_point": 3, ...Object.fromEntries(LEGS.flatMap((_, k) => [[LEG_CHANNELS.phase[k], 1], [LEG_CHANNELS.plannedFoot[k], 3]])) });
  const drawn = [0, 1, 2].map((status) => {
    const values = [status, 0.1, 0.2, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, ...LEGS.flatMap(() => [2, 1, 1, 0])];
    const picture = { frame: { schema, tick: 0, time: 0, values: Float32Array.from(values), active: [], blocking: [] }, header: { robot: { foot_radius: 0.03 } }, trails: false } as unknown as Picture;
    const [zmp, swings] = [new ZeroMomentPoint(), new SwingCurves()];
    for (const overlay of [zmp, swings]) overlay.update(picture);
    const targets = swings.root.children.filter((one) => one instanceof THREE.InstancedMesh).reduce((sum, { count }) => sum + count, 0);
    return [zmp.root.children[0]?.visible, targets];
  });
  assert.deepEqual(drawn, [[true, 4], [true, 4], [false, 0]]);
});
