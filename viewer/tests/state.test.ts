import assert from "node:assert/strict";
import { test } from "node:test";
import type { Frame } from "../src/data/frame.ts";
import { LEGS } from "../src/data/schema.ts";
import { FrameTable } from "../src/data/table.ts";
import { sentences } from "../src/panels/state_panel.ts";
import { schemaOf } from "./make.ts";

const PHASES = ["stance", "unloading", "swing", "search"];

/** `touching`: undefined where the truth is not known. */
function said(phase: string, touching: number | undefined, force = [3, 4, 12]): Map<string, string> {
  const truth = touching === undefined ? {} : Object.fromEntries(LEGS.flatMap((leg) => [[`truth.feet.${leg}.touching`, 1], [`truth.feet.${leg}.force`, 3]]));
  const schema = schemaOf({ ...Object.fromEntries(LEGS.map((leg) => [`plan.feet.${leg}.phase`, 1])), ...truth, "state.v_WB": 3, ...(touching === undefined ? {} : { "truth.v_WB": 3 }) });
  for (const leg of LEGS) Object.assign(schema.channel(`plan.feet.${leg}.phase`) as object, { values: PHASES });
  const values = [...LEGS.map(() => PHASES.indexOf(phase)), ...(touching === undefined ? [] : LEGS.flatMap(() => [touching, ...force])), 3, 4, 1, 6, 8, 1];
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from(values.slice(0, schema.frameFloats)), undefined);
  return new Map(sentences(table.frame(0) as Frame));
}

test("a foot in the air does not stand, whatever was planned", () => {
  assert.match(said("stance", 0).get("Feet") as string, /^LF should stand, is in the air; RF /);
  assert.match(said("unloading", 0).get("Feet") as string, /^LF should unload, is in the air; /);
  assert.match(said("swing", 0).get("Feet") as string, /^LF swings; /);
  assert.match(said("search", 0).get("Feet") as string, /^LF searches for ground; /);
});

test("of a foot that touches the size of the force is told, by that name", () => {
  assert.match(said("stance", 1).get("Feet") as string, /^LF stands, \|f\| 13\.0 N; /);
  assert.match(said("swing", 1).get("Feet") as string, /^LF swings, touches, \|f\| 13\.0 N; /);
  assert.match(said("stance", undefined).get("Feet") as string, /^LF stands; RF stands; /, "where nobody knows the truth, the plan");
});

test("of velocities it is told whose they are", () => {
  const both = said("stance", 1);
  assert.deepEqual([both.get("Velocity, believed"), both.get("Velocity, true"), both.get("Velocity")], ["5.00 m/s", "10.0 m/s", undefined]);
  assert.deepEqual([said("stance", undefined).get("Velocity, believed"), said("stance", undefined).has("Velocity, true")], ["5.00 m/s", false]);
});

/** Pushed by these forces, one a body, of which the first is the world, heading to the left of W. */
function pushed(...forces: [number, number, number][]): string | undefined {
  const schema = schemaOf({ "truth.q_WB": 4, "truth.xfrc_applied": 6 * forces.length }, { bodies: ["base", "LF_HIP"] });
  const table = new FrameTable(schema, 1);
  const values = [Math.SQRT1_2, 0, 0, Math.SQRT1_2, ...forces.flatMap((force) => [...force, 1, 2, 3])];
  table.append(0, 0, Float32Array.from(values), undefined);
  return new Map(sentences(table.frame(0) as Frame)).get("Pushed by");
}

test("what pushes the robot is told with its size, its direction from ahead, and where", () => {
  const truth = " (truth: the controller is not told)";
  assert.equal(pushed([0, 0, 0], [0, 0, 0]), "nothing", "a torque is no push");
  assert.equal(pushed([0, 0, 0], [-50, 0, 0]), `50.0 N, 90° from ahead to the left, on the base${truth}`);
  assert.equal(pushed([0, 0, 0], [0, 0, 0], [30, 0, -40]), `50.0 N, 90° from ahead to the right and downwards, on LF_HIP${truth}`);
  assert.equal(said("stance", 1).has("Pushed by"), false, "where nobody knows");
});
