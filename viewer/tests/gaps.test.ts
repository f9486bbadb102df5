import assert from "node:assert/strict";
import { test } from "node:test";
import { Envelope } from "../src/data/envelope.ts";
import { fillFrom, LiveSource } from "../src/data/live_source.ts";
import { FrameTable } from "../src/data/table.ts";
import { schemaOf } from "./make.ts";

const PERIOD = 0.0025;
const schema = schemaOf({ x: 1 }, { period: PERIOD });

function plotted(ticks: number[], from: number, to: number, buckets: number): (number | null)[] {
  const source = new LiveSource(schema);
  for (const tick of ticks) source.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  const envelope = new Envelope(from, to, buckets, 1);
  source.fill(envelope, [{ channel: "x", index: 0 }]);
  return envelope.columns()[1] as (number | null)[];
}

const all = Array.from({ length: 4000 }, (_, tick) => tick);
const breaks = (line: (number | null)[]): number => line.filter((value) => value === null).length;

test("a line breaks once where ticks were lost", () => {
  const line = plotted(all.filter((tick) => tick < 1000 || tick > 2500), 0, 10, 200);
  assert.equal(breaks(line), 1);
  const at = line.indexOf(null);
  assert.equal(line[at - 1], 999);
  assert.equal(line[at + 1], 2501);
});

test("a line that is whole, or lacks a single tick, does not break, however near one looks", () => {
  for (const to of [10, 1, 0.02]) {
    assert.equal(breaks(plotted(all, 0, to, 200)), 0);
    assert.equal(breaks(plotted(all.filter((tick) => tick !== 4), 0, to, 200)), 0);
  }
});

test("a log's summary with fewer frames than were asked for is no row of gaps", () => {
  const table = new FrameTable(schema, 400);
  for (let k = 0; k < 400; ++k) {
    const tick = k < 200 ? 128 * k : 128 * (k + 40);
    table.append(tick, tick * PERIOD, Float32Array.of(tick), undefined);
  }
  const envelope = new Envelope(0, table.last, 2000, 1);
  fillFrom(table, 0, table.size, envelope, [{ channel: "x", index: 0 }], 32 * PERIOD);
  assert.equal(breaks(envelope.columns()[1] as (number | null)[]), 1);
});

test("frames of which nothing is known are a gap", () => {
  const table = new FrameTable(schema, 400);
  for (let k = 0; k < 400; ++k) table.append(k, k * PERIOD, Float32Array.of(k > 100 && k < 200 ? NaN : k), undefined);
  const envelope = new Envelope(0, table.last, 100, 1);
  fillFrom(table, 0, table.size, envelope, [{ channel: "x", index: 0 }], PERIOD);
  assert.equal(breaks(envelope.columns()[1] as (number | null)[]), 1);
});
