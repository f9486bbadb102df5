import assert from "node:assert/strict";
import { test } from "node:test";
import { Envelope } from "../src/data/envelope.ts";
import { LiveSource } from "../src/data/live_source.ts";
import { FrameRing } from "../src/data/ring.ts";
import { schemaOf } from "./make.ts";

const schema = schemaOf({ x: 1 });
const PERIOD = 0.0025;

function filled(ticks: number, seconds = 3): FrameRing {
  const ring = new FrameRing(seconds);
  for (let tick = 0; tick < ticks; ++tick) ring.append(schema, tick, tick * PERIOD, Float32Array.of(tick), undefined);
  return ring;
}

test("a ring gives the last frame at or before a time", () => {
  const ring = filled(1000);
  for (const tick of [0, 1, 399, 400, 401, 999]) {
    assert.equal(ring.at(tick * PERIOD)?.tick, tick);
    assert.equal(ring.at(tick * PERIOD + 0.9 * PERIOD)?.tick, tick);
    assert.equal(ring.at(tick * PERIOD)?.values[0], tick);
  }
  assert.equal(ring.at(-1)?.tick, 0);
  assert.equal(ring.at(1e9)?.tick, 999);
});

test("a ring holds at least the time it is made for, and not much more", () => {
  const ring = filled(20000, 3);
  const held = ring.last - ring.first;
  assert.ok(held >= 3 && held < 5.1, `${held} s`);
  assert.equal(ring.at(ring.first)?.values[0], Math.round(ring.first / PERIOD));
});

test("neighbours are found over the seams of segments and end at the ends", () => {
  const ring = filled(1000);
  for (const tick of [0, 399, 400, 799, 998]) assert.equal(ring.neighbour(tick * PERIOD, 1), (tick + 1) * PERIOD);
  for (const tick of [1, 400, 401, 800]) assert.equal(ring.neighbour(tick * PERIOD, -1), (tick - 1) * PERIOD);
  assert.equal(ring.neighbour(0, -5), 0);
  assert.equal(ring.neighbour(999 * PERIOD, 5), 999 * PERIOD);
  assert.equal(ring.neighbour(0, 900), 900 * PERIOD);
});

test("a run that begins again empties the ring", () => {
  const ring = filled(1000);
  ring.append(schema, 0, 0, Float32Array.of(5), undefined);
  assert.equal(ring.first, 0);
  assert.equal(ring.last, 0);
  assert.equal(ring.at(1)?.values[0], 5);
});

test("frames keep the schema that they came with", () => {
  const ring = filled(10);
  const later = schemaOf({ y: 1, z: 1 });
  ring.append(later, 10, 10 * PERIOD, Float32Array.of(1, 2), undefined);
  assert.equal(ring.at(9 * PERIOD)?.schema, schema);
  assert.equal(ring.at(10 * PERIOD)?.schema, later);
});

test("a live source's plot shows a spike of one tick in two minutes", () => {
  const source = new LiveSource(schema);
  for (let tick = 0; tick < 48000; ++tick)
    source.append(tick, tick * PERIOD, Float32Array.of(tick === 12345 ? 99 : 1), undefined);
  const envelope = new Envelope(source.first, source.last, 300, 1);
  source.fill(envelope, [{ channel: "x", index: 0 }]);
  assert.equal(Math.max(...(envelope.columns()[1] as number[])), 99);
  const at = envelope.columns()[1]?.indexOf(99) as number;
  assert.ok(Math.abs((envelope.columns()[0][at] as number) - 12345 * PERIOD) < 0.5);
});

test("a sample of a live source has about the number of frames that was asked for, in order", () => {
  const source = new LiveSource(schema);
  for (let tick = 0; tick < 4000; ++tick) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  const times: number[] = [];
  source.sample(2, 8, 100, (frame) => times.push(frame.time));
  assert.ok(times.length > 70 && times.length <= 101, String(times.length));
  assert.deepEqual(times, [...times].sort((a, b) => a - b));
  assert.ok((times[0] as number) >= 2 - PERIOD && (times.at(-1) as number) <= 8);
});
