import assert from "node:assert/strict";
import { test } from "node:test";
import { LEG_CHANNELS, LEGS } from "../src/data/schema.ts";
import { FrameTable } from "../src/data/table.ts";
import { standing } from "../src/overlays/ground_marks.ts";
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
