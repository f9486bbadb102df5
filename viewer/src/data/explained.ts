import { NoAnswer, pause } from "../protocol/ask.ts";
import type { Schema } from "./schema.ts";

/** What `/api/explain` answers of a tick (viewer/README.md). */
export interface ExplainAnswer {
  /** `told`: number of rows to show. */
  gave_way?: { level: string; to: AnswerRow[]; told: number }[];
  costs_are_exact?: boolean;
}

interface AnswerRow {
  level: string;
  row: string;
  cost: number | null;
  same?: { level: string; row: string }[];
}

/** A row that holds a level back; `cost`: what the level would gain without it, NaN: not known. */
export interface ExactRow {
  by: number;
  row: string;
  cost: number;
}

/** Exact rows that hold each level back, by its name, sorted by cost. */
export type Explained = ReadonlyMap<string, { rows: ExactRow[]; others: number }>;

/** Undefined where the costs are estimates. */
export function readExplained(answer: ExplainAnswer, schema: Pick<Schema, "levels">): Explained | undefined {
  if (answer.costs_are_exact !== true) return undefined;
  return new Map((answer.gave_way ?? []).map(({ level, to, told }) => {
    const rows = to.map(({ level: by, row, cost, same }) => ({
      by: schema.levels.indexOf(by), cost: cost ?? NaN,
      row: [row, ...(same ?? []).map((other) => (other.level === by ? other.row : `${other.level} ${other.row}`))].join(" with "),
    }));
    return [level, { rows: rows.slice(0, told), others: rows.length - told }];
  }));
}

/** Pause before the first request for a tick, and before each further one [ms]. */
const STILL = 300, AGAIN = 400;
/** Number of explanations kept. */
const KEPT = 64;

/** Requests explanations of ticks at which the page stands still. */
export class Explainer {
  /** Called when a tick is requested, and when its answer has arrived. */
  onChange: () => void = () => {};
  private asked = false;
  private readonly known = new Map<number, Explained | undefined>();
  private tick = -1;
  private looks = 0;

  /** `ask`: returns undefined while the answer is computed. */
  constructor(private readonly ask: (tick: number) => Promise<ExplainAnswer | undefined>, private readonly schema: Pick<Schema, "levels">) {}

  /** The explanation of the shown tick, if known; requests it if the tick stays shown. */
  at(tick: number): Explained | undefined {
    if (tick !== this.tick) void this.look(tick);
    return this.known.get(tick);
  }

  /** Whether the shown tick is being explained. */
  isComputing(tick: number): boolean {
    return this.asked && tick === this.tick && !this.known.has(tick);
  }

  private keep(tick: number, explained: Explained | undefined): void {
    const [oldest] = this.known.keys();
    if (this.known.size >= KEPT && oldest !== undefined) this.known.delete(oldest);
    this.known.set(tick, explained);
  }

  private async look(tick: number): Promise<void> {
    this.tick = tick;
    this.asked = false;
    const look = ++this.looks;
    if (this.known.has(tick)) return;
    for (let ms = STILL; ; ms = AGAIN) {
      await pause(ms);
      if (look !== this.looks) return;
      if (!this.asked) {
        this.asked = true;
        this.onChange();
      }
      if (!this.known.has(tick)) await this.fetch(tick);
      if (look !== this.looks) return;
      if (this.known.has(tick)) return this.onChange();
    }
  }

  /** Keeps the answer, if there is one yet; after a refusal the frames' estimates stay. */
  private async fetch(tick: number): Promise<void> {
    try {
      const answer = await this.ask(tick);
      if (answer !== undefined) this.keep(tick, readExplained(answer, this.schema));
    } catch (error) {
      if (!(error instanceof NoAnswer)) this.keep(tick, undefined);
    }
  }
}
