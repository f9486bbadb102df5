import assert from "node:assert/strict";
import { mock, test } from "node:test";
import type { App } from "../src/app.ts";
import { LiveSource } from "../src/data/live_source.ts";
import { LiveLink } from "../src/live_link.ts";
import { PROTOCOL, type Session } from "../src/protocol/session.ts";
import { fakePage } from "./fake_page.ts";
import { fakeSockets, type FakeSocket } from "./fake_socket.ts";
import { blockOf, schemaOf } from "./make.ts";

const PERIOD = 0.0025;

function sessionOf(more: Partial<Session> = {}): Session {
  const header = { robot: { mass: 30 }, level_names: [], level_units: [], event_names: [] };
  return {
    protocol: PROTOCOL, start: "this one", generation: 0, begun: 0, first_tick: 0, period: PERIOD, frame_floats: 1, header,
    channels: [{ name: "x", unit: "", about: "", size: 1, offset: 0 }], orders: [], rows: [], bodies: [], limits: {}, ...more,
  } as unknown as Session;
}

/** A page that looks at a run, the program that it asks, and what the page says. */
function watching() {
  mock.timers.enable({ apis: ["setInterval", "setTimeout"] });
  fakePage();
  const program = { session: sessionOf(), events: [] as object[], fails: false, asked: [] as string[], loads: 0, answer: undefined as Promise<void> | undefined };
  const fetchFrom = async (url: string): Promise<Response> => {
    program.asked.push(url);
    const { fails } = program;
    await program.answer;
    return new Response(fails ? "too many connections" : JSON.stringify(url === "/api/events" ? program.events : program.session), { status: fails ? 503 : 200 });
  };
  const location = { protocol: "http:", host: "here", reload: () => ++program.loads };
  for (const [name, value] of Object.entries({ location, fetch: fetchFrom })) Object.defineProperty(globalThis, name, { value, configurable: true });
  const sockets = fakeSockets();
  const said: string[] = [], kept: string[] = [];
  const { session } = program, pictures = { pictures: 0 };
  const source = new LiveSource(schemaOf({ x: 1 }, { period: PERIOD }));
  const link = new LiveLink(source, session);
  const nothing = (): void => {};
  const parts = { commands: { greet: nothing, lost: nothing }, tune: { showStatus: nothing }, drive: { show: nothing } };
  link.wire(Object.assign(pictures, { ...parts, notes: { say: (text: string) => said.push(text), keep: (_: string, text: string) => kept.push(text), take: nothing }, letCommand: nothing, refresh: nothing, use: nothing, restart: nothing }) as unknown as App);
  const newest = (): FakeSocket => sockets.at(-1) as FakeSocket;
  const hear = (tick: number, generation = 0): void => newest().hear(blockOf([{ tick, time: tick * PERIOD, values: [tick] }], 0, generation));
  return { program, source, link, said, kept, newest, hear, pictures };
}

/** What was asked is answered by now. */
async function answered(): Promise<void> {
  for (let k = 0; k < 50; ++k) await Promise.resolve();
  await new Promise((resolve) => setImmediate(resolve));
}

async function pass(ms: number): Promise<void> {
  mock.timers.tick(ms);
  await answered();
}

const loseAndFind = async ({ newest }: ReturnType<typeof watching>): Promise<void> => {
  newest().onclose?.({ reason: "" });
  await pass(1000);
};

test("another program that comes back is found, however often it can't say at first what it shows", async (t) => {
  t.after(() => mock.timers.reset());
  const page = watching();
  const { program, source, said, hear } = page;
  hear(7);
  await answered();
  program.fails = true;
  await loseAndFind(page);
  hear(0);
  await answered();
  assert.deepEqual([source.last, program.loads], [7 * PERIOD, 0], "its frames are not taken for those of the run before");
  assert.ok(!said.includes("Connected again."));
  program.session = sessionOf({ start: "another" });
  program.fails = false;
  await pass(1500);
  assert.equal(program.loads, 1);
});

test("the same program that comes back tells what happened meanwhile, and goes on", async (t) => {
  t.after(() => mock.timers.reset());
  const page = watching();
  const { program, source, said, hear } = page;
  hear(7);
  await answered();
  program.events = [{ time: 0.02, kind: "change", text: "friction 0.5 → 0.4" }];
  await loseAndFind(page);
  hear(9);
  await answered();
  assert.deepEqual([source.last, said, source.marks.map(({ text }) => text)], [9 * PERIOD, ["Connected again."], ["friction 0.5 → 0.4"]]);
});

test("what happened in a run that was reset meanwhile is not told of the one that goes on", async (t) => {
  t.after(() => mock.timers.reset());
  const { program, source, newest } = watching();
  let answer: () => void = () => {};
  program.answer = new Promise((resolve) => (answer = resolve));
  program.events = [{ time: 3, kind: "change", text: "friction 0.5 → 0.4" }];
  newest().hear({ type: "notice", text: "hello" });
  await answered();
  assert.deepEqual(program.asked, ["/api/events"]);
  source.follow(4);
  answer();
  await answered();
  assert.deepEqual(source.marks, []);
});

test("a program that waits hears that the robot is drawn, and a connection after it, too", async (t) => {
  t.after(() => mock.timers.reset());
  const page = watching();
  page.hear(0);
  assert.deepEqual(page.newest().sent, [], "there is no picture yet");
  page.pictures.pictures = 1;
  page.link.reportDrawn();
  assert.deepEqual(page.newest().sent, [{ type: "drawn" }]);
  await loseAndFind(page);
  page.hear(1);
  assert.deepEqual(page.newest().sent, [{ type: "drawn" }]);
});

test("frames of before a change of the control do not ask for the session again", async (t) => {
  t.after(() => mock.timers.reset());
  const { program, source, hear } = watching();
  program.session = sessionOf({ generation: 2 });
  hear(0, 2);
  await answered();
  const { length } = program.asked;
  hear(1, 1);
  await answered();
  assert.deepEqual([source.last, program.asked.length], [PERIOD, length]);
});

test("what can't be read is told, and what comes behind it is read", async (t) => {
  t.after(() => mock.timers.reset());
  const { source, said, kept, newest, hear } = watching();
  hear(7);
  await answered();
  for (const data of ["no JSON", "null", "{}", new ArrayBuffer(3)]) newest().onmessage?.({ data });
  hear(8);
  const wrong = "what the program said is no message: program and page are of different versions, load the page again";
  assert.deepEqual([said, kept], [[wrong, wrong, wrong], ["what came is no block of frames: program and page are of different versions, load the page again"]]);
  assert.equal(source.last, 8 * PERIOD);
});

test("a change that comes to effect is told and has a mark, other events have a mark alone", async (t) => {
  t.after(() => mock.timers.reset());
  const { source, said, newest, hear } = watching();
  hear(7);
  await answered();
  newest().hear({ type: "events", events: [{ time: 0.02, kind: "change", text: "friction 0.5 → 0.4" }, { time: 0.02, kind: "mode", text: "command mode: hold" }] });
  assert.deepEqual([said, source.marks.map(({ kind }) => kind)], [["friction 0.5 → 0.4"], ["change", "mode"]]);
});
