import assert from "node:assert/strict";
import { test } from "node:test";
import { givenText } from "../src/panels/drive_panel.ts";
import { Grip } from "../src/input/grip.ts";
import * as THREE from "three";
import { pullText, springForce } from "../src/input/pull.ts";
import type { Status } from "../src/protocol/connection.ts";

function held(force: () => number[], allowed = (): boolean => true) {
  const sent: number[][] = [];
  let refused = 0;
  const grip: Grip = new Grip(force, (one) => sent.push(one), allowed, () => {
    ++refused;
    grip.end();
  });
  return { grip, sent, refused: () => refused };
}

test("a pull shorter than a renewal acts, for as long as one", ({ mock }) => {
  mock.timers.enable({ apis: ["setTimeout", "setInterval"] });
  const { grip, sent } = held(() => [0, 30, 0]);
  grip.moved();
  mock.timers.tick(10);
  grip.end();
  assert.deepEqual(sent, [[0, 30, 0]]);
  mock.timers.tick(60);
  assert.deepEqual(sent, [[0, 30, 0], [0, 0, 0]]);
  mock.timers.tick(1000);
  assert.equal(sent.length, 2);
});

test("a longer one is renewed, and ends as soon as it is let go", ({ mock }) => {
  mock.timers.enable({ apis: ["setTimeout", "setInterval"] });
  const { grip, sent } = held(() => [5, 0, 0]);
  for (let i = 0; i < 20; ++i) mock.timers.tick(10);
  grip.end();
  assert.deepEqual(sent, [[5, 0, 0], [5, 0, 0], [5, 0, 0], [0, 0, 0]]);
});

test("a page that may no longer pull lets go", ({ mock }) => {
  mock.timers.enable({ apis: ["setTimeout", "setInterval"] });
  let allowed = true;
  const { sent, refused } = held(() => [5, 0, 0], () => allowed);
  mock.timers.tick(130);
  allowed = false;
  mock.timers.tick(500);
  assert.equal(refused(), 1);
  assert.deepEqual(sent, [[5, 0, 0], [5, 0, 0], [0, 0, 0]]);
});

test("a pull that lasts a little does not end the next", ({ mock }) => {
  mock.timers.enable({ apis: ["setTimeout", "setInterval"] });
  const { grip, sent } = held(() => [5, 0, 0]);
  grip.moved();
  grip.end();
  grip.drop();
  mock.timers.tick(500);
  assert.deepEqual(sent, [[5, 0, 0]]);
});

test("what a pull has given is that of the pull, whatever pushes beside it", () => {
  const push = { force: [0, 200, 0], body: "base", given: 31 };
  const pull = { force: [0, 0, 60], body: "base", given: 4.25 };
  assert.equal(pullText(120, 300, undefined), "pull 120 N, 0.0 N·s so far");
  assert.equal(pullText(120, 300, { pull, pull_is_weaker: false }), "pull 120 N, 4.3 N·s so far");
  assert.equal(pullText(300, 300, { pull, pull_is_weaker: true }), "pull 60 N (no more is allowed now), 4.3 N·s so far");
  const text = givenText({ push, pull, newton_seconds_left: 12.4 } as Status);
  assert.equal(text, "Pushed 31.0 N·s by now. Pulled 4.3 N·s by now. Up to 12 N·s now.");
  assert.equal(givenText({ push: null, pull: null, newton_seconds_left: 60 } as Status), "Up to 60 N·s now.");
  assert.match(givenText({ push: { ...push, given: 0 }, pull: null, newton_seconds_left: 45 } as Status), /^A push begins: the tick after it shows its force\./);
});

test("a pull of a hand's breadth is one that a walk stands", () => {
  const force = (way: number): number => springForce(new THREE.Vector3(), new THREE.Vector3(0, way, 0), 300, new THREE.Vector3()).length();
  assert.ok(Math.abs(force(0.2) - 60) < 1e-9);
  assert.equal(force(3), 300);
});
