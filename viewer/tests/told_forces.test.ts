import assert from "node:assert/strict";
import { test } from "node:test";
import { LiveSource } from "../src/data/live_source.ts";
import { marksOf, type RawEvent } from "../src/data/marks.ts";
import type { ForceMark, Mark } from "../src/data/source.ts";
import { forceText, spentForces, spentText, toldForces } from "../src/data/told_forces.ts";
import { schemaOf } from "./make.ts";

const PERIOD = 0.0025;
const told = (time: number, force: ForceMark): RawEvent => ({ time, kind: force.kind === "scenario" ? "force" : "change", text: `${force.kind} ${force.body} ${force.begins}`, force });
const push = (time: number, body: string): RawEvent => told(time, { kind: "push", body, begins: true, duration: 0.2 });
const pull = (time: number, body: string): RawEvent => told(time, { kind: "pull", body, begins: true });
const end = (time: number, given: number): RawEvent => told(time, { kind: "pull", body: "base", begins: false, given });
const scenario = (time: number, body: string, begins = true): RawEvent => told(time, { kind: "scenario", body, begins });
const marks = (...raw: RawEvent[]): Mark[] => marksOf(raw, ["none", "lift-off"]);

const steered = marks(push(1, "base"), pull(2, "base"), [2.5, 1, "LF"], end(3, 40), push(4, "LF_SHANK"));
const pullAt = (all: Mark[], time: number): [string | undefined, number | undefined] => {
  const { pulled, given } = toldForces(all, time, PERIOD);
  return [pulled, given];
};
const pushedAt = (all: Mark[], time: number): string[] => [...toldForces(all, time, PERIOD).pushed];

test("a pull is one from its begin to the last frame that has its force, and says what it gives as a whole", () => {
  for (const tick of [2, 2.5, 3 - PERIOD, 3]) assert.deepEqual(pullAt(steered, tick), ["base", 40], `${tick} s`);
  for (const tick of [0, 1.1, 3 + PERIOD, 4.1]) assert.deepEqual(pullAt(steered, tick), [undefined, undefined], `${tick} s`);
});

test("a pull that has no end yet goes on, and one at another body follows at once, also as a live page hears of them", () => {
  assert.deepEqual(pullAt(steered.slice(0, 3), 60), ["base", undefined]);
  const live = new LiveSource(schemaOf({ x: 1 }));
  for (const mark of marks(pull(5, "base"), end(6, 1), pull(6, "LF_SHANK"))) live.mark(mark);
  assert.deepEqual(pullAt(live.marks, 5.5), ["base", 1]);
  for (const tick of [6, 6.5]) assert.deepEqual(pullAt(live.marks, tick), ["LF_SHANK", undefined], `${tick} s`);
});

test("pushes act for their duration, those of the scenario from their begin to their end, each on its body", () => {
  for (const [tick, pushed] of [[0.9, []], [1, ["base"]], [1.2, ["base"]], [1.21, []], [4.1, ["LF_SHANK"]]] as const) assert.deepEqual(pushedAt(steered, tick), pushed, `${tick} s`);
  const scenarios = marks(scenario(7, "base"), scenario(7.5, "LF_SHANK"), push(7.9, "base"), scenario(8, "base", false), scenario(9, "LF_SHANK", false));
  for (const [tick, pushed] of [[6, []], [7, ["base"]], [7.7, ["base", "LF_SHANK"]], [8.05, ["base", "LF_SHANK"]], [8.2, ["LF_SHANK"]], [9, ["LF_SHANK"]], [9.1, []]] as const) assert.deepEqual(pushedAt(scenarios, tick), pushed, `${tick} s`);
});

test("beside an arrow stands whose force it is: of a pull alone with what it gives as a whole", () => {
  const forces = toldForces(steered, 2.5, PERIOD);
  assert.equal(forceText("base", "40 N", forces), "pull 40 N (of 40.0 N·s in all)");
  assert.equal(forceText("LF_SHANK", "7 N", forces), "push 7 N");
  assert.equal(forceText("base", "140 N", { ...forces, pushed: new Set(["LF_SHANK"]) }), "pull 140 N (of 40.0 N·s in all)");
  assert.equal(forceText("base", "140 N", { ...forces, pushed: new Set(["base"]) }), "pull and push 140 N");
});

test("a push is told of for a while after its end, of each body the latest; what still acts, or is to come, is not over", () => {
  const spentAt = (all: Mark[], time: number, since = time - 1): [string, number, number][] =>
    spentForces(all, since, time, PERIOD).map(({ body, begin, end }) => [body, begin, Number(end.toFixed(6))]);
  for (const [time, spent] of [[0.9, []], [1.1, []], [1.2, []], [1.2 + PERIOD, [["base", 1, 1.2]]], [2.1, [["base", 1, 1.2]]], [2.2, []], [3.1, []], [4.5, [["LF_SHANK", 4, 4.2]]]] as const)
    assert.deepEqual(spentAt(steered, time), spent, `${time} s`);
  assert.deepEqual(spentAt(steered, 3.5, 0.9), [["base", 1, 1.2]], "that nobody has seen yet");
  const scenarios = marks(scenario(7, "base"), push(7.1, "LF_SHANK"), scenario(7.5, "base", false), push(7.6, "base"));
  assert.deepEqual(spentAt(scenarios, 7.4), [["LF_SHANK", 7.1, 7.3]]);
  assert.deepEqual(spentAt(scenarios, 7.7), [["LF_SHANK", 7.1, 7.3], ["base", 7, 7.5]]);
  assert.deepEqual(spentAt(scenarios, 8), [["LF_SHANK", 7.1, 7.3], ["base", 7.6, 7.8]]);
  assert.equal(spentText("75 N", { body: "base", begin: 1.0025, end: 1.2025 }), "pushed 75 N for 0.2 s");
});
