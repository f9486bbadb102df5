import assert from "node:assert/strict";
import { test } from "node:test";
import { Envelope } from "../src/data/envelope.ts";
import { Holes } from "../src/data/holes.ts";
import { LiveSource } from "../src/data/live_source.ts";
import { blockOf, randomNumbers, schemaOf } from "./make.ts";

const PERIOD = 0.0025;
const schema = schemaOf({ x: 1 }, { period: PERIOD });
const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

/** A page that lost some ticks of a run, and a program that has all of them but `never`. */
function lossy(ticks: number, isLost: (tick: number) => boolean, never: (tick: number) => boolean = () => false) {
  const clock = { now: 0, asked: [] as number[][], refuses: false };
  const source = new LiveSource(schema, () => clock.now);
  source.fetchTicks = async (first, count) => {
    clock.asked.push([first, count]);
    if (clock.refuses) throw new Error("no answer");
    const has = Array.from({ length: count }, (_, k) => first + k).filter((tick) => !never(tick));
    return blockOf(has.map((tick) => ({ tick, time: tick * PERIOD, values: [tick] })));
  };
  let next = 0;
  const goOn = (to: number): void => {
    for (; next < to; ++next) if (!isLost(next)) source.append(next, next * PERIOD, Float32Array.of(next), undefined);
  };
  goOn(ticks);
  const look = async (from: number, to: number): Promise<(number | null)[]> => {
    const columns = (): (number | null)[] => {
      const envelope = new Envelope(from * PERIOD, to * PERIOD, 100, 1);
      source.fill(envelope, [{ channel: "x", index: 0 }]);
      return envelope.columns()[1] as (number | null)[];
    };
    for (let times = 0; times < 200; ++times) {
      columns();
      await settled();
    }
    return columns();
  };
  const seen = (from: number, to: number): number[] => {
    const found: number[] = [];
    source.sample(from * PERIOD, (to - 1) * PERIOD, Infinity, (frame) => found.push(frame.tick));
    return found;
  };
  return { source, clock, goOn, look, seen };
}

const range = (from: number, to: number): number[] => Array.from({ length: to - from }, (_, k) => from + k);

test("what a page lost is asked for where it is looked at, and only that", async () => {
  const { look, seen, clock, source } = lossy(8000, (tick) => (tick >= 1000 && tick < 2500) || (tick >= 5000 && tick < 5010));
  clock.now = 5000;
  assert.equal((await look(0, 4000)).filter((value) => value === null).length, 0);
  assert.deepEqual(seen(0, 5000), range(0, 5000));
  assert.deepEqual(clock.asked.reduce((sum, [, count]) => sum + (count as number), 0), 1500);
  assert.equal(source.at(1234 * PERIOD)?.tick, 1234);
  assert.equal(source.neighbour(999 * PERIOD, 1), 1000 * PERIOD);
  assert.equal(source.neighbour(2500 * PERIOD, -1), 2499 * PERIOD);
});

test("whatever was lost, all of it is there when all was looked at, in its order, and frames go on behind it", async () => {
  for (const seed of [1, 2, 3, 4, 5]) {
    const random = randomNumbers(seed);
    const lost = new Set<number>();
    for (let tick = 1; tick < 5990; ) {
      const size = 1 + Math.floor(random() ** 3 * 700);
      if (random() < 0.5) for (let k = 0; k < size && tick + k < 5990; ++k) lost.add(tick + k);
      tick += size;
    }
    const { look, seen, clock, goOn } = lossy(6000, (tick) => lost.has(tick));
    clock.now = 5000;
    await look(0, 6000);
    goOn(6500);
    assert.deepEqual(seen(0, 6500), range(0, 6500), `seed ${seed}`);
  }
});

test("of what is newest nothing is asked for while ticks are being lost, of what lies back it is", async () => {
  const { look, clock } = lossy(4000, (tick) => (tick >= 1000 && tick < 1100) || (tick >= 3900 && tick < 3990));
  clock.now = 500;
  await look(3600, 4000);
  assert.deepEqual(clock.asked, []);
  await look(900, 1200);
  assert.deepEqual(clock.asked, [[1000, 100]]);
  clock.now = 1500;
  await look(3600, 4000);
  assert.deepEqual(clock.asked.slice(1), [[3900, 90]]);
});

test("what the program has not either is asked for once, what it did not answer again after a while", async () => {
  const { look, clock } = lossy(4000, (tick) => tick >= 1000 && tick < 1100, (tick) => tick >= 1050 && tick < 1090);
  clock.now = 5000;
  clock.refuses = true;
  await look(900, 1200);
  assert.equal(clock.asked.length, 1);
  clock.now = 7000;
  clock.refuses = false;
  assert.equal((await look(900, 1200)).filter((value) => value === null).length, 1);
  assert.equal(clock.asked.length, 2);
});

test("an answer that comes after a reset is of another run", async () => {
  const { source, clock, seen } = lossy(4000, (tick) => tick >= 1000 && tick < 1100);
  source.follow(0);
  clock.now = 5000;
  source.at(1050 * PERIOD);
  source.follow(1);
  for (const tick of range(0, 50)) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  for (const tick of range(2000, 2050)) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  await settled();
  assert.deepEqual(seen(0, 3000), [...range(0, 50), ...range(2000, 2050)]);
});

test("a piece is taken from what is looked at, and the rest of a hole stays", () => {
  const holes = new Holes();
  holes.add(100, 2000);
  assert.deepEqual(holes.take(500, 600, 512), { first: 100, end: 612 });
  assert.deepEqual(holes.take(1000, 1500, 512), { first: 988, end: 1500 });
  assert.equal(holes.take(0, 612, 512), undefined);
  holes.forget(988);
  assert.equal(holes.take(0, 1400, 512), undefined);
  assert.deepEqual(holes.take(0, 1600, 512), { first: 1500, end: 2000 });
});
