import { Envelope } from "./envelope.ts";
import type { Frame } from "./frame.ts";
import { FrameRing } from "./ring.ts";
import type { Schema } from "./schema.ts";
import type { FrameSource, Mark, Series } from "./source.ts";
import type { FrameTable } from "./table.ts";

/** How far back a live run can be looked at [s]. */
export const LIVE_SECONDS = 120;

/** The last two minutes of a live run. */
export class LiveSource implements FrameSource {
  /** Called when frames begin again from an earlier time. */
  onRestart: () => void = () => {};
  marks: Mark[] = [];
  private readonly ring = new FrameRing(LIVE_SECONDS);

  constructor(public schema: Schema) {}

  append(tick: number, time: number, values: Float32Array, rows: Uint8Array | undefined): void {
    const restarts = time < this.ring.last;
    if (restarts) this.marks = [];
    this.ring.append(this.schema, tick, time, values, rows);
    if (restarts) this.onRestart();
  }

  clear(): void {
    this.ring.clear();
    this.marks = [];
  }

  /** Something happened; what is from before the frames is forgotten. */
  mark(...marks: Mark[]): void {
    this.marks = [...this.marks, ...marks].filter(({ time }) => !(time < this.ring.first));
  }

  get first(): number {
    return this.ring.first;
  }
  get last(): number {
    return this.ring.last;
  }

  at(time: number): Frame | undefined {
    return this.ring.at(time);
  }
  neighbour(time: number, steps: number): number {
    return this.ring.neighbour(time, steps);
  }
  expect(): void {}

  fill(envelope: Envelope, series: Series[]): void {
    this.ring.visit(envelope.from, envelope.to, (table, begin, end) => fillFrom(table, begin, end, envelope, series, this.schema.period));
  }

  sample(from: number, to: number, count: number, call: (frame: Frame) => void): void {
    let ticks = 0;
    this.ring.visit(from, to, (_, begin, end) => (ticks += end - begin));
    const stride = Math.max(1, Math.ceil(ticks / count));
    this.ring.visit(from, to, (table, begin, end) => {
      for (let i = begin; i < end; ++i) if ((table.ticks[i] as number) % stride === 0) call(table.frame(i));
    });
  }
}

/** Steps further than this many usual ones are gaps. */
const MOST_STEPS = 3;

/** Adds frames [begin, end) of a table to the envelope; `step`: time between frames where none is lost, at least. */
export function fillFrom(table: FrameTable, begin: number, end: number, envelope: Envelope, series: Series[], step: number): void {
  const most = MOST_STEPS * Math.max(step, usualStep(table, step));
  for (let i = begin; i < end; ++i) if (table.knows(i)) envelope.see(table.times[i] as number, most);
  series.forEach(({ channel, index }, s) => {
    const offset = table.schema.offset(channel);
    if (offset < 0) return;
    for (let i = begin; i < end; ++i) envelope.add(s, table.times[i] as number, table.value(i, offset + index));
  });
}

/** Time that most frames of a table come after the one before; a log's summary has fewer of them than were asked for. */
function usualStep(table: FrameTable, least: number): number {
  const usual = (table.last - table.first) / (table.size - 1);
  if (!(usual > 1.01 * least)) return least;
  const steps = Array.from({ length: table.size - 1 }, (_, i) => (table.times[i + 1] as number) - (table.times[i] as number));
  return steps.sort((a, b) => a - b)[Math.floor(0.75 * steps.length)] as number;
}
