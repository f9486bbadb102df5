import assert from "node:assert/strict";
import { mock, test, type TestContext } from "node:test";
import type { App } from "../src/app.ts";
import { PROTOCOL, type Session } from "../src/protocol/session.ts";
import { ReplayLink } from "../src/replay_link.ts";
import { fakePage } from "./fake_page.ts";
import { schemaOf } from "./make.ts";

const PERIOD = 0.0025;

function sessionOf(start: string, summarised: number): Session {
  const header = { level_names: [], level_units: [], event_names: [] };
  return {
    protocol: PROTOCOL, start, mode: "replay", first_tick: 0, ticks: 800, summarised, period: PERIOD, frame_floats: 1, header, ended: "", cut: "",
    channels: [{ name: "x", unit: "", about: "", size: 1, offset: 0 }], orders: [], damage: [], rows: [], bodies: [],
  } as unknown as Session;
}

/** What was asked is answered by now. */
async function answered(): Promise<void> {
  for (let k = 0; k < 50; ++k) await Promise.resolve();
  await new Promise((resolve) => setImmediate(resolve));
}

/** A page that looks at a log, and the program that serves it. */
async function looking(t: TestContext, summarised: number) {
  mock.timers.enable({ apis: ["setTimeout"] });
  t.after(() => mock.timers.reset());
  fakePage();
  const program = { session: sessionOf("this one", summarised), status: 200, loads: 0 };
  const fetchFrom = async (url: string): Promise<Response> => {
    const { session, status } = program;
    const text = url === "/api/alive" ? `${session.start}\n` : JSON.stringify(url === "/api/events" ? [] : session);
    return new Response(status === 200 ? text : "too many connections", { status });
  };
  const location = { reload: () => ++program.loads };
  for (const [name, value] of Object.entries({ location, fetch: fetchFrom })) Object.defineProperty(globalThis, name, { value, configurable: true });
  const link = new ReplayLink(schemaOf({ x: 1 }, { period: PERIOD }), program.session);
  const nothing = (): void => {};
  link.wire({ notes: { keep: nothing, take: nothing, say: nothing }, refresh: nothing } as unknown as App);
  await answered();
  const pass = async (ms: number): Promise<void> => {
    mock.timers.tick(ms);
    await answered();
  };
  return { program, pass };
}

test("another program in the place of the one before is noticed, however quickly it came", async (t) => {
  const { program, pass } = await looking(t, 800);
  await pass(2000);
  assert.equal(program.loads, 0, "it is the same");
  program.session = sessionOf("another", 800);
  await pass(2000);
  assert.equal(program.loads, 1);
});

test("one that can't say just now which it is, is not taken for another", async (t) => {
  const { program, pass } = await looking(t, 800);
  program.status = 503;
  await pass(2000);
  assert.equal(program.loads, 0);
  program.status = 200;
  await pass(2000);
  assert.equal(program.loads, 0);
});

test("of another log nothing is taken for a part of this one while it is being read", async (t) => {
  const { program, pass } = await looking(t, 64);
  program.session = sessionOf("another", 800);
  await pass(700);
  assert.equal(program.loads, 1);
});
