import assert from "node:assert/strict";
import { test } from "node:test";
import { Envelope } from "../src/data/envelope.ts";
import { randomNumbers } from "./make.ts";

test("an envelope holds the least and the greatest of each stretch", () => {
  const random = randomNumbers(2);
  for (let run = 0; run < 50; ++run) {
    const envelope = new Envelope(0, 1, 10, 1);
    const least = new Array<number>(10).fill(Infinity);
    const greatest = new Array<number>(10).fill(-Infinity);
    for (let k = 0; k < 400; ++k) {
      const time = random();
      const value = random() - 0.5;
      const bucket = Math.floor(10 * time);
      least[bucket] = Math.min(least[bucket] as number, value);
      greatest[bucket] = Math.max(greatest[bucket] as number, value);
      envelope.add(0, time, value);
    }
    const y = envelope.columns()[1] as number[];
    for (let b = 0; b < 10; ++b) assert.deepEqual([y[2 * b], y[2 * b + 1]], [least[b], greatest[b]]);
  }
});

test("what is not known or lies outside is passed over", () => {
  const envelope = new Envelope(0, 1, 4, 1);
  envelope.add(0, 0.5, NaN);
  envelope.add(0, 1.5, 7);
  envelope.add(0, -0.1, 7);
  assert.equal(envelope.columns()[0].length, 0);
  assert.deepEqual(envelope.bounds(), [0, 1]);
});

test("the last moment belongs to the last stretch", () => {
  const envelope = new Envelope(0, 1, 4, 1);
  envelope.add(0, 1, 3);
  assert.deepEqual([...(envelope.columns()[1] as number[])], [3, 3]);
});

test("bounds leave room over and below, also for a line that does not move", () => {
  const envelope = new Envelope(0, 1, 4, 1);
  envelope.add(0, 0.5, 100);
  const [low, high] = envelope.bounds();
  assert.ok(low < 100 && high > 100);
});

test("round-off is a flat line at 0", () => {
  const envelope = new Envelope(0, 1, 10, 1);
  for (const [time, value] of [[0.1, 8.9e-16], [0.5, -3e-12]] as const) envelope.add(0, time, value);
  assert.deepEqual(envelope.bounds(), [-0.5, 0.5]);
});
