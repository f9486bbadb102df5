import assert from "node:assert/strict";
import { test } from "node:test";
import { choicesOf, namesOf, unitOf, valueText, wordsOf } from "../src/data/channel_names.ts";
import { search } from "../src/panels/plots_panel.ts";
import type { ChannelInfo } from "../src/protocol/session.ts";
import { schemaOf } from "./make.ts";

const LEGS = ["LF", "RF", "LH", "RH"];
const JOINTS = LEGS.flatMap((leg) => ["HAA", "HFE", "KFE"].map((joint) => `${leg}_${joint}`));
const AXES = ["x", "y", "z"];

const schema = schemaOf({
  "command.torque": 12, "state.torque": 12, "state.v_WB": 3, time: 1, "world.forces": 144,
  ...Object.fromEntries(LEGS.map((leg) => [`feet.${leg}.force`, 3])), ...Object.fromEntries(LEGS.map((leg) => [`feet.${leg}.friction`, 1])),
});
for (const channel of schema.channels) {
  if (channel.size === 12) Object.assign(channel, { labels: JOINTS, unit: "N·m" });
  if (channel.size === 3) Object.assign(channel, { labels: AXES });
}
const channel = (name: string): ChannelInfo => schema.channel(name) as ChannelInfo;
const of = (name: string, index: number): { channel: string; index: number } => ({ channel: name, index });

test("lines are called by what they have in common, and each by the rest", () => {
  assert.deepEqual(namesOf([of("command.torque", 2)], schema), { title: "command.torque.LF_KFE", labels: [""] });
  assert.deepEqual(namesOf([of("time", 0)], schema), { title: "time", labels: [""] });
  assert.deepEqual(namesOf([of("state.v_WB", 0), of("state.v_WB", 2)], schema), { title: "state.v_WB", labels: ["x", "z"] });
  assert.deepEqual(namesOf(LEGS.map((leg) => of(`feet.${leg}.force`, 2)), schema), { title: "feet.force.z", labels: LEGS });
  assert.deepEqual(namesOf([of("command.torque", 2), of("state.torque", 2)], schema), { title: "torque.LF_KFE", labels: ["command", "state"] });
  assert.deepEqual(namesOf([of("command.torque", 2), of("time", 0)], schema), { title: "several channels", labels: ["command.torque.LF_KFE", "time"] });
});

test("lines have one unit or each its own", () => {
  assert.equal(unitOf([of("command.torque", 2), of("state.torque", 5)], schema), "N·m");
  assert.equal(unitOf([of("command.torque", 2), of("time", 0)], schema), undefined);
});

test("of a channel its components can be chosen, the joints of a leg, and the same of all legs", () => {
  assert.deepEqual(choicesOf(channel("time"), schema), []);
  assert.deepEqual(choicesOf(channel("command.torque"), schema).map(({ name }) => name), [...JOINTS, ...LEGS.map((leg) => `${leg} whole`)]);
  const hind = choicesOf(channel("command.torque"), schema).find(({ name }) => name === "LH whole");
  assert.deepEqual(hind?.series, [6, 7, 8].map((index) => of("command.torque", index)));
  const force = choicesOf(channel("feet.RF.force"), schema);
  assert.deepEqual(force.map(({ name }) => name), [...AXES, ...AXES.map((axis) => `${axis} of all legs`)]);
  assert.deepEqual(force.at(-1)?.series, LEGS.map((leg) => of(`feet.${leg}.force`, 2)));
  assert.deepEqual(choicesOf(channel("feet.RF.friction"), schema).map(({ name }) => name), ["of all legs"]);
});

test("a single component is found by its whole name, or any words of it", () => {
  for (const typed of ["command.torque.LF_KFE", "command LF_KFE", "lf_kfe COMMAND"]) {
    const found = search(schema, typed);
    assert.deepEqual(found.map(({ channel: one }) => one.name), ["command.torque"], typed);
    assert.deepEqual([found[0]?.isPart, found[0]?.choices.map(({ name }) => name)], [true, ["LF_KFE"]], typed);
  }
  const [torque] = search(schema, "command.torque");
  assert.deepEqual([torque?.isPart, torque?.choices.length], [false, 16]);
  assert.deepEqual(search(schema, "LF_KFE").map(({ channel: one }) => one.name), ["command.torque", "state.torque"]);
  assert.deepEqual(search(schema, "world.forces")[0]?.choices, [], "too many to be offered");
  assert.deepEqual(search(schema, "world.forces.143")[0]?.choices.map(({ name }) => name), ["143"]);
  assert.deepEqual(search(schema, "nothing"), []);
});

test("numbers that stand for words are told as these, round-off as 0", () => {
  const phases = ["stance", "swing"];
  const words = schemaOf({ a: 1, b: 1, mode: 1, x: 1 });
  for (const [name, values] of [["a", phases], ["b", [...phases]], ["mode", ["walk", "hold"]]] as const) Object.assign(words.channel(name) as object, { values });
  const of = (...names: string[]): { channel: string; index: number }[] => names.map((channel) => ({ channel, index: 0 }));
  assert.deepEqual(wordsOf(of("a", "b"), words), phases);
  for (const names of [[], ["a", "mode"], ["a", "x"], ["x"]]) assert.equal(wordsOf(of(...names), words), undefined);
  const [a, x] = of("a", "x") as [{ channel: string; index: number }, { channel: string; index: number }];
  assert.deepEqual([0, 1, NaN, 7].map((value) => valueText(a, value, words)), ["stance", "swing", "–", "7.00"]);
  assert.deepEqual([1, -8.9e-16, 1e-7].map((value) => valueText(x, value, words)), ["1.00", "0", "1.0·10⁻⁷"]);
});
