import type { FrameSource } from "./source.ts";

/** How far behind the newest frame a live picture runs, so that it moves evenly [s of wall clock]. */
const LIVE_LAG = 0.05;
/** With a larger lag the picture jumps instead of catching up [s of wall clock]. */
const JUMP = 0.4;

/** The shown time, and how it advances. */
export class Player {
  time = NaN;
  playing = true;
  speed = 1;
  /** Live: stay with the newest frame. */
  following: boolean;

  constructor(
    public source: FrameSource,
    readonly live: boolean,
  ) {
    this.following = live;
  }

  /** Whether the past of a live run is shown. */
  get past(): boolean {
    return this.live && !this.following;
  }

  /** Advances by `dt` seconds of wall clock; `liveRate`: speed of the live run. */
  advance(dt: number, liveRate: number): void {
    const { first, last } = this.source;
    if (Number.isNaN(first)) return;
    if (Number.isNaN(this.time)) this.time = this.live ? last : first;
    if (this.following) this.follow(dt, liveRate);
    else if (this.playing) this.play(dt);
    this.time = Math.min(Math.max(this.time, first), last);
  }

  private follow(dt: number, rate: number): void {
    const target = this.source.last - LIVE_LAG * rate;
    const off = target - (this.time + dt * rate);
    if (rate === 0 || Math.abs(off) > JUMP * rate) this.time = rate === 0 ? this.source.last : target;
    else this.time += dt * rate + off * Math.min(1, 3 * dt);
  }

  private play(dt: number): void {
    this.time += dt * this.speed;
    if (this.time < this.source.last) return;
    if (this.live) this.following = true;
    else this.playing = false;
  }

  /** There are no frames yet. */
  private get isEmpty(): boolean {
    return Number.isNaN(this.source.first);
  }

  /** Shows another time; a live run stays there, a log plays on. */
  seek(time: number): void {
    if (this.isEmpty) return;
    this.time = Math.min(Math.max(time, this.source.first), this.source.last);
    if (this.live) {
      this.following = false;
      this.playing = false;
    }
  }

  step(ticks: number): void {
    if (this.isEmpty) return;
    this.playing = false;
    this.following = false;
    this.time = this.source.neighbour(this.time, ticks);
  }

  /** To the newest frame of a live run. */
  goLive(): void {
    this.following = this.live;
    this.playing = true;
  }

  /** The run begins again. */
  restart(): void {
    this.time = NaN;
    this.goLive();
  }

  toggle(): void {
    if (!this.live && !this.playing && this.time >= this.source.last) this.time = this.source.first;
    this.playing = !this.playing;
  }
}
