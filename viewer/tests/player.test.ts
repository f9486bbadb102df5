import assert from "node:assert/strict";
import { test } from "node:test";
import { Player } from "../src/data/player.ts";
import type { FrameSource } from "../src/data/source.ts";

function sourceOf(first: number, last: number): FrameSource & { first: number; last: number } {
  return { first, last, marks: [], neighbour: (time: number, steps: number) => time + 0.01 * steps } as unknown as FrameSource & { first: number; last: number };
}

test("a log plays at its speed and stops at its end", () => {
  const player = new Player(sourceOf(1, 3), false);
  player.advance(0.1, 0);
  assert.ok(Math.abs(player.time - 1.1) < 1e-12);
  player.speed = 8;
  player.advance(0.1, 0);
  assert.ok(Math.abs(player.time - 1.9) < 1e-12);
  player.advance(1, 0);
  assert.equal(player.time, 3);
  assert.equal(player.playing, false);
  player.toggle();
  assert.equal(player.time, 1, "from its end it begins again");
});

test("a live picture stays close behind the newest frame and moves evenly", () => {
  const source = sourceOf(0, 10);
  const player = new Player(source, true);
  player.advance(0, 1);
  let largest = 0;
  for (let k = 0; k < 600; ++k) {
    if (k % 3 === 0) source.last += 0.05; // blocks of three pictures' time
    const before = player.time;
    player.advance(1 / 60, 1);
    largest = Math.max(largest, Math.abs(player.time - before - 1 / 60));
  }
  assert.ok(largest < 0.015, `moves by ${largest} s too far`);
  assert.ok(source.last - player.time < 0.15);
});

test("a live picture that fell far behind, as of a tab that slept, jumps", () => {
  const source = sourceOf(0, 10);
  const player = new Player(source, true);
  player.advance(0.016, 1);
  source.last = 60;
  player.advance(0.016, 1);
  assert.ok(player.time > 59.8);
});

test("a paused run shows its very last frame", () => {
  const player = new Player(sourceOf(0, 10), true);
  player.advance(0.016, 1);
  player.advance(0.016, 0);
  assert.equal(player.time, 10);
});

test("looking back leaves the newest picture, playing comes back to it", () => {
  const source = sourceOf(0, 10);
  const player = new Player(source, true);
  player.advance(0.016, 1);
  player.seek(4);
  source.last = 11;
  player.advance(0.5, 1);
  assert.equal(player.time, 4);
  player.toggle();
  player.advance(0.5, 1);
  assert.equal(player.time, 4.5);
  player.speed = 8;
  player.advance(1, 1);
  assert.equal(player.following, true);
});

test("times outside the run are brought to its ends", () => {
  const player = new Player(sourceOf(2, 5), false);
  player.seek(99);
  assert.equal(player.time, 5);
  player.seek(-99);
  assert.equal(player.time, 2);
});

test("a log has no newest picture to stay at", () => {
  const player = new Player(sourceOf(0, 36), false);
  player.goLive();
  player.advance(0.1, 0);
  player.seek(5);
  player.advance(0, 0);
  assert.deepEqual([player.time, player.following], [5, false]);
});

test("keys that are pressed before the first frame do not make it one of the past", () => {
  const source = sourceOf(NaN, NaN);
  const player = new Player(source, true);
  player.seek(player.time - 0.1);
  player.step(-1);
  [source.first, source.last] = [0, 2];
  player.advance(0.1, 1);
  assert.deepEqual([player.past, player.playing, player.time], [false, true, 2]);
});
