import type { Explained } from "./explained.ts";
import type { Frame } from "./frame.ts";
import type { Envelope } from "./envelope.ts";
import type { Schema } from "./schema.ts";

/** A mark on the time bar. */
export interface Mark {
  time: number;
  text: string;
  leg: string;
  kind: "event" | "mode" | "change" | "damage" | "force" | "end";
}

/** One line of a plot: a number of a channel. */
export interface Series {
  channel: string;
  index: number;
}

/** A source of frames: a live run's last minutes, or a log. */
export interface FrameSource {
  readonly schema: Schema;
  /** Times of the first and last frame there is [s]; NaN: none. */
  readonly first: number;
  readonly last: number;
  readonly marks: Mark[];
  /** The frame at `time`, or the nearest one here. */
  at(time: number): Frame | undefined;
  /** Time of the frame `steps` further on. */
  neighbour(time: number, steps: number): number;
  /** Of a log: whether the tick at `time` is known to be unreadable; another is shown then. */
  isUnreadable?(time: number): boolean;
  /** Of a log: exact rows that hold levels back at the shown tick, once they are known. */
  explained?(tick: number): Explained | undefined;
  /** Of a log: whether these are being computed. */
  isComputing?(tick: number): boolean;
  /** Fills the envelope with what is here, and requests the rest. */
  fill(envelope: Envelope, series: Series[]): void;
  /** Frames within [from, to] that are here, at most about `count` of them. */
  sample(from: number, to: number, count: number, call: (frame: Frame) => void): void;
  /** Requests what is needed soon: the clock is at `time` and runs at `rate` seconds a second. */
  expect(time: number, rate: number): void;
}
