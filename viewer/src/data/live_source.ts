import { Envelope } from "./envelope.ts";
import type { Frame } from "./frame.ts";
import { FrameRing } from "./ring.ts";
import type { Schema } from "./schema.ts";
import type { FrameSource, Mark, Series } from "./source.ts";
import { FrameTable } from "./table.ts";

/** How far back a live run can be looked at [s]. */
export const LIVE_SECONDS = 120;

/** Frames of ticks `first` to `first + ticks - 1`, which the program still has. */
export type OpenBefore = (first: number, ticks: number) => FrameSource;

/** Each mark once, in the order of time; those of one time as they came. */
function inOrder(marks: Mark[]): Mark[] {
  const known = new Map<string, Mark>();
  for (const mark of marks) {
    const key = `${mark.time} ${mark.kind} ${mark.text} ${mark.leg}`;
    if (!known.has(key)) known.set(key, mark);
  }
  return [...known.values()].sort((a, b) => a.time - b.time);
}

/** The last two minutes of a live run: what came, and what the program still knows of the time before. */
export class LiveSource implements FrameSource {
  /** Called when the run has begun again, and nothing of the one before is left. */
  onRestart: () => void = () => {};
  marks: Mark[] = [];
  private readonly ring = new FrameRing(LIVE_SECONDS);
  private before: FrameSource | undefined;
  private oldest = Infinity;
  private openBefore: OpenBefore | undefined;
  private begun: number | undefined;

  constructor(public schema: Schema) {}

  /** The run that goes on began with generation `begun`: of one before it nothing is left. */
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

  /** With which generation the run began that goes on. */
  get run(): number | undefined {
    return this.begun;
  }

  /** Whether frames of this generation are of a run before. */
  isOld(generation: number): boolean {
    return this.begun !== undefined && generation < this.begun;
  }

  /** What comes from now on is of the run that began with `begun`, behind ticks that can be asked for, from `oldest` on. Frames that came before are forgotten. */
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

  /** Something happened, of which some may be known; what is from before the frames is forgotten. */
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

  /** Where frames from before the ring are asked for, if any are. */
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
