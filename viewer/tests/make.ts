import { Schema } from "../src/data/schema.ts";
import type { ChannelInfo, Session } from "../src/protocol/session.ts";

/** What a level's state may be, as the program lists it. */
export const STATES = ["not solved", "no rows", "met", "at limit", "gives way", "minimised"];

/** A schema of channels given as name → size, in order. */
export function schemaOf(sizes: Record<string, number>, more: Partial<Session> = {}): Schema {
  let offset = 0;
  const channels: ChannelInfo[] = Object.entries(sizes).map(([name, size]) => {
    const channel: ChannelInfo = { name, unit: "", about: "", size, offset };
    if (name.startsWith("told.level.")) channel.values = STATES;
    offset += size;
    return channel;
  });
  const header = { robot: { mass: 30 }, level_names: ["first", "second"], level_units: ["N", "m/s²"], event_names: ["none", "lift-off"] };
  const session = { channels, frame_floats: offset, rows: [["a", "b"], ["c"]], header, orders: [], bodies: [], ...more };
  return new Schema(session as unknown as Session);
}

export interface RawFrame {
  tick: number;
  time: number;
  values: number[];
  active?: [level: number, state: number, row: number, by?: number][];
  blocking?: [level: number, by: number, row: number, cost: number][];
}

/** A block's bytes, written by what viewer/README.md says. */
export function blockOf(frames: RawFrame[], dropped = 0, generation = 0): ArrayBuffer {
  const sizes = frames.map(({ values, active = [], blocking = [] }) => {
    const bytes = 16 + 4 * values.length + 4 + 8 * (active.length + blocking.length);
    return bytes + ((8 - (bytes % 8)) % 8);
  });
  const buffer = new ArrayBuffer(16 + sizes.reduce((sum, size) => sum + size, 0));
  const view = new DataView(buffer);
  [0x53, 0x46, 0x56, 0x31].forEach((byte, i) => view.setUint8(i, byte));
  [frames.length, dropped, generation].forEach((value, i) => view.setUint32(4 + 4 * i, value, true));
  let begin = 16;
  frames.forEach(({ tick, time, values, active = [], blocking = [] }, k) => {
    let at = begin;
    view.setUint32(at, sizes[k] as number, true);
    view.setUint32(at + 4, tick, true);
    view.setFloat64(at + 8, time, true);
    at += 16;
    for (const value of values) view.setFloat32((at += 4) - 4, value, true);
    view.setUint16(at, active.length, true);
    view.setUint16(at + 2, blocking.length, true);
    at += 4;
    for (const [level, state, row, by = 0] of active) {
      view.setUint8(at, level);
      view.setInt8(at + 1, state);
      view.setUint16(at + 2, row, true);
      view.setFloat32(at + 4, by, true);
      at += 8;
    }
    for (const [level, by, row, cost] of blocking) {
      view.setUint8(at, level);
      view.setUint8(at + 1, by);
      view.setUint16(at + 2, row, true);
      view.setFloat32(at + 4, cost, true);
      at += 8;
    }
    begin += sizes[k] as number;
  });
  return buffer;
}

/** Random numbers from 0 to 1, the same for the same seed. */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
