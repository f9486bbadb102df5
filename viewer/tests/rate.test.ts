import assert from "node:assert/strict";
import { test } from "node:test";
import { rateOf, type Status } from "../src/protocol/connection.ts";

const status = (more: Partial<Status>): Status => ({ paused: false, ended: null, speed: 1, real_factor: 0, ...more }) as Status;

test("the picture goes on at the rate that was measured, at every speed", () => {
  for (const speed of [0.03125, 0.25, 1, 8]) assert.equal(rateOf(status({ speed, real_factor: speed })), speed);
  assert.equal(rateOf(status({ speed: 8, real_factor: 3.5 })), 3.5);
});

test("before it was measured at the rate that was asked for, and not faster than that", () => {
  assert.equal(rateOf(status({ speed: 0.25 })), 0.25);
  assert.equal(rateOf(status({ speed: 0.25, real_factor: 1 })), 0.25, "measured at another speed");
});

test("a run that is paused or has ended stands still", () => {
  assert.equal(rateOf(status({ paused: true, real_factor: 1 })), 0);
  assert.equal(rateOf(status({ ended: "fell", real_factor: 1 })), 0);
});
