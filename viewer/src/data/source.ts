import type { Explained } from "./explained.ts";
import type { Frame } from "./frame.ts";
import type { Envelope } from "./envelope.ts";
import type { Schema } from "./schema.ts";

/** Something that happened, for the marks on the time bar. */
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

/** Where frames come from: a live run's last minutes, or a log. */
export interface FrameSource {
  readonly schema: Schema;
  /** Times of the first and last frame there is [s]; NaN: none. */
  readonly first: number;
  readonly last: number;
  readonly marks: Mark[];
  /** The frame at `time`, or what is nearest and already here. */
  at(time: number): Frame | undefined;
  /** Time of the frame `steps` further on. */
  neighbour(time: number, steps: number): number;
  /** Of a log: whether the tick at `time` can't be read, as far as is known; another is shown then. */
  isUnreadable?(time: number): boolean;
  /** Exactly what holds back which level at a tick that is looked at, once that is known: of a log. */
  explained?(tick: number): Explained | undefined;
  /** … and whether that is being found out. */
  isComputing?(tick: number): boolean;
  /** Fills the envelope with what is here, and asks for the rest. */
  fill(envelope: Envelope, series: Series[]): void;
  /** Frames within [from, to] that are here, at most about `count` of them. */
  sample(from: number, to: number, count: number, call: (frame: Frame) => void): void;
  /** What will be asked for soon: the clock is at `time` and runs at `rate` seconds a second. */
  expect(time: number, rate: number): void;
}
