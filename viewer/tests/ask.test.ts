import assert from "node:assert/strict";
import { test } from "node:test";
import { ask, askUntilAnswered, NoAnswer, textOf } from "../src/protocol/ask.ts";

const gone = (): Promise<Response> => Promise.reject(new TypeError("Failed to fetch"));

test("where there is no server, the error says so", async () => {
  await assert.rejects(ask("/api/frames", gone), NoAnswer);
});

test("a connection that breaks within an answer is no answer either", async () => {
  const broken = { ok: true, arrayBuffer: () => Promise.reject(new TypeError("network error")) } as unknown as Response;
  await assert.rejects(ask("/api/frames", () => Promise.resolve(broken)), NoAnswer);
});

test("a refusal is told in the server's words", async () => {
  const refuse = (text: string) => () => Promise.resolve(new Response(text, { status: 404 }));
  await assert.rejects(ask("/x", refuse("there is no such mesh\n")), /^Error: there is no such mesh$/);
  await assert.rejects(ask("/x", refuse("")), /404/);
});

test("what is asked for while the server is away comes when it is back", async () => {
  let calls = 0;
  let waits = 0;
  const later = (): Promise<Response> => (++calls < 3 ? gone() : Promise.resolve(new Response("mesh")));
  const wait = (): Promise<void> => Promise.resolve(void ++waits);
  assert.equal(textOf(await askUntilAnswered("/api/mesh/1", wait, later)), "mesh");
  assert.equal(waits, 2);
  await assert.rejects(askUntilAnswered("/x", wait, () => Promise.resolve(new Response("gone", { status: 404 }))), /gone/);
});
