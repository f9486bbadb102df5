import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import type { Frame } from "../src/data/frame.ts";
import { LEGS } from "../src/data/schema.ts";
import { LYING_WINDOW, lyingText, touchOf } from "../src/data/lying.ts";
import type { ForceMark, FrameSource, Mark } from "../src/data/source.ts";
import { GroundForces, OutsideForce } from "../src/overlays/forces.ts";
import type { Picture } from "../src/overlays/overlay.ts";
import { commandText, faultsText, stopText } from "../src/data/stop.ts";
import { FORCE_SLACK, SHARE_SLACK } from "../src/data/wished_forces.ts";
import { FrameTable } from "../src/data/table.ts";
import { sentences } from "../src/panels/state_panel.ts";
import lyingHeader from "../../app/lying_text.hpp";
import lyingWords from "../../tests/support/lying_words.json";
import tickExplanation from "../../app/tick_explanation.cpp";
import stopWords from "../../tests/support/stop_words.json";
import { schemaOf } from "./make.ts";

const PHASES = ["stance", "unloading", "swing", "search"];

/** `touching`: undefined where the truth is not known. */
function said(phase: string, touching: number | undefined, force = [3, 4, 12], mode = "optimal"): Map<string, string> {
  const truth = touching === undefined ? {} : Object.fromEntries(LEGS.flatMap((leg) => [[`truth.feet.${leg}.touching`, 1], [`truth.feet.${leg}.force`, 3]]));
  const schema = schemaOf({ ...Object.fromEntries(LEGS.map((leg) => [`plan.feet.${leg}.phase`, 1])), ...truth, "state.v_WB": 3, ...(touching === undefined ? {} : { "truth.v_WB": 3 }), "command.mode": 1 });
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

test("what of the robot lies on the ground is said in the program's words", () => {
  const schema = schemaOf({ "truth.torso_contact": 1, "truth.shank_contacts": 1, "truth.body_contact_force": 1, ...Object.fromEntries(LEGS.map((leg) => [`truth.feet.${leg}.touching`, 1])) });
  const of = (values: number[]): string | undefined => new Map(sentences({ schema, tick: 0, time: 0, values: Float32Array.from(values), active: [], blocking: [] })).get("Lies on");
  for (const [torso, legs, most, feet, text] of lyingWords as [number, number, number, number, string][])
    assert.equal(of([torso, legs, most, ...LEGS.map((_, k) => (feet >> k) & 1)]) ?? "", text === "" ? "" : `${text} (last 0.05 s)`);
  assert.equal(of([NaN, NaN, NaN, NaN, NaN, NaN, NaN]), undefined, "where nobody knows");
  const frame = (...values: number[]): Frame => ({ schema, tick: 0, time: 1, values: Float32Array.from([...values, 0, 0, 0, 0]), active: [], blocking: [] });
  const source = { sample: (from: number, _to: number, _count: number, see: (one: Frame) => void) => from > 0.94 && see(frame(1, 0, 115)) } as unknown as FrameSource;
  assert.equal(lyingText(touchOf(frame(0, 0, 0), source)), "its torso, up to 115 N on a part", "that has just left the ground");
  assert.ok(/kLyingWindow = ([\d.]+);/.exec(lyingHeader)?.[1] === String(LYING_WINDOW));
});

test("of velocities it is told whose they are", () => {
  const both = said("stance", 1);
  assert.deepEqual([both.get("Velocity, believed"), both.get("Velocity, true"), both.get("Velocity")], ["5.00 m/s", "10.0 m/s", undefined]);
  assert.deepEqual([said("stance", undefined).get("Velocity, believed"), said("stance", undefined).has("Velocity, true")], ["5.00 m/s", false]);
});

test("a base that stands where it began is not told as to the left or right of that by nothing", () => {
  const schema = schemaOf({ "truth.p_WB": 3, "truth.q_WB": 4 });
  const frame: Frame = { schema, tick: 0, time: 0, values: Float32Array.of(-1e-5, -0, 0.42, 1, 0, 0, -1e-9), active: [], blocking: [] };
  assert.equal(new Map(sentences(frame)).get("Base, true"), "x 0.000 m, y 0.000 m, z 0.420 m, heading 0.00°");
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

const BODIES = ["base", "LF_HIP"];

/** The arrows of forces on the base and on a leg, each with a torque: their texts and where they begin; marks of the run, and the body that the pointer holds. */
function arrowsOf(base: number[], leg: number[], marks: Mark[] = [], held?: string): { texts: string[]; starts: number[][] } {
  const schema = schemaOf({ "truth.p_WCom": 3, "truth.xfrc_applied": 18 }, { bodies: BODIES, period: 0.0025 });
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from([0, 0, 0.5, 0, 0, 0, 0, 0, 0, ...base, ...leg]), undefined);
  const texts: string[] = [];
  const labels = { put: (_: unknown, text: string) => texts.push(text) };
  const centreOf = (body: string, out: THREE.Vector3): boolean => (out.set(BODIES.indexOf(body), 0, 0.4), BODIES.includes(body));
  const overlay = new OutsideForce();
  overlay.update({ frame: table.frame(0), source: { schema, marks }, labels, newton: 0.005, held, centreOf } as unknown as Picture);
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

test("a push that falls between two pictures is drawn in the next one, and for a second", () => {
  const schema = schemaOf({ "truth.p_WCom": 3, "truth.xfrc_applied": 12 }, { bodies: BODIES, period: 0.0025 });
  const frame = (time: number, force: number): Frame => ({ schema, tick: 0, time, values: Float32Array.from([0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0, force, 0, 0, 0, 0]), active: [], blocking: [] });
  const force: ForceMark = { kind: "push", body: "base", begins: true, duration: 0.2 };
  const source = { schema, marks: [{ time: 1, text: "", leg: "", kind: "change", force }], at: (time: number) => frame(time, time >= 1 && time < 1.2 ? 75 : 0) } as unknown as FrameSource;
  const centreOf = (_: string, out: THREE.Vector3): boolean => (out.set(0, 0, 0.4), true);
  const overlay = new OutsideForce();
  const told = (time: number): string[] => {
    const texts: string[] = [];
    overlay.update({ frame: source.at(time), source, labels: { put: (_: unknown, text: string) => texts.push(text) }, newton: 0.005, centreOf } as unknown as Picture);
    return texts;
  };
  assert.deepEqual([0.9, 1.1, 1.25, 2.19, 2.3].map(told), [[], ["push 75 N"], ["pushed 75 N for 0.2 s"], ["pushed 75 N for 0.2 s"], []]);
  assert.deepEqual([0.9, 3, 3].map(told), [[], ["pushed 75 N for 0.2 s"], []], "however slowly pictures are drawn");
  assert.deepEqual([0.9, 9].map(told), [[], []], "of another time that is looked at nothing old is told");
});

test("an arrow that would leave the picture is cut short, with two heads, and keeps its number", () => {
  const names = ["touching", "force", "point"].flatMap((field) => LEGS.map((leg) => [`truth.feet.${leg}.${field}`, field === "touching" ? 1 : 3] as const));
  const schema = schemaOf(Object.fromEntries(names));
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from([1, 1, 0, 0, 0, 0, 300, 0, 0, 2792, ...Array<number>(18).fill(0)]), undefined);
  const texts: string[] = [], feet: number[] = [];
  const labels = { put: (at: THREE.Vector3, text: string) => (texts.push(text), feet.push(at.z)) };
  const overlay = new GroundForces();
  overlay.update({ frame: table.frame(0), labels, newton: 0.0025, longest: 1.5 } as unknown as Picture);
  assert.deepEqual([texts, feet], [["LF 300 N", "RF 2792 N"], [0, 0]], "under the foot");
  const [shafts, heads] = overlay.root.children.at(-1)?.children as THREE.InstancedMesh[];
  assert.deepEqual([shafts?.count, heads?.count], [2, 3]);
});

test("what the pointer pulls has the spring for its arrow; what else pushes the same body is drawn, and called so", () => {
  const change = (force: ForceMark): Mark => ({ time: 0, text: "", leg: "", kind: "change", force });
  const pull = change({ kind: "pull", body: "base", begins: true }), none = [0, 0, 0, 0, 0, 0];
  assert.deepEqual(arrowsOf([30, 0, 0, 0, 0, 0], none, [pull], "base"), { texts: [], starts: [] });
  assert.deepEqual(arrowsOf([30, 0, 0, 0, 0, 0], none, [pull]).texts, ["pull 30 N"], "where another page pulls");
  assert.deepEqual(arrowsOf([30, 0, 0, 0, 0, 0], [5, 0, 0, 0, 0, 0], [pull], "base").texts, ["push 5.00 N"]);
  const push = change({ kind: "push", body: "base", begins: true, duration: 0.2 });
  assert.deepEqual(arrowsOf([130, 0, 0, 0, 0, 0], none, [pull, push], "base").texts, ["pull and push 130 N"]);
});

test("what is told to push is drawn, however weak, and nothing else is", () => {
  for (const [force, text] of [[157, "157 N"], [50, "50 N"], [0.5, "0.500 N"], [1e-3, "0.001 N"]] as const) {
    assert.equal(drawn(force, 0), `push ${text}`);
    assert.match(pushed([0, 0, 0], [force, 0, 0]) as string, / N, 90° from ahead to the right, on the base /);
  }
  assert.deepEqual([drawn(0, 0), pushed([0, 0, 0], [0, 0, 0])], [undefined, "nothing"]);
  assert.deepEqual([drawn(1e-7, 0), pushed([0, 0, 0], [1e-7, 0, 0])], [undefined, "nothing"], "a rounding");
  assert.equal(drawn(30, -20), "push 30 N and push 20 N", "each where it acts");
});

test("forces of the solution that no ground gives stand beside its command, where that is the robot's", () => {
  const feet = LEGS.flatMap((leg) => [`commanded.normal_force.${leg}`, `plan.feet.${leg}.force_max`, `commanded.friction_use.${leg}`]);
  const schema = schemaOf({ "command.mode": 1, ...Object.fromEntries(feet.map((name) => [name, 1])) });
  Object.assign(schema.channel("command.mode") as object, { values: ["optimal", "hold"] });
  const of = (mode: number, ...more: number[][]): string | undefined => {
    const values = LEGS.flatMap((_, k) => more[k] ?? [80, 400, 0.5]);
    return new Map(sentences({ schema, tick: 0, time: 0, values: Float32Array.from([mode, ...values]), active: [], blocking: [] })).get("Command");
  };
  assert.equal(of(0), "optimal");
  assert.equal(of(0, [-0.5, 400, NaN], [400.5, 400, 1.005], [NaN, 400, NaN]), "optimal", "roundings, and what is not known");
  assert.equal(of(0, [-39.7, 400, NaN], [500, 400, 0.2], [80, 400, 1.3]), "optimal, but for contact forces that no ground gives: LF −39.7 N, RF 500 N, LH 130 % of its pyramid");
  assert.equal(of(1, [-39.7, 400, NaN]), "hold", "the solution's forces are no part of another command");
});

test("a force is beyond its limits from where explain says so", () => {
  const [, loaded] = /kLoaded = ([\d.]+);/.exec(tickExplanation) ?? [], [, slack] = /kSlack = ([\d.]+);/.exec(tickExplanation) ?? [];
  assert.deepEqual([Number(loaded), Number(slack)], [FORCE_SLACK, SHARE_SLACK]);
});

test("where the solve was cut off that is told, and what the levels above gave way to as well", () => {
  const level = (name: string): [string, number][] => ["residual", "num_rows"].map((field) => [`hierarchy.level.${name}.${field}`, 1]);
  const header = { robot: { mass: 30 }, level_names: ["first", "second", "third"], level_units: ["N", "N", "N"], level_visible: [0.5, 0.5, 0.5], event_names: [] };
  const schema = schemaOf({ ...Object.fromEntries(["first", "second", "third"].flatMap(level)), "hierarchy.status": 1, "hierarchy.failed_level": 1 }, { header, rows: [["a"], ["b"], ["c"]] } as never);
  const of = (residual: number): string | undefined => {
    const frame = { schema, tick: 0, time: 0, values: Float32Array.from([0, 2, residual, 2, 7, 2, 1, 2]), active: [], blocking: [{ level: 1, by: 0, row: 0, cost: 1 }, { level: 2, by: 0, row: 0, cost: 1 }] };
    return new Map(sentences(frame)).get("Hierarchy");
  };
  const cut = "The solver was cut off in third: of it and the levels below it nothing is known.";
  assert.equal(of(3), `${cut} Which rows hold back what is the control loop's estimate. second gives way to first (a), 3.00 N short.`);
  assert.equal(of(0), cut);
});

test("why the controller has stopped is said in the program's words", () => {
  const groups = ["encoders", "joint_torques", "imu"];
  const faults = [...new Set(stopWords.map(([, fault]) => fault as string))], causes = [...new Set(stopWords.map(([cause]) => cause as string))];
  const schema = schemaOf({ "command.cause": 1, "state.q": 3, ...Object.fromEntries(groups.flatMap((group) => [[`health.${group}.fault`, 1], [`health.${group}.joint`, 1]])) });
  Object.assign(schema.channel("command.cause") as object, { values: causes });
  Object.assign(schema.channel("state.q") as object, { labels: ["LF_HAA", "LF_HFE", "LF_KFE"] });
  for (const group of groups) Object.assign(schema.channel(`health.${group}.fault`) as object, { values: faults });
  for (const [cause = "", fault = "", text, textOfJoint] of stopWords)
    for (const [joint, told] of [[-1, text], [2, textOfJoint], [12, text]] as const) {
      const table = new FrameTable(schema, 1);
      const health = groups.flatMap(() => [faults.indexOf(fault), joint]);
      table.append(0, 0, Float32Array.from([causes.indexOf(cause), 0, 0, 0, ...health]), undefined);
      assert.equal(stopText(table.frame(0)), told);
    }
});

test("a command that is not the solution's says why, and whose joint it is", () => {
  const schema = schemaOf({ "command.mode": 1, "command.cause": 1, "health.encoders.fault": 1, "health.encoders.joint": 1, "state.q": 2 });
  const words = { "command.mode": ["optimal", "damping"], "command.cause": ["none", "tilt", "encoders"], "health.encoders.fault": ["none", "out_of_range"] };
  for (const [name, values] of Object.entries(words)) Object.assign(schema.channel(name) as object, { values });
  Object.assign(schema.channel("state.q") as object, { labels: ["LF_HAA", "LF_HFE"] });
  const of = (...values: number[]): string => commandText({ schema, tick: 0, time: 0, values: Float32Array.from([...values, 0, 0]), active: [], blocking: [] });
  assert.equal(of(0, 0, 0, -1), "optimal");
  assert.equal(of(1, 1, 0, -1), "damping, as the torso tilted too far");
  assert.equal(of(1, 2, 1, 1), "damping, as encoder LF_HFE left the range");
  assert.equal(of(1, 2, 1, -1), "damping, as encoders of several joints left the range");
});

test("what the controller was stopped by stays the reason, and what is wrong now is told apart", () => {
  const schema = schemaOf({ "command.mode": 1, "command.cause": 1, "command.fault": 1, "command.joint": 1, "health.encoders.fault": 1, "health.encoders.joint": 1, "state.q": 2 });
  const faults = ["none", "out_of_range", "jump", "silent"];
  const words = { "command.mode": ["optimal", "damping"], "command.cause": ["none", "encoders"], "command.fault": faults, "health.encoders.fault": faults };
  for (const [name, values] of Object.entries(words)) Object.assign(schema.channel(name) as object, { values });
  Object.assign(schema.channel("state.q") as object, { labels: ["LF_HAA", "LF_HFE"] });
  const of = (...values: number[]): [string, string] => {
    const frame = { schema, tick: 0, time: 0, values: Float32Array.from([...values, 0, 0]), active: [], blocking: [] };
    return [commandText(frame), faultsText(frame)];
  };
  assert.deepEqual(of(1, 1, 2, -1, 1, 1), ["damping, as encoders of several joints changed too fast", "encoder LF_HFE left the range"]);
  assert.deepEqual(of(1, 1, 2, 0, 0, -1), ["damping, as encoder LF_HAA changed too fast", ""]);
  assert.deepEqual(of(1, 1, 3, -1, 3, -1), ["damping, as encoders stopped", "encoders stopped"]);
});
