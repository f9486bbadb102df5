import assert from "node:assert/strict";
import { test } from "node:test";
import { marksOf } from "../src/data/marks.ts";
import { LiveSource } from "../src/data/live_source.ts";
import { Player } from "../src/data/player.ts";
import { Generations } from "../src/data/generations.ts";
import { silenceOf } from "../src/protocol/connection.ts";
import { staleText } from "../src/panels/stale.ts";
import { schemaOf } from "./make.ts";

const PERIOD = 0.0025;

function filled(): LiveSource {
  const source = new LiveSource(schemaOf({ x: 1 }));
  for (let tick = 0; tick < 1000; ++tick) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  return source;
}

test("a run that begins again is noticed once, by its first tick", () => {
  const source = filled();
  let restarts = 0;
  source.onRestart = () => ++restarts;
  for (let tick = 0; tick < 3; ++tick) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  assert.equal(restarts, 1);
  assert.equal(source.at(1)?.tick, 2);
});

test("after a reset nothing is shown until the first tick, and then that, although one looked back", () => {
  const source = filled();
  const player = new Player(source, true);
  player.advance(0.016, 1);
  player.seek(1);
  source.clear();
  player.restart();
  assert.ok(player.following && player.playing);
  player.advance(0.016, 0);
  assert.equal(source.at(player.time), undefined);
  source.append(0, 0, Float32Array.of(7), undefined);
  player.advance(0.016, 0);
  assert.equal(source.at(player.time)?.tick, 0);
});

test("marks are what the program says happened, for as long as there are frames, and those of this run", () => {
  const source = new LiveSource(schemaOf({ x: 1 }));
  const mark = (time: number): void => source.mark(...marksOf([[time, 1, "LH"], { time, kind: "mode", text: "command mode: hold" }], source.schema.events));
  for (const time of [5, 200]) source.append(time * 400, time, Float32Array.of(0), undefined);
  mark(1);
  mark(199);
  assert.deepEqual(source.marks, [{ time: 199, text: "lift-off", leg: "LH", kind: "event" }, { time: 199, text: "command mode: hold", leg: "", kind: "mode" }]);
  source.append(0, 0, Float32Array.of(0), undefined);
  assert.deepEqual(source.marks, []);
});

test("a reset that this page asked for is done when the generation rises; what was before is then old", () => {
  const generations = new Generations();
  assert.equal(generations.begins(5), false);
  generations.awaitReset();
  assert.equal(generations.begins(5), false);
  assert.equal(generations.isOld(5), false);
  assert.equal(generations.begins(6), true);
  assert.equal(generations.begins(7), false);
  assert.deepEqual([5, 6, 7].map((one) => generations.isOld(one)), [true, false, false]);
});

test("a program is silent when nothing came for three seconds", () => {
  assert.equal(silenceOf(10_000, 12_900), 0);
  assert.equal(silenceOf(10_000, 13_000), 3);
  assert.equal(silenceOf(10_000, 21_999), 11);
});

test("old numbers say how old they are", () => {
  assert.equal(staleText(12.3051, 7), "Nothing new for 7 s: all numbers are from 12.305 s of the run.");
});
