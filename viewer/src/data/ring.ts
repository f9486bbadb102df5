import type { Frame } from "./frame.ts";
import type { Schema } from "./schema.ts";
import { FrameTable } from "./table.ts";

/** Frames of a segment: about one second. */
const SEGMENT = 400;

/** The last `seconds` of a live run, in segments; the oldest segment is reused. */
export class FrameRing {
  private readonly segments: FrameTable[] = [];

  constructor(readonly seconds: number) {}

  append(schema: Schema, tick: number, time: number, values: Float32Array, rows: Uint8Array | undefined): void {
    if (time < this.last) this.clear(); // the run was reset
    let segment = this.segments.at(-1);
    if (segment === undefined || segment.full || segment.schema !== schema) {
      segment = this.nextSegment(schema, time);
      this.segments.push(segment);
    }
    segment.append(tick, time, values, rows);
  }

  private nextSegment(schema: Schema, time: number): FrameTable {
    let old: FrameTable | undefined;
    while (this.segments[0] !== undefined && time - this.segments[0].last >= this.seconds) old = this.segments.shift();
    if (old?.capacity !== SEGMENT || old.schema.frameFloats !== schema.frameFloats) return new FrameTable(schema, SEGMENT);
    old.reuse(schema);
    return old;
  }

  clear(): void {
    this.segments.length = 0;
  }

  get empty(): boolean {
    return this.segments.length === 0;
  }
  get first(): number {
    return this.segments[0]?.first ?? NaN;
  }
  get last(): number {
    return this.segments.at(-1)?.last ?? NaN;
  }

  /** The last frame at or before `time`, or the first of all. */
  at(time: number): Frame | undefined {
    const segment = this.segments[this.segmentAt(time)];
    return segment?.frame(segment.indexAt(time));
  }

  /** Time of the frame `steps` after (negative: before) that at `time`. */
  neighbour(time: number, steps: number): number {
    let s = this.segmentAt(time);
    let segment = this.segments[s];
    if (segment === undefined) return time;
    let i = segment.indexAt(time) + steps;
    while (i < 0 && s > 0) i += (segment = this.segments[--s] as FrameTable).size;
    while (i >= segment.size && s + 1 < this.segments.length) {
      i -= segment.size;
      segment = this.segments[++s] as FrameTable;
    }
    return segment.times[Math.min(Math.max(i, 0), segment.size - 1)] as number;
  }

  /** Calls with each table and the range of its frames within [from, to]. */
  visit(from: number, to: number, call: (table: FrameTable, begin: number, end: number) => void): void {
    for (const segment of this.segments) {
      if (segment.last < from || segment.first > to) continue;
      const begin = segment.first >= from ? 0 : segment.indexAt(from);
      call(segment, begin, segment.indexAt(to) + 1);
    }
  }

  private segmentAt(time: number): number {
    let found = 0;
    for (let s = 0; s < this.segments.length; ++s)
      if ((this.segments[s] as FrameTable).first <= time) found = s;
    return found;
  }
}
