import assert from "node:assert/strict";
import { test } from "node:test";
import type * as THREE from "three";
import { Pace } from "../src/scene/pace.ts";
import { Quality } from "../src/scene/quality.ts";

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

/** Draws a picture in each of some frames, which come every 16 ms; the time after them. */
function draw(quality: Quality, from: number, frames: number): number {
  let now = from;
  for (let i = 0; i < frames; ++i, now += 16) {
    assert.ok(quality.pace.begin(now), `${now} ms`);
    quality.pace.drew(now);
    quality.measure();
  }
  return now;
}

test("a page that was hidden for two seconds goes on at once, and as fine as before", () => {
  const page = new EventTarget();
  Object.assign(globalThis, { document: page, window: { devicePixelRatio: 1 } });
  const quality = new Quality({ shadowMap: {} } as unknown as THREE.WebGLRenderer, () => {}, false);
  let now = 0;
  for (let spell = 0; spell < 10; ++spell) {
    now = draw(quality, now, 20);
    page.dispatchEvent(new Event("visibilitychange"));
    now += 2000;
    page.dispatchEvent(new Event("visibilitychange"));
  }
  draw(quality, now, 20);
  assert.equal(quality.step, 1);
  assert.equal(quality.pace.took, 16);
});

test("no rest is longer than a second", () => {
  const pace = new Pace();
  pace.drew(0);
  assert.ok(!pace.begin(2800));
  assert.ok(pace.begin(3801));
});

test("what stands still is drawn once as finely as the machine can, and tells no rate; what moves again as coarsely as before", () => {
  Object.assign(globalThis, { document: new EventTarget(), window: { devicePixelRatio: 1 } });
  const quality = new Quality({ shadowMap: {} } as unknown as THREE.WebGLRenderer, () => {}, false);
  assert.ok(!quality.rest(), "it is as fine as can be");
  quality.move();
  for (let k = 0; k < 100; ++k) {
    quality.pace.took = 300;
    quality.measure();
  }
  const { step } = quality;
  assert.ok(!quality.shadows && quality.rate.includes("fps"));
  assert.ok(quality.rest());
  assert.ok(!quality.rest(), "once");
  assert.ok(quality.shadows && quality.detail === 0);
  assert.deepEqual([quality.rate, quality.coarse], ["", ""]);
  quality.pace.took = 5000; // that the fine picture kept the browser busy
  quality.move();
  quality.measure();
  assert.deepEqual([quality.step, quality.shadows], [step, false]);
  assert.ok(quality.frameTime < 1000);
});

test("what the processor draws begins coarse, and is finer where it stands still", () => {
  Object.assign(globalThis, { document: new EventTarget(), window: { devicePixelRatio: 1 } });
  const quality = new Quality({ shadowMap: {} } as unknown as THREE.WebGLRenderer, () => {}, true);
  assert.deepEqual([quality.pixelRatio, quality.shadows, quality.detail > 0], [0.6, false, true]);
  assert.ok(quality.rest());
  assert.deepEqual([quality.pixelRatio, quality.shadows], [1, false]);
  quality.move();
  for (let k = 0; k < 100; ++k) {
    quality.pace.took = 300;
    quality.measure();
  }
  assert.deepEqual([quality.pixelRatio, quality.coarse], [0.4, "coarse picture: the processor draws"]);
});
