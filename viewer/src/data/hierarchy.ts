import { percent } from "../math/friction.ts";
import type { Explained } from "./explained.ts";
import { MISSED_EQUALITY, scalar, word, type Frame } from "./frame.ts";
import { stopText } from "./stop.ts";

/** As in `told.level.*.state`. */
export type LevelStatus = "met" | "at limit" | "gives way" | "minimised" | "no rows" | "not solved";

export interface RowNote {
  name: string;
  state: number;
  /** How far beyond its bound; 0 at it, NaN: not known. */
  by: number;
}

export interface BlockNote {
  by: number;
  row: string;
  cost: number;
}

/** Result of a level at a tick. */
export interface LevelState {
  /** Its number in `header.level_names`. */
  level: number;
  name: string;
  unit: string;
  status: LevelStatus;
  residual: number;
  rows: number;
  freedom: number;
  iterations: number;
  /** Solving time [µs]; NaN: not measured. */
  time: number;
  active: RowNote[];
  /** Equality rows that it missed, worst first. */
  missed: RowNote[];
  /** Highest cost first. */
  blocked: BlockNote[];
  /** Number of further rows that hold it back; undefined: the costs are the control loop's estimates. */
  others?: number;
}

/** Results of the frame's levels, highest priority first; `explained`: exact rows, where they are known. */
export function levelStates(frame: Frame, explained?: Explained): LevelState[] {
  const { schema } = frame;
  return schema.order(frame.tick).map((level) => {
    const name = schema.levels[level] as string;
    const field = (what: string): number => scalar(frame, `hierarchy.level.${name}.${what}`);
    const unit = schema.units[level] ?? "";
    const rows = frame.active.filter((row) => row.level === level).map(({ row, state, by }) => ({ name: schema.rowName(level, row), state, by }));
    const active = rows.filter(({ state }) => state !== MISSED_EQUALITY), missed = rows.filter(({ state }) => state === MISSED_EQUALITY);
    const estimated = frame.blocking.filter((row) => row.level === level).map(({ by, row, cost }) => ({ by, row: schema.rowName(by, row), cost }));
    const { rows: blocked, others } = explained?.get(name) ?? { rows: estimated, others: undefined };
    const status = (word(frame, `told.level.${name}.state`) || "not solved") as LevelStatus;
    const state: LevelState = {
      level, name, unit, status, active, missed, blocked, ...(others === undefined ? {} : { others }),
      residual: field("residual"), rows: field("num_rows") || 0,
      freedom: field("degrees_of_freedom_left"), iterations: field("iterations"),
      time: scalar(frame, `timings.level.${name}.solve`),
    };
    return status === "not solved" ? { ...state, residual: NaN, rows: 0, active: [], missed: [], blocked: [] } : state;
  });
}

/** False where plan and solution command nothing; the plan may then be of an earlier tick. */
export const isFollowed = (frame: Frame): boolean => word(frame, "told.unused") === "";

/** Text of a tick without a solution, or whose solution commands nothing, in the words of `explain`. */
function nothingText(frame: Frame, [first]: LevelState[]): string {
  if (!isFollowed(frame)) return `${word(frame, "told.unused")}: ${word(frame, "command.mode")}, because ${word(frame, "told.because")}.`;
  const hasRows = first !== undefined && scalar(frame, `hierarchy.level.${first.name}.num_rows`) > 0;
  return hasRows ? cutOffText(first) : "No level is solved.";
}

const cutOffText = (level: LevelState): string => `The solver was cut off in ${plainName(level)}: of it and the levels below it nothing is known.`;

/** Summary of a hierarchy. */
export interface Account {
  kind: "good" | "bad" | "none";
  line: string;
}

/** Share of the new hierarchy in a blend; 1: no blend. */
export function blendShare(frame: Frame): number {
  const share = scalar(frame, "hierarchy.transition_share");
  return Number.isNaN(share) ? 1 : share;
}

interface Circumstances {
  /** The exact costs of what holds levels back are being computed. */
  computing?: boolean;
  /** See `blendShare`. */
  share?: number;
  /** The controller has stopped for safety. */
  stopped?: boolean;
}

/** Summary of a tick's hierarchy. */
export function accountAt(frame: Frame, states = levelStates(frame), computing = false): Account {
  return accountOf(states, nothingText(frame, states), { share: blendShare(frame), stopped: stopText(frame) !== "", computing });
}

/** What gives way to what, or which minimised levels are held back; `nothing`: the line where nothing is solved. */
export function accountOf(states: LevelState[], nothing: string, { share = 1, stopped = false, computing = false }: Circumstances = {}): Account {
  if (states.every((state) => state.status === "not solved")) return { kind: stopped ? "bad" : "none", line: nothing };
  const { kind, line } = accountOfLevels(states, computing);
  if (share >= 1) return { kind, line };
  // What holds back a minimised level is not known in a blend.
  return { kind, line: `Between two hierarchies (${percent(share)} of the way): ${kind === "good" ? "all tasks are met." : line}` };
}

function accountOfLevels(states: LevelState[], computing: boolean): Account {
  const yielding = states.filter((state) => state.status === "gives way");
  const held = states.filter((state) => state.status === "minimised" && state.blocked.length > 0);
  const isEstimated = [...yielding, ...held].some(({ blocked, others }) => blocked.length > 0 && others === undefined);
  const note = isEstimated ? ` (${computing ? "computing …" : "estimate"})` : "";
  const first = states.find((state) => state.status === "not solved");
  const cut = first === undefined ? [] : [cutOffText(first)];
  if (yielding.length > 0) return { kind: "bad", line: [...cut, `${yieldingText(yielding, states)}${note}.`].join(" ") };
  const kept = held.length > 0 ? `${heldText(held, states)}.` : "";
  if (first !== undefined) return { kind: "bad", line: [...cut, kept].join(" ").trimEnd() };
  return { kind: "good", line: kept === "" ? "Every level gets what it asks for." : `All tasks are met; ${kept}` };
}

/** Minimised levels that would be smaller alone. */
function heldText(held: LevelState[], states: LevelState[]): string {
  if (held.length > 1) return `${listed(held.map(plainName))} are kept above 0`;
  return `${held.map(plainName).join()} is kept above 0 by ${aboveOf(held[0] as LevelState, states)}`;
}

/** Names of the levels that hold it back; "": none. */
function aboveOf({ blocked }: LevelState, states: LevelState[]): string {
  return listed([...new Set(blocked.map(({ by }) => nameOf(states, by)))]);
}

/** Levels that give way to the same levels share a part of the sentence. */
function yieldingText(yielding: LevelState[], states: LevelState[]): string {
  const groups = Map.groupBy(yielding, (state) => aboveOf(state, states));
  return [...groups].map(([above, group], k) => {
    const verb = k > 0 && above !== "" ? "" : group.length > 1 ? " give way" : " gives way";
    return `${listed(group.map(plainName))}${verb}${above === "" ? "" : ` to ${above}`}`;
  }).join("; ");
}

const plainName = ({ name }: LevelState): string => name.replaceAll("_", " ");

function listed(parts: string[]): string {
  return parts.length < 2 ? parts.join() : `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}`;
}

/** Readable name of a level, by its number. */
export function nameOf(states: LevelState[], level: number): string {
  const found = states.find((state) => state.level === level);
  return found === undefined ? "a level above" : plainName(found);
}
