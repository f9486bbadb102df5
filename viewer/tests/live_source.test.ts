import assert from "node:assert/strict";
import { test } from "node:test";
import { marksOf } from "../src/data/marks.ts";
import { LiveSource, LIVE_SECONDS } from "../src/data/live_source.ts";
import type { Mark } from "../src/data/source.ts";
import { Player } from "../src/data/player.ts";
import { silenceOf } from "../src/protocol/connection.ts";
import { linkText, staleText, timeText } from "../src/panels/stale.ts";
import { schemaOf } from "./make.ts";

const PERIOD = 0.0025;

function filled(): LiveSource {
  const source = new LiveSource(schemaOf({ x: 1 }));
  source.follow(0);
  for (let tick = 0; tick < 1000; ++tick) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  return source;
}

test("a run that begins again is noticed once, whoever tells it, before its first tick", () => {
  const source = filled();
  let restarts = 0;
  source.onRestart = () => ++restarts;
  for (const begun of [0, 3, 3, 0]) source.follow(begun);
  assert.equal(restarts, 1);
  assert.ok(Number.isNaN(source.last));
  for (let tick = 0; tick < 3; ++tick) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  assert.equal(restarts, 1);
  assert.equal(source.at(1)?.tick, 2);
});

test("after a reset nothing is shown until the first tick, and then that, although one looked back", () => {
  const source = filled();
  const player = new Player(source, true);
  player.advance(0.016, 1);
  player.seek(1);
  source.follow(1);
  player.restart();
  assert.ok(player.following && player.playing);
  player.advance(0.016, 0);
  assert.equal(source.at(player.time), undefined);
  source.append(0, 0, Float32Array.of(7), undefined);
  player.advance(0.016, 0);
  assert.equal(source.at(player.time)?.tick, 0);
});

test("marks are what the program says happened, for as long as there are frames, and those of this run", () => {
  const source = new LiveSource(schemaOf({ x: 1 }));
  source.follow(0);
  const mark = (time: number): void => source.mark(...marksOf([[time, 1, "LH"], { time, kind: "mode", text: "command mode: hold" }], source.schema.events));
  for (const time of [5, 200]) source.append(time * 400, time, Float32Array.of(0), undefined);
  mark(1);
  mark(199);
  assert.deepEqual(source.marks, [{ time: 199, text: "lift-off", leg: "LH", kind: "event" }, { time: 199, text: "command mode: hold", leg: "", kind: "mode" }]);
  source.follow(1);
  assert.deepEqual(source.marks, []);
});

test("marks of one time stay in the order in which they came, each once", () => {
  const source = filled();
  const mark = (text: string): Mark => ({ time: 1, text, leg: "", kind: "change" });
  const texts = ["push of 4 N·s at LF_SHANK", "push of 3 N·s at base", "friction 0.5 → 0.4"];
  for (const text of [...texts, ...texts]) source.mark(mark(text));
  source.mark(...texts.map(mark));
  assert.deepEqual(source.marks.map(({ text }) => text), texts);
});

test("frames of a run before a reset are old, those of this run's first control are not", () => {
  const source = filled();
  source.follow(6);
  assert.deepEqual([5, 6, 7].map((one) => source.isOld(one)), [true, false, false]);
});

test("a program is silent when nothing came for three seconds", () => {
  assert.equal(silenceOf(10_000, 12_900), 0);
  assert.equal(silenceOf(10_000, 13_000), 3);
  assert.equal(silenceOf(10_000, 21_999), 11);
});

/** A page that came when the run was at `begins`, before a program that knows all ticks from `oldest` on. */
function opened(begins: number, oldest = 0): { source: LiveSource; asked: number[][]; goOn: (to: number) => void } {
  const source = new LiveSource(schemaOf({ x: 1 }, { period: PERIOD }));
  const asked: number[][] = [];
  source.begin(0, oldest, (first, ticks) => {
    asked.push([first, ticks]);
    const before = new LiveSource(source.schema);
    for (let tick = first; tick < first + ticks; ++tick) before.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
    return before;
  });
  let next = begins;
  const goOn = (to: number): void => {
    for (; next < to; ++next) source.append(next, next * PERIOD, Float32Array.of(next), undefined);
  };
  goOn(begins + 400);
  return { source, asked, goOn };
}

test("a page that comes late shows what was before it came", () => {
  const { source, asked } = opened(24000);
  assert.deepEqual(asked, [[0, 24001]]);
  assert.deepEqual([source.first, source.last], [0, 24399 * PERIOD]);
  for (const tick of [0, 4000, 23999, 24000, 24100]) assert.equal(source.at(tick * PERIOD)?.tick, tick);
  assert.equal(source.neighbour(23999 * PERIOD, 1), 24000 * PERIOD);
  assert.equal(source.neighbour(24000 * PERIOD, -1), 23999 * PERIOD);
  const seen: number[] = [];
  source.sample(23990 * PERIOD, 24010 * PERIOD, 1000, (frame) => seen.push(frame.tick));
  assert.deepEqual(seen, Array.from({ length: 21 }, (_, i) => 23990 + i));
});

test("a page looks back two minutes and no further, and forgets what was before it came when it has as much itself", () => {
  const { source, goOn } = opened(40000);
  goOn(60000);
  assert.ok(Math.abs(source.first - (source.last - LIVE_SECONDS)) < 1e-9);
  assert.equal(source.at(30000 * PERIOD)?.tick, 30000);
  goOn(100000);
  assert.equal(source.at(30000 * PERIOD)?.tick, Math.round(source.first / PERIOD), "the first that there is");
});

test("nothing is asked for where the page has all there is, and of a run before a reset nothing is left", () => {
  assert.deepEqual(opened(0).asked, []);
  assert.deepEqual(opened(500, 500).asked, []);
  const { source } = opened(24000);
  source.follow(1);
  source.append(0, 0, Float32Array.of(0), undefined);
  assert.deepEqual([source.first, source.last], [0, 0]);
  source.append(1, PERIOD, Float32Array.of(1), undefined);
  assert.equal(source.at(0)?.tick, 0);
});

test("what happened is known once, in the order of time, whoever tells it first", () => {
  const source = new LiveSource(schemaOf({ x: 1 }));
  const at = (time: number): Parameters<typeof source.mark>[0] => ({ time, text: "push", leg: "", kind: "change" });
  source.mark(at(7), at(8));
  source.mark(at(1), at(7));
  assert.deepEqual(source.marks.map(({ time }) => time), [1, 7, 8]);
});

test("a page that was away learns of a reset meanwhile, and keeps what happened where there was none", () => {
  const { source } = opened(400);
  source.mark({ time: 1.5, text: "push", leg: "", kind: "change" });
  let restarts = 0;
  source.onRestart = () => ++restarts;
  const nothing = (): LiveSource => new LiveSource(source.schema);
  source.begin(0, 0, nothing);
  assert.deepEqual([restarts, source.marks.length], [0, 1]);
  source.begin(7, 0, nothing);
  assert.deepEqual([restarts, source.marks.length], [1, 0]);
});

test("a page that was there at a reset keeps what happened after it when the connection is lost", () => {
  const { source } = opened(400);
  let restarts = 0;
  source.onRestart = () => ++restarts;
  source.follow(7);
  source.append(0, 0, Float32Array.of(0), undefined);
  source.mark({ time: 1.5, text: "push", leg: "", kind: "change" });
  source.begin(7, 0, () => new LiveSource(source.schema));
  assert.deepEqual([restarts, source.marks.length], [1, 1]);
});

test("why there are no numbers is said above them", () => {
  const link = { state: "connecting", silence: 0, quiet: 0, reason: "" } as const;
  assert.equal(linkText(link, NaN), "Connecting to the program …");
  assert.equal(linkText({ ...link, silence: 3 }, NaN), "No numbers yet: the program does not answer.");
  assert.equal(linkText({ ...link, state: "lost", reason: "8 pages watch already" }, NaN), "No numbers here: 8 pages watch already.");
  assert.equal(linkText({ ...link, state: "open" }, NaN), "");
  assert.equal(linkText({ ...link, state: "open" }, 1), "");
  assert.equal(linkText({ ...link, state: "open", silence: 4, quiet: 4 }, 1), staleText(4));
});

test("old numbers say how old they are", () => {
  assert.equal(staleText(7) + timeText(12.3051), "Nothing new for 7 s: all numbers are from 12.3051 s of the run.");
});
