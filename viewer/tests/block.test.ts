import assert from "node:assert/strict";
import { test } from "node:test";
import { FrameTable } from "../src/data/table.ts";
import { readBlock, readBlockHead } from "../src/protocol/block.ts";
import { blockOf, randomNumbers, schemaOf, type RawFrame } from "./make.ts";

const schema = schemaOf({ a: 2, b: 1 });

function tableOf(buffer: ArrayBuffer): FrameTable {
  const table = new FrameTable(schema, 64);
  readBlock(buffer, schema.frameFloats, (...frame) => table.append(...frame));
  return table;
}

test("what is written into a block is read from it", () => {
  const random = randomNumbers(1);
  const whole = (most: number): number => Math.floor(random() * most);
  for (let run = 0; run < 200; ++run) {
    const frames: RawFrame[] = Array.from({ length: whole(6) }, (_, k) => ({
      tick: k, time: 0.0025 * k, values: [random(), random(), random()].map(Math.fround),
      active: Array.from({ length: whole(4) }, () => [whole(9), [-3, -1, 1, 3][whole(4)] as number, whole(60000), Math.fround(random())]),
      blocking: Array.from({ length: whole(3) }, () => [whole(9), whole(9), whole(60000), Math.fround(random())]),
    }));
    const table = tableOf(blockOf(frames, 7, 3));
    assert.equal(table.size, frames.length);
    frames.forEach((frame, i) => {
      const read = table.frame(i);
      assert.equal(read.tick, frame.tick);
      assert.equal(read.time, frame.time);
      assert.deepEqual([...read.values], frame.values);
      assert.deepEqual(read.active.map((row) => [row.level, row.state, row.row, row.by]), frame.active);
      assert.deepEqual(read.blocking.map((row) => [row.level, row.by, row.row, row.cost]), frame.blocking);
    });
  }
});

test("a block's head says how many ticks were lost, and the stack's generation", () => {
  assert.deepEqual(readBlockHead(blockOf([], 7, 3)), { frames: 0, dropped: 7, generation: 3 });
});

test("a number that is not known stays so", () => {
  const table = tableOf(blockOf([{ tick: 0, time: 0, values: [NaN, 1, 2] }]));
  assert.ok(Number.isNaN(table.value(0, 0)));
});

test("bytes that are no block are refused in words", () => {
  assert.throws(() => readBlockHead(new ArrayBuffer(16)), /no block of frames/);
  assert.throws(() => readBlockHead(new ArrayBuffer(3)), /no block of frames/);
});

test("a block that is cut off anywhere is refused, and never read beyond its end", () => {
  const whole = blockOf([{ tick: 0, time: 0, values: [1, 2, 3], active: [[0, 1, 0]], blocking: [[1, 0, 1, 2]] }]);
  for (let size = 16; size < whole.byteLength; ++size) assert.throws(() => tableOf(whole.slice(0, size)), Error, `${size} bytes`);
});

test("a frame with fewer numbers than the session announces is refused", () => {
  assert.throws(() => tableOf(blockOf([{ tick: 0, time: 0, values: [] }])), /at least 32 were expected/);
});

test("a list of rows that is longer than its frame is refused", () => {
  const buffer = blockOf([{ tick: 0, time: 0, values: [1, 2, 3] }]);
  new DataView(buffer).setUint16(16 + 16 + 12, 500, true);
  assert.throws(() => tableOf(buffer), /rows is cut off/);
});
