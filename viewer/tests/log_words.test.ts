import assert from "node:assert/strict";
import { test } from "node:test";
import { againText, damageText, logText, readText, recordingText, unreadableText } from "../src/data/log_words.ts";

const hole = "12.40 s to 12.61 s can't be read: the checksum of a chunk is wrong";
const unknown = "2 pieces of the log can't be read, nor from when they are";

test("damage is told with what can still be done, and with pieces of a known time first", () => {
  assert.equal(damageText([hole]), `This log is damaged, the rest of it can be seen: ${hole}.`);
  assert.equal(damageText([unknown, hole, `timings of ${hole}`]), `This log is damaged, the rest of it can be seen: ${hole}; timings of ${hole}; ${unknown}.`);
});

test("a log full of holes is not told hole by hole", () => {
  const holes = Array.from({ length: 100 }, (_, k) => `${k}.00 s to ${k}.50 s can't be read: why`);
  const text = damageText([unknown, ...holes]);
  assert.ok(text.includes("0.00 s to 0.50 s") && !text.includes("50.00 s"));
  assert.ok(text.endsWith("; and 89 more."));
});

test("how much of a log is read never says more than there is", () => {
  assert.equal(readText(17.03, 60), "Reading the log: 17 s of 60 s");
  assert.equal(readText(1.98, 2), "Reading the log: 1 s of 2 s");
  assert.equal(readText(6, 12.04), "Reading the log: 6 s of 12 s");
  assert.equal(readText(0, 0.04), "Reading the log: 0 s of 1 s");
});

test("a run that was steered is not had again by its command", () => {
  const command = "surefoot run walk_flat";
  assert.equal(againText(command, "", true, false), command);
  assert.equal(againText("", "a.mcap", true, true), "");
  assert.equal(againText(command, "a.mcap", true, true), `${command} (without what was changed and pushed by hand: bin/surefoot replay a.mcap --verify repeats it)`);
  assert.equal(againText(command, "a.mcap", false, true).split(" (")[0], command, "it can be copied");
  assert.equal(againText(command, "a.mcap", false, false), `${command} (it goes on where this log ends)`);
  assert.ok(againText(command, "", true, true).includes("--record"));
  assert.ok(againText(command, "a.mcap", true, true, false).endsWith(": when the run has ended, bin/surefoot replay a.mcap --verify repeats it)"));
});

test("a log that is cut off or damaged is marked beside its name", () => {
  assert.equal(logText("a.mcap", "", []), "a.mcap");
  assert.equal(logText("a.mcap", "never closed", []), "a.mcap (never closed)");
  assert.equal(logText("a.mcap", "", [hole]), "a.mcap (damaged: 1 piece of it can't be read)");
  assert.equal(logText("a.mcap", "never closed", [hole, unknown]), "a.mcap (never closed; damaged: 2 pieces of it can't be read)");
});

test("of a live run it is told whether and where it is recorded", () => {
  assert.equal(recordingText("logs/fin.mcap", true), "recorded in logs/fin.mcap");
  assert.equal(recordingText("logs/fin.mcap", false), "goes into logs/fin.mcap.partial, which is called logs/fin.mcap when the run has ended");
  for (const hasEnded of [false, true]) assert.ok(recordingText("", hasEnded).includes("--record"));
});

test("where a tick can't be read, the time that is shown instead is told", () => {
  assert.equal(unreadableText(8.1275000001), "This tick can't be read: shown is 8.1275 s.");
});
