import { withoutRoundOff } from "./numbers.ts";

/** Least and greatest of each time bucket, so that a line loses no spike. */
export class Envelope {
  readonly x: Float64Array;
  readonly y: Float64Array[];
  /** Buckets in which lines break, because ticks are missing. */
  private readonly broken = new Set<number>();
  private seen = NaN;

  /** Two points a bucket: its beginning and its middle. */
  constructor(
    readonly from: number,
    readonly to: number,
    readonly buckets: number,
    series: number,
  ) {
    const width = (to - from) / buckets;
    this.x = Float64Array.from({ length: 2 * buckets }, (_, i) => from + 0.5 * width * i);
    this.y = Array.from({ length: series }, () => new Float64Array(2 * buckets).fill(NaN));
  }

  private bucketOf(time: number): number {
    const share = (time - this.from) / (this.to - this.from);
    return Math.min(this.buckets - 1, Math.max(0, Math.floor(share * this.buckets)));
  }

  /** Call it for each frame in order: lines break after a gap of more than `most`. */
  see(time: number, most: number): void {
    const before = this.seen;
    this.seen = time;
    if (!(time - before > most)) return;
    const bucket = this.bucketOf(before) + 1;
    if (bucket < this.bucketOf(time)) this.broken.add(bucket);
  }

  add(series: number, time: number, value: number): void {
    if (Number.isNaN(value) || time < this.from || time > this.to) return;
    const bucket = this.bucketOf(time);
    const y = this.y[series] as Float64Array;
    const low = y[2 * bucket] as number;
    const high = y[2 * bucket + 1] as number;
    if (!(low <= value)) y[2 * bucket] = value;
    if (!(high >= value)) y[2 * bucket + 1] = value;
  }

  /** Columns for uPlot: empty buckets are left out, so that lines join; null breaks them. */
  columns(): [Float64Array, ...(number | null)[][]] {
    const kept: number[] = [];
    for (let i = 0; i < this.x.length; ++i) if (this.breaksAt(i) || this.y.some((y) => !Number.isNaN(y[i] as number))) kept.push(i);
    const x = Float64Array.from(kept, (i) => this.x[i] as number);
    return [x, ...this.y.map((y) => kept.map((i) => (this.breaksAt(i) ? null : (y[i] as number))))];
  }

  private breaksAt(i: number): boolean {
    return i % 2 === 0 && this.broken.has(i / 2);
  }

  /** Least and greatest of all, with a little room. */
  bounds(): [number, number] {
    let low = Infinity;
    let high = -Infinity;
    for (const y of this.y)
      for (const value of y) {
        const known = withoutRoundOff(value);
        if (known < low) low = known;
        if (known > high) high = known;
      }
    if (low > high) return [0, 1];
    const room = high > low ? 0.06 * (high - low) : Math.max(1e-6, 0.05 * Math.abs(high) || 0.5);
    return [low - room, high + room];
  }
}
