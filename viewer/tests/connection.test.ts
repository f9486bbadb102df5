import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { Connection } from "../src/protocol/connection.ts";
import { FakeSocket, fakeSockets } from "./fake_socket.ts";

test("a connection that brings nothing any more is given up for a new one, which takes its place", () => {
  mock.timers.enable({ apis: ["setInterval", "setTimeout"] });
  let now = 0;
  mock.method(performance, "now", () => now);
  const pass = (seconds: number): void => {
    for (let k = 0; k < seconds; ++k) {
      now += 1000;
      mock.timers.tick(1000);
    }
  };
  const sockets = fakeSockets();
  const connection = new Connection("ws://here/api/live");
  const states: string[] = [];
  connection.onState = (state) => states.push(state);
  connection.open();
  const first = sockets[0] as FakeSocket;
  first.hear({ type: "notice" });
  pass(15);
  first.hear({ type: "notice" });
  pass(15);
  assert.deepEqual([sockets.length, first.isClosed, states], [1, false, ["open"]]);
  pass(10);
  assert.deepEqual([sockets.length, first.isClosed, states], [2, true, ["open", "connecting"]]);
  assert.ok(connection.silence >= 20, "and as long nothing is heard");
  pass(60);
  assert.equal(sockets.length, 2, "one that is being opened has its time");
  sockets[1]?.hear({ type: "notice" });
  assert.deepEqual([connection.state, connection.silence], ["open", 0]);
  mock.reset();
  mock.timers.reset();
});
