import assert from "node:assert/strict";
import { test } from "node:test";
import { marksOf } from "../src/data/marks.ts";
import { nudged, type Walk } from "../src/panels/drive_panel.ts";
import { Commands } from "../src/protocol/commands.ts";
import { backoff, type Connection } from "../src/protocol/connection.ts";

function connectionOf(open = true, silence = 0): { connection: Connection; sent: Record<string, unknown>[] } {
  const sent: Record<string, unknown>[] = [];
  const connection = { silence, send: (message: Record<string, unknown>) => open && sent.push(message) > 0 } as unknown as Connection;
  return { connection, sent };
}

test("a command carries the token and ends with the server's answer", async () => {
  const { connection, sent } = connectionOf();
  const commands = new Commands(connection, "secret");
  const answer = commands.send("speed", { factor: 2 });
  assert.deepEqual(sent, [{ type: "speed", factor: 2, token: "secret", id: 1 }]);
  commands.reply({ type: "reply", id: 1, ok: true });
  await answer;
});

test("a refusal is an error with the server's words", async () => {
  const commands = new Commands(connectionOf().connection, "secret");
  const answer = commands.send("speed", { factor: 99 });
  commands.reply({ type: "reply", id: 1, ok: false, error: "99 is no speed" });
  await assert.rejects(answer, /99 is no speed/);
});

test("without a token nothing is sent", async () => {
  const { connection, sent } = connectionOf();
  await assert.rejects(new Commands(connection, "").send("pause"), /can only look/);
  assert.equal(sent.length, 0);
});

test("of a token that the program does not know is told once, and nothing more is sent with it", async () => {
  const { connection, sent } = connectionOf();
  const commands = new Commands(connection, "of an earlier start");
  let told = 0;
  commands.onRefused = () => ++told;
  commands.greet();
  const answer = commands.send("pause");
  for (const id of [1, 2]) commands.reply({ type: "reply", id, ok: false, error: "commands need the token", token: false });
  await assert.rejects(answer, /need the token/);
  assert.ok(!commands.allowed);
  await assert.rejects(commands.send("pause"), /can only look/);
  commands.greet();
  assert.deepEqual([told, sent.map(({ type }) => type)], [1, ["hello", "pause"]]);
});

test("a program that does not answer is asked nothing that it would do whenever it goes on", async () => {
  const { connection, sent } = connectionOf(true, 5);
  await assert.rejects(new Commands(connection, "secret").send("push"), /does not answer, so it was not asked/);
  assert.equal(sent.length, 0);
});

test("what waits when the connection is lost ends with an error", async () => {
  const commands = new Commands(connectionOf().connection, "secret");
  const answer = commands.send("pause");
  commands.lost();
  await assert.rejects(answer, /lost/);
  await assert.rejects(new Commands(connectionOf(false).connection, "secret").send("pause"), /no connection/);
});

test("attempts to connect come ever later, but never later than in 5 s", () => {
  assert.deepEqual([0, 1, 2, 9].map(backoff), [250, 500, 1000, 5000]);
});

test("what is asked to walk changes by steps and stays within its limits", () => {
  let walk: Walk = { walk: false, forward: 0, left: 0, turn: 0, height: 0, gait: "trot" };
  const limits = { forward: 0.15, left: 0.1, turn: 0.3, height: 0.05 };
  for (let k = 0; k < 99; ++k) walk = nudged(walk, "forward", 1, limits);
  assert.deepEqual(walk, { walk: true, forward: 0.15, left: 0, turn: 0, height: 0, gait: "trot" });
  assert.deepEqual(nudged(walk, "turn", -1, limits).turn, -0.02);
  assert.deepEqual(walk.turn, 0, "what was asked before stays as it was");
});

test("marks of a log come with names for numbers", () => {
  const raw = [[1, 1, "LF"], [2, 7, null], { time: 3, text: "hold" }] as Parameters<typeof marksOf>[0];
  assert.deepEqual(marksOf(raw, ["none", "lift-off"]).map(({ time, text, leg }) => [time, text, leg]), [[1, "lift-off", "LF"], [2, "event 7", ""], [3, "hold", ""]]);
});
