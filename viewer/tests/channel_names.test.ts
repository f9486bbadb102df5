import assert from "node:assert/strict";
import { test } from "node:test";
import { choicesOf, legIn, namesOf, unitOf, valueText, wordsOf } from "../src/data/channel_names.ts";
import { HEXAPOD_LEGS } from "../src/data/schema.ts";
import { allOf, rangeOfPast, search } from "../src/panels/plots_panel.ts";
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

test("a robot has the legs that its channels name", () => {
  const six = schemaOf(Object.fromEntries(HEXAPOD_LEGS.map((leg) => [`feet.${leg}.friction`, 1])));
  assert.deepEqual([schema, six].map(({ legs }) => legs.map(({ name }) => name)), [LEGS, HEXAPOD_LEGS]);
  assert.equal(choicesOf(six.channel("feet.LM.friction") as ChannelInfo, six)[0]?.series.length, 6);
  assert.equal(legIn("torque.LH_KFE", six), 4);
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

test("of channels that are called as was typed the usual ones come first, then others of such a name, then those that are described so", () => {
  const many = schemaOf({ "readings.torque": 12, "readings.torque_time": 1, "health.joint_torques.age": 1, "state.torque": 12, "command.torque": 12, "truth.torque": 12, "com.about": 1 });
  Object.assign(many.channel("com.about") as object, { about: "of the torque" });
  const found = search(many, "torque").map(({ channel }) => channel.name);
  assert.deepEqual(found, ["command.torque", "readings.torque", "state.torque", "truth.torque", "readings.torque_time", "health.joint_torques.age", "com.about"]);
  assert.equal(search(many, "joint torques")[0]?.channel.name, "health.joint_torques.age");
  for (const typed of ["torque ", " torque", " torque  "]) assert.deepEqual(search(many, typed).map(({ channel }) => channel.name), found, "with space around it");
  assert.deepEqual(search(many, "").map(({ channel }) => channel.name), many.channels.map(({ name }) => name), "all, in the order of the log");
});

test("while one looks back, plots go from before that time to the newest", () => {
  assert.deepEqual(rangeOfPast(55, 0, 60, 10), [50, 60]);
  assert.deepEqual(rangeOfPast(55, 0, 61, 10), [51, 61], "on with the run");
  const [from, to] = rangeOfPast(55, 0, 80, 10);
  assert.ok(to === 80 && from < 55 && (55 - from) / (to - from) > 0.04);
  assert.deepEqual(rangeOfPast(1, 0, 4, 10), [0, 10], "not yet as much as is shown");
  assert.deepEqual(rangeOfPast(30, 20, 140, 10)[1], 140);
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

test("who looks for a push finds the bodies that can be pushed, and not all numbers at once", () => {
  const bodies = ["base", "LF_HIP", "LF_SHANK"];
  const pushes = schemaOf({ "truth.xfrc_applied": 24, "state.q": 3 }, { bodies });
  const names = (typed: string): string[] | undefined => search(pushes, typed)[0]?.choices.map(({ name }) => name);
  assert.deepEqual(names("push")?.slice(0, 4), ["force on base", "force on LF_HIP", "force on LF_SHANK", "torque on base"]);
  assert.deepEqual(names("push")?.length, 6);
  assert.deepEqual(names("torque on LF_HIP"), ["torque on LF_HIP"]);
  const [first] = search(pushes, "push")[0]?.choices ?? [];
  assert.deepEqual(first?.series, [6, 7, 8].map((index) => ({ channel: "truth.xfrc_applied", index })));
  assert.deepEqual(namesOf(first?.series ?? [], pushes), { title: "truth.xfrc_applied", labels: ["base.Fx [N]", "base.Fy [N]", "base.Fz [N]"] });
  for (const typed of ["outside force", "xfrc_applied"]) assert.equal(search(pushes, typed)[0]?.channel.name, "truth.xfrc_applied", typed);
});

test("of a log that does not tell its bodies, what pushes can be plotted like any other channel", () => {
  for (const [size, bodies] of [[24, []], [6, []], [24, ["base"]]] as const) {
    const pushes = schemaOf({ "truth.xfrc_applied": size }, { bodies: [...bodies] });
    const [found] = search(pushes, "xfrc_applied");
    const whole = Array.from({ length: size }, (_, index) => ({ channel: "truth.xfrc_applied", index }));
    assert.deepEqual(found?.choices.flatMap(({ series }) => series), whole, "its single components");
    assert.deepEqual(found && allOf(found.channel, found.choices, pushes), whole);
  }
  const known = schemaOf({ "truth.xfrc_applied": 24 }, { bodies: ["base", "LF_HIP", "LF_SHANK"] });
  const [found] = search(known, "xfrc_applied");
  assert.deepEqual(found && allOf(found.channel, found.choices, known).map(({ index }) => index), [6, 7, 8]);
});
