import { Envelope } from "./envelope.ts";
import type { Explained, Explainer } from "./explained.ts";
import type { Frame } from "./frame.ts";
import { fillFrom } from "./live_source.ts";
import type { Schema } from "./schema.ts";
import type { FrameSource, Mark, Series } from "./source.ts";
import type { FrameTable } from "./table.ts";
import { TILE_FRAMES, TileCache, type FetchBlock, type TileKey } from "./tiles.ts";

/** Memory for tiles [bytes]. */
const CACHE_BYTES = 160e6;

/** Least ticks between frames of a log's summary. */
const STRETCH = 64;

/** A log; only what is shown is loaded. */
export class ReplaySource implements FrameSource {
  marks: Mark[] = [];
  readonly cache: TileCache;
  private readonly coarseStride: number;

  constructor(
    readonly schema: Schema,
    private readonly period: number,
    private readonly firstTick: number,
    private readonly ticks: number,
    fetchBlock: FetchBlock,
    private readonly explainer?: Explainer,
  ) {
    this.cache = new TileCache(schema, CACHE_BYTES, fetchBlock, firstTick);
    this.coarseStride = Math.max(1, Math.ceil(ticks / TILE_FRAMES));
  }

  get first(): number {
    return this.firstTick * this.period;
  }
  get last(): number {
    return (this.firstTick + this.ticks - 1) * this.period;
  }

  /** `ticks` of the log are summarised by now. */
  summarise(ticks: number): void {
    this.cache.renewUnfinished();
    this.cache.summarised = ticks >= this.ticks ? Infinity : ticks;
  }

  explained(tick: number): Explained | undefined {
    return this.explainer?.at(tick);
  }

  isComputing(tick: number): boolean {
    return this.explainer?.isComputing(tick) ?? false;
  }

  private tick(time: number): number {
    const tick = Math.floor(time / this.period + 1e-6) - this.firstTick;
    return Math.min(Math.max(tick, 0), this.ticks - 1);
  }

  /** A tile with every tick, if it is here. */
  private fine(index: number): FrameTable | undefined {
    return this.cache.get({ stride: 1, index, minMax: false });
  }

  at(time: number): Frame | undefined {
    const index = Math.floor(this.tick(time) / TILE_FRAMES);
    const fine = this.fine(index);
    const table = fine ?? this.cache.get({ stride: this.coarseStride, index: 0, minMax: false });
    if (table === undefined || table.size === 0) return undefined;
    const i = table.indexAt(time + 1e-6);
    const off = Math.abs(this.tick(time) + this.firstTick - (table.ticks[i] as number));
    return fine !== undefined || off <= 2 * Math.max(this.coarseStride, STRETCH) ? table.frame(i) : undefined;
  }

  /** Skips unreadable ticks, as far as they are known. */
  neighbour(time: number, steps: number): number {
    const from = Math.min(Math.max(this.tick(time) + steps, 0), this.ticks - 1);
    let tick = from;
    while (tick >= 0 && tick < this.ticks && this.isLost(tick)) tick += Math.sign(steps);
    return (this.firstTick + (tick >= 0 && tick < this.ticks ? tick : from)) * this.period;
  }

  isUnreadable(time: number): boolean {
    return this.isLost(this.tick(time));
  }

  /** Whether the tile of this tick is here and lacks the tick. */
  private isLost(tick: number): boolean {
    const table = this.fine(Math.floor(tick / TILE_FRAMES));
    if (table === undefined) return false;
    return table.size === 0 || table.ticks[table.indexAt((this.firstTick + tick) * this.period + 1e-6)] !== this.firstTick + tick;
  }

  expect(time: number, rate: number): void {
    const ahead = rate * 2; // what the next two seconds will show
    const begin = Math.floor(this.tick(Math.min(time, time + ahead)) / TILE_FRAMES);
    const end = Math.floor(this.tick(Math.max(time, time + ahead)) / TILE_FRAMES);
    for (let index = end; index >= begin; --index) this.fine(index);
  }

  fill(envelope: Envelope, series: Series[]): void {
    const perBucket = (envelope.to - envelope.from) / this.period / envelope.buckets;
    const stride = 2 ** Math.max(0, Math.floor(Math.log2(perBucket)));
    const minMax = stride > 1;
    this.visit({ stride, minMax }, envelope.from, envelope.to, (table) =>
      fillFrom(table, 0, table.size, envelope, series, stride * this.period),
    );
  }

  sample(from: number, to: number, count: number, call: (frame: Frame) => void): void {
    const stride = Math.max(1, Math.ceil((to - from) / this.period / count));
    const begin = Math.floor(this.tick(from) / TILE_FRAMES);
    const end = Math.floor(this.tick(to) / TILE_FRAMES);
    for (let index = begin; index <= end; ++index) {
      const table = this.fine(index);
      if (table === undefined) continue;
      for (let i = 0; i < table.size; ++i) {
        const time = table.times[i] as number;
        if (time >= from && time <= to && (table.ticks[i] as number) % stride === 0) call(table.frame(i));
      }
    }
  }

  private visit(level: Omit<TileKey, "index">, from: number, to: number, call: (table: FrameTable) => void): void {
    const span = TileCache.span({ ...level, index: 0 });
    for (let index = Math.floor(this.tick(from) / span); index <= Math.floor(this.tick(to) / span); ++index) {
      const table = this.cache.get({ ...level, index });
      if (table !== undefined) call(table);
    }
  }
}
