import assert from "node:assert/strict";
import { test } from "node:test";
import { Envelope } from "../src/data/envelope.ts";
import { ReplaySource } from "../src/data/replay_source.ts";
import { TILE_FRAMES } from "../src/data/tiles.ts";
import { readBlock } from "../src/protocol/block.ts";
import { blockOf, schemaOf, type RawFrame } from "./make.ts";

const PERIOD = 0.0025;
const TICKS = 20000;
const SPIKE = 7777;
const schema = schemaOf({ x: 1 });
const valueAt = (tick: number): number => (tick === SPIKE ? 1000 : tick % 7);

/** A server of a log, as viewer/README.md has it. */
function server(): { fetchBlock: (url: string) => Promise<ArrayBuffer>; urls: string[] } {
  const urls: string[] = [];
  const fetchBlock = (url: string): Promise<ArrayBuffer> => {
    urls.push(url);
    const query = new URLSearchParams(url.slice(url.indexOf("?")));
    const [from, count, stride] = ["from", "count", "stride"].map((name) => Number(query.get(name))) as [number, number, number];
    const frames: RawFrame[] = [];
    for (let tick = from; tick < TICKS && frames.length < count; tick += stride) {
      const span = Array.from({ length: query.has("min_max") ? Math.min(stride, TICKS - tick) : 1 }, (_, k) => valueAt(tick + k));
      const frame = (value: number): RawFrame => ({ tick, time: tick * PERIOD, values: [value] });
      frames.push(frame(Math.min(...span)));
      if (query.has("min_max")) frames.push(frame(Math.max(...span)));
    }
    return Promise.resolve(blockOf(frames));
  };
  return { fetchBlock, urls };
}

async function settled(source: ReplaySource): Promise<void> {
  for (let k = 0; k < 1000 && source.cache.pending > 0; ++k) await new Promise((resolve) => setTimeout(resolve, 1));
  assert.equal(source.cache.pending, 0);
}

test("any tick of a log is shown once its piece has come", async () => {
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, server().fetchBlock);
  for (const tick of [0, 1, TILE_FRAMES - 1, TILE_FRAMES, SPIKE, TICKS - 1]) {
    source.at(tick * PERIOD);
    await settled(source);
    assert.equal(source.at(tick * PERIOD)?.tick, tick);
  }
});

test("ticks that can't be read are told, another stands for them, and steps go on over them", async () => {
  const [from, to] = [300, 1800]; // one piece has nothing, two have some of theirs
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, async (url) => {
    const frames: RawFrame[] = [];
    readBlock(await server().fetchBlock(url), 1, (tick, time, values) => {
      if (tick < from || tick >= to) frames.push({ tick, time, values: [...values] });
    });
    return blockOf(frames);
  });
  const look = async (tick: number): Promise<void> => {
    source.at(tick * PERIOD);
    await settled(source);
  };
  for (let tick = 0; tick < 3000; tick += TILE_FRAMES) await look(tick);
  for (const tick of [0, from - 1, to, 2999]) assert.ok(!source.isUnreadable(tick * PERIOD), `${tick}`);
  for (const tick of [from, 600, 1100, to - 1]) assert.ok(source.isUnreadable(tick * PERIOD), `${tick}`);
  assert.equal(source.at((from + 5) * PERIOD)?.tick, from - 1);
  assert.equal(source.neighbour((from - 1) * PERIOD, 1), to * PERIOD);
  assert.equal(source.neighbour(1000 * PERIOD, 1), to * PERIOD);
  assert.equal(source.neighbour(to * PERIOD, -1), (from - 1) * PERIOD);
  assert.equal(source.neighbour(5 * PERIOD, 1), 6 * PERIOD);
});

test("until then the nearest frame of an overview stands for it", async () => {
  const { fetchBlock } = server();
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, fetchBlock);
  source.at(0);
  await settled(source);
  const far = source.at(30);
  assert.ok(far !== undefined && Math.abs(far.time - 30) < 0.11, `${far?.time}`);
});

test("a plot of a whole log shows a spike of one tick, from a few requests", async () => {
  const { fetchBlock, urls } = server();
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, fetchBlock);
  const envelopeOf = (): Envelope => {
    const envelope = new Envelope(source.first, source.last, 250, 1);
    source.fill(envelope, [{ channel: "x", index: 0 }]);
    return envelope;
  };
  envelopeOf();
  await settled(source);
  assert.equal(Math.max(...(envelopeOf().columns()[1] as number[])), 1000);
  assert.ok(urls.length <= 3, `${urls.length} requests`);
});

test("memory for a log is bounded: what was not looked at for long is asked for again", async () => {
  const { fetchBlock, urls } = server();
  const source = new ReplaySource(schemaOf({ x: 1 }), PERIOD, 0, 10 ** 9, (url) => fetchBlock(url.replace(/from=\d+/, "from=0")));
  const capacity = Math.floor(160e6 / (TILE_FRAMES * 20));
  const piece = (index: number): void => void source.cache.get({ stride: 1, index, minMax: false });
  for (let index = 0; index <= capacity; ++index) {
    piece(index);
    if (index % 20 === 0) await settled(source);
  }
  await settled(source);
  const before = urls.length;
  piece(capacity);
  assert.equal(urls.length, before);
  piece(0);
  await settled(source);
  assert.equal(urls.length, before + 1);
});

test("a piece that could not be had is asked for again, and the reason is told", async () => {
  const { fetchBlock } = server();
  let fails = 1;
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, (url) => (fails-- > 0 ? Promise.reject(new Error("the log is damaged there")) : fetchBlock(url)));
  const reasons: string[] = [];
  source.cache.onError = (error) => reasons.push(error.message);
  source.cache.get({ stride: 1, index: 0, minMax: false });
  await new Promise((resolve) => setTimeout(resolve, 1100));
  assert.deepEqual(reasons, ["the log is damaged there"]);
  source.cache.get({ stride: 1, index: 0, minMax: false });
  await settled(source);
  assert.equal(source.cache.get({ stride: 1, index: 0, minMax: false })?.size, TILE_FRAMES);
});

test("an overview that was on its way while more was summarised is asked for again, and stands until that comes", async () => {
  let known = 6000;
  const answers: (() => void)[] = [];
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, () => {
    const frames: RawFrame[] = [];
    for (let tick = 0; tick < known; tick += 40) frames.push({ tick, time: tick * PERIOD, values: [0] });
    return new Promise((resolve) => answers.push(() => resolve(blockOf(frames))));
  });
  const key = { stride: 64, index: 0, minMax: true };
  const lastOf = (): number | undefined => source.cache.get(key)?.last;
  const answer = async (): Promise<void> => {
    answers.shift()?.();
    await new Promise((resolve) => setTimeout(resolve, 1));
  };
  source.summarise(known);
  lastOf();
  known = TICKS;
  source.summarise(known);
  await answer();
  assert.equal(lastOf(), 5960 * PERIOD, "what has come by now");
  assert.equal(lastOf(), 5960 * PERIOD);
  assert.equal(answers.length, 1, "asked for once more");
  await answer();
  assert.equal(lastOf(), 19960 * PERIOD);
  assert.equal(answers.length, 0);
});

test("an overview that came before all of it was summarised is asked for again", async () => {
  let known = 6000;
  const source = new ReplaySource(schema, PERIOD, 0, TICKS, (url) => {
    if (/stride=1$/.test(url)) return new Promise(() => {}); // never comes
    const frames: RawFrame[] = [];
    for (let tick = 0; tick < known; tick += 40) frames.push({ tick, time: tick * PERIOD, values: [0] });
    return Promise.resolve(blockOf(frames));
  });
  const ask = async (): Promise<number | undefined> => {
    source.at(40);
    for (let k = 0; k < 20; ++k) await new Promise((resolve) => setTimeout(resolve, 1));
    return source.at(40)?.tick;
  };
  source.summarise(known);
  assert.equal(await ask(), undefined, "not a frame from far away");
  known = TICKS;
  source.summarise(known);
  assert.equal(await ask(), 16000);
});
