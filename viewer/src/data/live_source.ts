import { Envelope } from "./envelope.ts";
import type { Frame } from "./frame.ts";
import { FrameRing } from "./ring.ts";
import type { Schema } from "./schema.ts";
import type { FrameSource, Mark, Series } from "./source.ts";
import { FrameTable } from "./table.ts";

/** How far back a live run is kept [s]. */
export const LIVE_SECONDS = 120;

/** Opens frames of ticks `first` to `first + ticks - 1`, which the program keeps. */
export type OpenBefore = (first: number, ticks: number) => FrameSource;

/** Each mark once, sorted by time. */
function inOrder(marks: Mark[]): Mark[] {
  const known = new Map<string, Mark>();
  for (const mark of marks) {
    const key = `${mark.time} ${mark.kind} ${mark.text} ${mark.leg}`;
    if (!known.has(key)) known.set(key, mark);
  }
  return [...known.values()].sort((a, b) => a.time - b.time);
}

/** The last two minutes of a live run: received frames, and those that the program keeps from before. */
export class LiveSource implements FrameSource {
  /** Called when the run has begun again and the old one is cleared. */
  onRestart: () => void = () => {};
  marks: Mark[] = [];
  private readonly ring = new FrameRing(LIVE_SECONDS);
  private before: FrameSource | undefined;
  private oldest = Infinity;
  private openBefore: OpenBefore | undefined;
  private begun: number | undefined;

  constructor(public schema: Schema) {}

  /** The present run began at generation `begun`: clears an older one. */
  follow(begun: number): void {
    const known = this.begun;
    if (known !== undefined && begun <= known) return;
    this.begun = begun;
    if (known === undefined) return;
    this.forget();
    this.oldest = Infinity;
    this.marks = [];
    this.onRestart();
  }

  /** Generation at which the present run began. */
  get run(): number | undefined {
    return this.begun;
  }

  /** Whether frames of this generation belong to an earlier run. */
  isOld(generation: number): boolean {
    return this.begun !== undefined && generation < this.begun;
  }

  /** Begins with frames of the run that began at `begun`; earlier ticks from `oldest` on can be requested. Clears received frames. */
  begin(begun: number, oldest: number, openBefore: OpenBefore): void {
    this.follow(begun);
    this.forget();
    this.oldest = oldest;
    this.openBefore = openBefore;
  }

  append(tick: number, time: number, values: Float32Array, rows: Uint8Array | undefined): void {
    if (this.ring.empty && tick > this.oldest) this.before = this.openBefore?.(this.oldest, tick - this.oldest + 1);
    this.ring.append(this.schema, tick, time, values, rows);
    if (this.last - LIVE_SECONDS >= this.ring.first) this.before = undefined;
  }

  private forget(): void {
    this.ring.clear();
    this.before = undefined;
  }

  /** Adds marks; known ones and those before the frames are dropped. */
  mark(...marks: Mark[]): void {
    this.marks = inOrder([...this.marks, ...marks]).filter(({ time }) => !(time < this.first));
  }

  get first(): number {
    const before = this.before?.first;
    return before === undefined ? this.ring.first : Math.max(before, this.last - LIVE_SECONDS);
  }
  get last(): number {
    return this.ring.last;
  }

  /** Source of frames before the ring, if there is one. */
  private beforeFor(time: number): FrameSource | undefined {
    return time < this.ring.first - 1e-6 ? this.before : undefined;
  }

  at(time: number): Frame | undefined {
    return (this.beforeFor(time) ?? this.ring).at(time);
  }
  neighbour(time: number, steps: number): number {
    return (this.beforeFor(time + Math.min(0, steps) * this.schema.period) ?? this.ring).neighbour(time, steps);
  }
  expect(time: number, rate: number): void {
    this.beforeFor(time)?.expect(time, rate);
  }

  fill(envelope: Envelope, series: Series[]): void {
    this.beforeFor(envelope.from)?.fill(envelope, series);
    this.ring.visit(envelope.from, envelope.to, (table, begin, end) => fillFrom(table, begin, end, envelope, series, this.schema.period));
  }

  sample(from: number, to: number, count: number, call: (frame: Frame) => void): void {
    this.beforeFor(from)?.sample(from, Math.min(to, this.ring.first - 1e-6), count, call);
    let ticks = 0;
    this.ring.visit(from, to, (_, begin, end) => (ticks += end - begin));
    const stride = Math.max(1, Math.ceil(ticks / count));
    this.ring.visit(from, to, (table, begin, end) => {
      for (let i = begin; i < end; ++i) if ((table.ticks[i] as number) % stride === 0) call(table.frame(i));
    });
  }
}

/** A gap is longer than this many usual steps. */
const MOST_STEPS = 3;

/** Adds frames [begin, end) of a table to the envelope; `step`: least time between frames. */
export function fillFrom(table: FrameTable, begin: number, end: number, envelope: Envelope, series: Series[], step: number): void {
  const most = MOST_STEPS * Math.max(step, usualStep(table, step));
  for (let i = begin; i < end; ++i) if (table.knows(i)) envelope.see(table.times[i] as number, most);
  series.forEach(({ channel, index }, s) => {
    const offset = table.schema.offset(channel);
    if (offset < 0) return;
    for (let i = begin; i < end; ++i) envelope.add(s, table.times[i] as number, table.value(i, offset + index));
  });
}

/** Usual time between frames of a table; a log's summary may have fewer frames than were requested. */
function usualStep(table: FrameTable, least: number): number {
  const usual = (table.last - table.first) / (table.size - 1);
  if (!(usual > 1.01 * least)) return least;
  const steps = Array.from({ length: table.size - 1 }, (_, i) => (table.times[i + 1] as number) - (table.times[i] as number));
  return steps.sort((a, b) => a - b)[Math.floor(0.75 * steps.length)] as number;
}
