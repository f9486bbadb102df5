import assert from "node:assert/strict";
import { test } from "node:test";
import { beyondDeadZone, GamepadInput } from "../src/input/gamepad.ts";

interface Pad { connected: boolean; mapping: string; id: string; axes: number[]; buttons: { pressed: boolean }[] }

const padOf = (more: Partial<Pad> = {}): Pad => ({
  connected: true, mapping: "standard", id: "pad", axes: [0, 0, 0, 0],
  buttons: [{ pressed: false }, { pressed: false }], ...more,
});

/** Hears these gamepads; `does` is all that was asked for. */
function playedBy(...pads: (Pad | null)[]): { input: GamepadInput; does: string[]; hear: (canAct?: boolean) => void } {
  Object.defineProperty(globalThis, "navigator", { value: { getGamepads: () => pads }, configurable: true });
  const does: string[] = [];
  const input = new GamepadInput({ forward: 0.5, left: 0.25, turn: 0.6, height: 0.1 }, {
    walk: ({ velocity, yaw_rate }) => does.push(`walk ${velocity} ${yaw_rate}`),
    stand: () => does.push("stand"), giveBack: () => does.push("give back"), tell: (text) => does.push(text),
  });
  return { input, does, hear: (canAct = true) => input.update(1, canAct) };
}

test("a stick at rest asks for nothing, one at its end for all", () => {
  assert.equal(beyondDeadZone(0.1), 0);
  assert.equal(beyondDeadZone(1), 1);
  assert.equal(beyondDeadZone(-1), -1);
});

test("within the dead zone nobody takes the command; beyond it sticks walk, and when let go they stand still once", () => {
  const pad = padOf({ axes: [0.1, -0.1, 0.11, 0] });
  const { does, hear } = playedBy(null, pad);
  for (let k = 0; k < 3; ++k) hear();
  assert.deepEqual(does, []);
  pad.axes = [1, -1, -1, 0];
  hear();
  hear();
  pad.axes = [0, 0, 0, 0];
  hear();
  hear();
  assert.deepEqual(does, ["walk 0.5,-0.25 0.6", "walk 0,0 0"]);
});

test("a stick that is held when its gamepad comes, or comes back, asks for nothing until it is let go", () => {
  const pad = padOf({ axes: [0, -1, 0, 0] });
  const { does, hear } = playedBy(pad);
  hear();
  assert.deepEqual(does, []);
  pad.axes = [0, 0, 0, 0];
  hear();
  pad.axes = [0, -1, 0, 0];
  hear();
  pad.connected = false;
  hear();
  hear();
  pad.connected = true;
  hear();
  assert.deepEqual(does, ["walk 0.5,0 0", "walk 0,0 0"]);
});

test("a gamepad whose layout is not known, and whose trigger looks like a stick, does nothing and is told once", () => {
  const odd = padOf({ mapping: "", id: "odd", axes: [0, 0, -1, 0] });
  const { does, hear } = playedBy(odd);
  hear();
  odd.axes = [0, 0, 0, 0];
  hear();
  odd.axes = [0, -1, -1, 0];
  hear();
  assert.equal(does.length, 1);
  assert.match(does[0] as string, /“odd” does nothing here/);
  const known = padOf();
  const both = playedBy(odd, known);
  both.hear();
  known.axes = [0, -1, 0, 0];
  both.hear();
  assert.deepEqual(both.does, ["walk 0.5,0 0"]);
});

test("who gives back or stands with a stick in the hand is heard, and letting go takes nothing again", () => {
  const pad = padOf();
  const { does, hear } = playedBy(pad);
  hear();
  pad.axes = [0, -1, 0, 0];
  hear();
  pad.buttons = [{ pressed: false }, { pressed: true }];
  hear();
  pad.axes = [0, -0.9, 0, 0];
  hear();
  pad.axes = [0, 0, 0, 0];
  hear();
  pad.buttons = [{ pressed: true }, { pressed: false }];
  hear();
  assert.deepEqual(does, ["walk 0.5,0 0", "give back", "stand"]);
});

test("where there is nothing to command it is silent; a stick that was let go meanwhile stands still afterwards", () => {
  const pad = padOf();
  const { does, hear } = playedBy(pad);
  hear(false);
  pad.axes = [0, -1, 0, 0];
  hear(false);
  pad.axes = [0, 0, 0, 0];
  hear();
  pad.axes = [0, -1, 0, 0];
  hear();
  hear(false);
  hear();
  hear(false);
  pad.axes = [0, 0, 0, 0];
  hear(false);
  hear();
  assert.deepEqual(does, ["walk 0.5,0 0", "walk 0.5,0 0", "walk 0,0 0"], "whether the first was heard is not known");
});

test("of a run that begins again nothing was asked: a stick still held is heard anew, one at rest takes nothing", () => {
  const pad = padOf();
  const { input, does, hear } = playedBy(pad);
  hear();
  pad.axes = [0, -1, 0, 0];
  hear();
  input.restart();
  hear();
  pad.axes = [0, 0, 0, 0];
  input.restart();
  hear();
  assert.deepEqual(does, ["walk 0.5,0 0", "walk 0.5,0 0"]);
});
