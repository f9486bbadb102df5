import assert from "node:assert/strict";
import { test } from "node:test";
import { GamepadReader, sticksOf } from "../src/input/gamepad.ts";

test("the left stick walks and the right one turns; near its rest a stick does nothing", () => {
  assert.deepEqual(sticksOf({ axes: [0.1, -1, 0, 0] }), { forward: 1, left: 0, turn: 0 });
  assert.deepEqual(sticksOf({ axes: [-1, 0, 1, 0] }), { forward: 0, left: 1, turn: -1 });
  assert.deepEqual(sticksOf({ axes: [] }), { forward: 0, left: 0, turn: 0 });
});

test("commands go out when a stick has moved, ten a second at most, and a button acts once a press", () => {
  const pad = { axes: [0, 0, 0], buttons: [{ pressed: false }, { pressed: false }] };
  const did: string[] = [];
  const reader = new GamepadReader(({ forward }) => did.push(`forward ${forward}`), (button) => did.push(button), () => [null, pad]);
  reader.read(0);
  assert.deepEqual(did, [], "at rest");
  pad.axes[1] = -1;
  reader.read(100);
  pad.axes[1] = 0;
  reader.read(150);
  reader.read(210);
  assert.deepEqual(did, ["forward 1", "forward 0"]);
  pad.buttons[0]!.pressed = true;
  for (const time of [300, 400]) reader.read(time);
  pad.buttons[0]!.pressed = false;
  reader.read(500);
  pad.buttons[0]!.pressed = true;
  reader.read(600);
  assert.deepEqual(did.slice(2), ["push", "push"]);
});

test("without a gamepad nothing happens", () => {
  const reader = new GamepadReader(() => assert.fail(), () => assert.fail(), () => []);
  reader.read(0);
});
