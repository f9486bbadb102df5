import assert from "node:assert/strict";
import { test } from "node:test";
import { Pace } from "../src/scene/pace.ts";

/** Draws whenever it may for a while; a picture takes `cost`, a frame without one 16 ms. Share of the time spent drawing, and pictures. */
function play(pace: Pace, cost: number, duration: number): [share: number, pictures: number] {
  let pictures = 0;
  for (let now = 0; now < duration; ) {
    if (pace.begin(now)) {
      pace.drew(now);
      ++pictures;
      now += cost;
    } else now += 16;
  }
  return [(pictures * cost) / duration, pictures];
}

test("quick pictures come with every frame", () => {
  const [, pictures] = play(new Pace(), 16, 1600);
  assert.equal(pictures, 100);
});

test("slow pictures leave at least half of the time to what else there is", () => {
  for (const cost of [50, 180, 700]) {
    const pace = new Pace();
    const [share, pictures] = play(pace, cost, 20000);
    assert.ok(share < 0.53 && share > 0.3, `${cost} ms: ${share}`);
    assert.ok(pictures > 10);
    assert.equal(pace.period, 2 * cost);
  }
});

test("a tab that slept is no slow picture", () => {
  const pace = new Pace();
  play(pace, 20, 200);
  pace.begin(200);
  pace.drew(1000);
  assert.ok(pace.begin(61000));
  assert.equal(pace.took, 20);
});
