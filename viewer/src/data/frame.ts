import type { Schema } from "./schema.ts";

/** State of an equality row that was missed. */
export const MISSED_EQUALITY = 2;

/** An inequality row at a bound (-1, 1) or beyond it (-3, 3), or an equality row that was missed. */
export interface ActiveRow {
  level: number;
  state: number;
  row: number;
  /** How far beyond the bound, in the level's unit: negative below the lower one, 0 at it; NaN: not known. */
  by: number;
}

/** A row of level `by` that keeps `level` from a residual smaller by `cost`. */
export interface BlockingRow {
  level: number;
  by: number;
  row: number;
  cost: number;
}

/** One control tick. */
export interface Frame {
  schema: Schema;
  tick: number;
  /** [s] */
  time: number;
  values: Float32Array;
  readonly active: ActiveRow[];
  readonly blocking: BlockingRow[];
}

/** A number of the frame; NaN where there is no such channel. */
export function scalar(frame: Frame, name: string, index = 0): number {
  const offset = frame.schema.offset(name);
  return offset < 0 ? NaN : (frame.values[offset + index] ?? NaN);
}

/** A word of the frame, from the channel's `values`; "": none. */
export function word(frame: Frame, name: string): string {
  const value = scalar(frame, name);
  return Number.isNaN(value) ? "" : (frame.schema.channel(name)?.values?.[value] ?? "");
}

/** Copies the numbers of a channel; false: there is none, or one is NaN. */
export function read(frame: Frame, name: string, out: number[], size = out.length): boolean {
  const offset = frame.schema.offset(name);
  if (offset < 0) return false;
  let known = true;
  for (let i = 0; i < size; ++i) {
    const value = frame.values[offset + i] ?? NaN;
    out[i] = value;
    known &&= !Number.isNaN(value);
  }
  return known;
}
