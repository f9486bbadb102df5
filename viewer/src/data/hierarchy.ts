import { rounded } from "./numbers.ts";
import { scalar, type Frame } from "./frame.ts";

export type LevelStatus = "met" | "at limit" | "gives way" | "minimised" | "no rows";

export interface RowNote {
  name: string;
  level: number;
  state: number;
}

export interface BlockNote {
  by: number;
  row: string;
  cost: number;
}

/** How a level came out at a tick. */
export interface LevelState {
  /** Its number in `header.level_names`. */
  level: number;
  /** Its place in the order of priority, from 1. */
  place: number;
  name: string;
  unit: string;
  status: LevelStatus;
  residual: number;
  rows: number;
  freedom: number;
  iterations: number;
  /** That solving it took [µs]; NaN: not measured. */
  time: number;
  active: RowNote[];
  blocked: BlockNote[];
}

/** What each level of the frame's hierarchy did, highest priority first. */
export function levelStates(frame: Frame): LevelState[] {
  const { schema } = frame;
  return schema.order(frame.tick).map((level, index) => {
    const name = schema.levels[level] as string;
    const field = (what: string): number => scalar(frame, `hierarchy.level.${name}.${what}`);
    const unit = schema.units[level] ?? "";
    const active = frame.active
      .filter((row) => row.level === level)
      .map(({ row, state }) => ({ name: schema.rowName(level, row), level, state }));
    const blocked = frame.blocking
      .filter((row) => row.level === level)
      .map(({ by, row, cost }) => ({ by, row: schema.rowName(by, row), cost }));
    const state = {
      level, place: index + 1, name, unit, active, blocked,
      residual: field("residual"), rows: field("num_rows"),
      freedom: field("degrees_of_freedom_left"), iterations: field("iterations"),
      time: scalar(frame, `timings.level.${name}.solve`),
    };
    return { ...state, status: statusOf(state, schema.visible[level]) };
  });
}

function statusOf({ residual, rows, active }: Omit<LevelState, "status">, visible: number | null | undefined): LevelStatus {
  if (rows === 0) return "no rows";
  if (visible === null) return "minimised";
  if (residual > (visible ?? 0)) return "gives way";
  return active.length > 0 ? "at limit" : "met";
}

/** What the hierarchy came to: a line, and sentences for whoever wants more. */
export interface Account {
  kind: "good" | "bad" | "none";
  line: string;
  more: string[];
}

/** What gives way to what, and what is held back without that. */
export function accountOf(states: LevelState[]): Account {
  if (states.every((state) => state.status === "no rows")) return { kind: "none", line: "No level is solved at this tick.", more: [] };
  const yielding = states.filter((state) => state.status === "gives way");
  const held = states.filter((state) => state.status === "minimised" && state.blocked.length > 0);
  const more = [...yielding, ...held].map((state) => sentenceOf(state, states));
  if (yielding.length > 0) return { kind: "bad", line: yieldingLine(yielding, states), more };
  if (held.length > 0) return { kind: "good", line: `All met; ${held.length === 1 ? "one minimised is" : `${held.length} minimised are`} held back.`, more };
  return { kind: "good", line: "Every level gets what it asks for.", more };
}

function yieldingLine(yielding: LevelState[], states: LevelState[]): string {
  const names = yielding.map(plainName);
  if (yielding.length > 2) return `${yielding.length} levels give way, the first of them ${names[0]}.`;
  if (yielding.length === 2) return `${listed(names)} give way.`;
  const above = [...new Set(yielding[0]?.blocked.map(({ by }) => nameOf(states, by)))];
  return `${names.join()} gives way${above.length === 0 ? "" : ` to ${listed(above)}`}.`;
}

function sentenceOf(state: LevelState, states: LevelState[]): string {
  const rows = listed(state.blocked.map(({ by, row }) => `${nameOf(states, by)} (${row})`));
  if (state.status === "minimised") return `${plainName(state)} is as small as it can be, held back by ${rows}.`;
  const residual = `${rounded(state.residual, 2)}${state.unit === "" ? "" : ` ${state.unit}`}`;
  return `${plainName(state)} gives way${rows === "" ? "" : ` to ${rows}`}, ${residual} short.`;
}

const plainName = ({ name }: LevelState): string => name.replaceAll("_", " ");

function listed(parts: string[]): string {
  return parts.length < 2 ? parts.join() : `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}`;
}

/** A level by its number, as people read it. */
export function nameOf(states: LevelState[], level: number): string {
  const found = states.find((state) => state.level === level);
  return found === undefined ? "a level above" : plainName(found);
}
