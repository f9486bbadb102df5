import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import type { Frame } from "../src/data/frame.ts";
import { LEGS } from "../src/data/schema.ts";
import { GroundForces, OutsideForce } from "../src/overlays/forces.ts";
import type { Picture } from "../src/overlays/overlay.ts";
import { commandText, faultsText } from "../src/data/stop.ts";
import { FrameTable } from "../src/data/table.ts";
import { sentences } from "../src/panels/state_panel.ts";
import { coloursOf, paletteOf } from "../src/scene/palette.ts";
import { schemaOf, STATES } from "./make.ts";

const PHASES = ["stance", "unloading", "swing", "search"];

/** `touching`: undefined where the truth is not known. */
function said(phase: string, touching: number | undefined, force = [3, 4, 12], mode = "optimal"): Map<string, string> {
  const truth = touching === undefined ? {} : Object.fromEntries(LEGS.flatMap((leg) => [[`truth.feet.${leg}.touching`, 1], [`truth.feet.${leg}.force`, 3]]));
  const schema = schemaOf({ ...Object.fromEntries(LEGS.map((leg) => [`plan.feet.${leg}.phase`, 1])), ...truth, "state.v_WB": 3, ...(touching === undefined ? {} : { "truth.v_SB": 3 }), "command.mode": 1 });
  Object.assign(schema.channel("command.mode") as object, { values: [mode] });
  for (const leg of LEGS) Object.assign(schema.channel(`plan.feet.${leg}.phase`) as object, { values: PHASES });
  const values = [...LEGS.map(() => PHASES.indexOf(phase)), ...(touching === undefined ? [] : LEGS.flatMap(() => [touching, ...force])), 3, 4, 1, ...(touching === undefined ? [] : [6, 8, 1]), 0];
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

test("where the command is not the solution's nothing is told of what feet should do", () => {
  for (const mode of ["hold", "sit", "damping", "lifted", "rise"]) for (const phase of PHASES) {
    assert.equal(said(phase, 0, [0, 0, 0], mode).get("Feet"), `nothing is asked of them (${mode}); all are in the air`);
    assert.ok((said(phase, 1, [3, 4, 12], mode).get("Feet") as string).startsWith(`nothing is asked of them (${mode}); LF touches, |f| 13.0 N; RF `));
    assert.equal(said(phase, undefined, [0, 0, 0], mode).get("Feet"), `nothing is asked of them (${mode})`);
  }
  assert.match(said("stance", 0, [0, 0, 0], "degraded").get("Feet") as string, /^LF should stand/);
});

test("of velocities it is told whose they are", () => {
  const both = said("stance", 1);
  assert.deepEqual([both.get("Velocity, believed"), both.get("Velocity, true"), both.get("Velocity")], ["5.00 m/s", "10.0 m/s", undefined]);
  assert.deepEqual([said("stance", undefined).get("Velocity, believed"), said("stance", undefined).get("Velocity, true")], ["5.00 m/s", ""]);
});

test("a base that stands where it began is not told as to the left or right of that by nothing", () => {
  const schema = schemaOf({ "truth.p_SB": 3, "truth.q_SB": 4 });
  const frame: Frame = { schema, tick: 0, time: 0, values: Float32Array.of(-1e-5, -0, 0.42, 1, 0, 0, -1e-9), active: [], blocking: [] };
  assert.equal(new Map(sentences(frame)).get("Base, true"), "x 0.000 m, y 0.000 m, z 0.420 m, heading 0.00°");
});

test("how far the true centre of mass is off its plan is told in the controller's world, where it is known", () => {
  const schema = schemaOf({ "alignment.com_error": 2 });
  const of = (...values: number[]): string | undefined =>
    new Map(sentences({ schema, tick: 0, time: 0, values: Float32Array.from(values), active: [], blocking: [] })).get("Centre of mass off plan");
  assert.equal(of(0.003, -0.004), "5.00 mm, (3.0, −4.0) mm in W, the controller's world");
  assert.equal(of(NaN, NaN), "");
});

/** Pushed by these forces, one a body, of which the first is the world, heading to the left of S. */
function pushed(...forces: [number, number, number][]): string | undefined {
  const schema = schemaOf({ "truth.q_SB": 4, "truth.xfrc_applied": 6 * forces.length }, { bodies: ["base", "LF_HIP"] });
  const table = new FrameTable(schema, 1);
  const values = [Math.SQRT1_2, 0, 0, Math.SQRT1_2, ...forces.flatMap((force) => [...force, 1, 2, 3])];
  table.append(0, 0, Float32Array.from(values), undefined);
  return new Map(sentences(table.frame(0) as Frame)).get("Pushed by");
}

test("what pushes the robot is told with its size, where, and how it goes in the world", () => {
  const truth = " (truth: the controller is not told)";
  assert.equal(pushed([0, 0, 0], [0, 0, 0]), "nothing", "a torque is no push");
  assert.equal(pushed([0, 0, 0], [-50, 0, 0]), `50.0 N on base, (−50.0, 0.0, 0.0) N in S, the simulator's world${truth}`);
  assert.equal(pushed([0, 0, 0], [0, 0, 0], [30, 0, -40]), `50.0 N on LF_HIP, (30.0, 0.0, −40.0) N in S, the simulator's world${truth}`);
  assert.equal(said("stance", 1).get("Pushed by"), "", "where it is not known");
});

const BODIES = ["base", "LF_HIP"];

/** The arrows of forces on the base and on a leg, each with a torque: their texts and where they begin. */
function arrowsOf(base: number[], leg: number[]): { texts: string[]; starts: number[][] } {
  const schema = schemaOf({ "truth.p_SCom": 3, "truth.xfrc_applied": 18 }, { bodies: BODIES, period: 0.0025 });
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from([0, 0, 0.5, 0, 0, 0, 0, 0, 0, ...base, ...leg]), undefined);
  const texts: string[] = [];
  const labels = { put: (_: unknown, text: string) => texts.push(text) };
  const centreOf = (body: string, out: THREE.Vector3): boolean => (out.set(BODIES.indexOf(body), 0, 0.4), BODIES.includes(body));
  const overlay = new OutsideForce();
  overlay.update({ frame: table.frame(0), labels, colours: coloursOf(paletteOf(false)), newton: 0.005, centreOf } as unknown as Picture);
  const [shafts] = overlay.root.children.at(-1)?.children as [THREE.InstancedMesh];
  const place = new THREE.Matrix4();
  const starts = Array.from({ length: shafts.count }, (_, k) => (shafts.getMatrixAt(k, place), new THREE.Vector3().setFromMatrixPosition(place).toArray()));
  return { texts, starts };
}

/** What stands at the arrows of a force on the base along x and another on a leg; undefined where none is drawn. */
function drawn(base: number, leg: number): string | undefined {
  const { texts } = arrowsOf([base, 0, 0, 1, 2, 3], [leg, 0, 0, 1, 2, 3]);
  return texts.length === 0 ? undefined : texts.join(" and ");
}

test("an arrow begins at the body that is pushed, in the line in which the force acts", () => {
  const { starts } = arrowsOf([0, 10, 0, 0, 0, 2], [0, 0, 5, 0, 0, 0]); // 0.2 m before the base's centre of mass, and at that of the leg
  assert.deepEqual(starts.map((start) => start.map((one) => Number(one.toFixed(6)))), [[0.2, 0, 0.4], [1, 0, 0.4]]);
});

test("an arrow that would leave the picture is cut short, with two heads, and keeps its number", () => {
  const names = ["touching", "force", "point"].flatMap((field) => LEGS.map((leg) => [`truth.feet.${leg}.${field}`, field === "touching" ? 1 : 3] as const));
  const schema = schemaOf(Object.fromEntries(names));
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from([1, 1, 0, 0, 0, 0, 300, 0, 0, 2792, ...Array<number>(18).fill(0)]), undefined);
  const texts: string[] = [], feet: number[] = [];
  const labels = { put: (at: THREE.Vector3, text: string) => (texts.push(text), feet.push(at.z)) };
  const overlay = new GroundForces();
  overlay.update({ frame: table.frame(0), labels, colours: coloursOf(paletteOf(false)), newton: 0.0025, longest: 1.5 } as unknown as Picture);
  assert.deepEqual([texts, feet], [["LF 300 N", "RF 2792 N"], [0, 0]], "under the foot");
  const [shafts, heads] = overlay.root.children.at(-1)?.children as THREE.InstancedMesh[];
  assert.deepEqual([shafts?.count, heads?.count], [2, 3]);
});

test("what is told to push is drawn, however weak, and nothing else is", () => {
  for (const [force, text] of [[157, "157 N"], [50, "50 N"], [0.5, "0.500 N"], [1e-3, "0.001 N"]] as const) {
    assert.equal(drawn(force, 0), `push ${text}`);
    assert.match(pushed([0, 0, 0], [force, 0, 0]) as string, / N on base, /);
  }
  assert.deepEqual([drawn(0, 0), pushed([0, 0, 0], [0, 0, 0])], [undefined, "nothing"]);
  assert.deepEqual([drawn(1e-7, 0), pushed([0, 0, 0], [1e-7, 0, 0])], [undefined, "nothing"], "a rounding");
  assert.equal(drawn(30, -20), "push 30 N and push 20 N", "each where it acts");
});

test("forces of the solution that no ground gives stand beside its command, where that is the robot's", () => {
  const feet = LEGS.flatMap((leg) => [`commanded.normal_force.${leg}`, `commanded.friction_use.${leg}`, `told.beyond.${leg}`]);
  const schema = schemaOf({ "command.mode": 1, ...Object.fromEntries(feet.map((name) => [name, 1])) });
  Object.assign(schema.channel("command.mode") as object, { values: ["optimal", "hold"] });
  for (const leg of LEGS) Object.assign(schema.channel(`told.beyond.${leg}`) as object, { values: ["", "force", "friction"] });
  const of = (mode: number, ...more: number[][]): string | undefined => {
    const values = LEGS.flatMap((_, k) => more[k] ?? [80, 0.5, 0]);
    return new Map(sentences({ schema, tick: 0, time: 0, values: Float32Array.from([mode, ...values]), active: [], blocking: [] })).get("Command");
  };
  assert.equal(of(0), "optimal");
  assert.equal(of(0, [-39.7, NaN, 1], [500, 0.2, 1], [80, 1.3, 2]), "optimal, but for contact forces that no ground gives: LF −39.7 N, RF 500 N, LH 130 % of its pyramid");
  assert.equal(of(1, [-39.7, NaN, 1]), "hold", "the solution's forces are no part of another command");
});

test("where the solve was cut off that is told, and what the levels above gave way to as well", () => {
  const level = (name: string): [string, number][] => [`hierarchy.level.${name}.residual`, `told.level.${name}.state`].map((field) => [field, 1]);
  const header = { robot: { mass: 30 }, level_names: ["first", "second", "third"], level_units: ["N", "N", "N"], event_names: [] };
  const schema = schemaOf({ ...Object.fromEntries(["first", "second", "third"].flatMap(level)) }, { header, rows: [["a"], ["b"], ["c"]] } as never);
  const of = (residual: number): string | undefined => {
    const frame = { schema, tick: 0, time: 0, values: Float32Array.from([0, STATES.indexOf("met"), residual, STATES.indexOf(residual > 0 ? "gives way" : "met"), 7, 0]), active: [], blocking: [{ level: 1, by: 0, row: 0, cost: 1 }, { level: 2, by: 0, row: 0, cost: 1 }] };
    return new Map(sentences(frame)).get("Hierarchy");
  };
  const cut = "The solver was cut off in third: of it and the levels below it nothing is known.";
  assert.equal(of(3), `${cut} second gives way to first (estimate).`);
  assert.equal(of(0), cut);
});

test("why the controller stopped and what is wrong with its sensors is said in the program's words", () => {
  const texts = ["", "IMU stopped", "encoder LF_HFE left the range"];
  const schema = schemaOf({ "command.mode": 1, "told.stop": 1, "told.encoders": 1, "told.joint_torques": 1, "told.imu": 1 });
  Object.assign(schema.channel("command.mode") as object, { values: ["optimal", "damping"] });
  for (const channel of schema.channels.slice(1)) Object.assign(channel, { values: texts });
  const of = (...values: number[]): [string, string] => {
    const frame = { schema, tick: 0, time: 0, values: Float32Array.from(values), active: [], blocking: [] };
    return [commandText(frame), faultsText(frame)];
  };
  assert.deepEqual(of(0, 0, 0, 0, 0), ["optimal", ""]);
  assert.deepEqual(of(1, 1, 2, 0, 1), ["damping, as IMU stopped", "encoder LF_HFE left the range, IMU stopped"]);
});
