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

/** In a sentence what gives way to what. */
export function accountOf(states: LevelState[]): string {
  const yielding = states.filter((state) => state.status === "gives way");
  if (yielding.length === 0) return "Every level gets what it asks for.";
  return yielding
    .map((state) => {
      const rows = state.blocked.map(({ by, row }) => `${nameOf(states, by)} (${row})`);
      const because = rows.length === 0 ? "" : ` to ${listed(rows)}`;
      const residual = `${rounded(state.residual, 2)}${state.unit === "" ? "" : ` ${state.unit}`}`;
      return `${state.name.replaceAll("_", " ")} gives way${because}, ${residual} short.`;
    })
    .join(" ");
}

function listed(parts: string[]): string {
  return parts.length < 2 ? parts.join() : `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}`;
}

/** A level by its number, as people read it. */
export function nameOf(states: LevelState[], level: number): string {
  return states.find((state) => state.level === level)?.name.replaceAll("_", " ") ?? "a level above";
}
