import { nameOf, type LevelState, type RowNote } from "../data/hierarchy.ts";
import { counted, quantity, seen } from "../data/numbers.ts";
import { h, plain, setText } from "./dom.ts";

/** Sign of each status: colour is never the only one. */
const SIGNS = { met: "✓", "at limit": "▲", "gives way": "✕", minimised: "·", "no rows": "–", "not solved": "–" } as const;

/** A level in two lines: its result, and what matters most. When open, all its rows. */
export class LevelCard {
  readonly root: HTMLLIElement;
  private readonly sign = h("span", { class: "sign", "aria-hidden": "true" });
  private readonly status = h("span", { class: "status" });
  private readonly residual = h("span", { class: "residual" });
  private readonly brief = h("span", { class: "brief" });
  private readonly time = h("span", { class: "level-time", title: "time that solving this level took" });
  private readonly rows = h("p", { class: "rows" });
  private readonly blocked = h("p", { class: "blocked" });
  private readonly meta = h("p", { class: "meta" });
  private readonly opener: HTMLButtonElement;
  private readonly movers: HTMLButtonElement[];

  /** `move`: moves the level so many places down. */
  constructor(readonly name: string, index: number, move: (steps: number) => void) {
    const button = (text: string, steps: number, label: string): HTMLButtonElement =>
      h("button", { class: "small", "aria-label": `${plain(name)}: ${label}`, title: label, onclick: () => move(steps) }, text);
    this.movers = [button("↑", -1, "one up"), button("↓", 1, "one down")];
    const title = `${index + 1} ${plain(name)}`;
    this.opener = h("button", { class: "level-name", title: plain(name), "aria-expanded": "false", onclick: () => this.open() }, title);
    this.root = h("li", { class: "level", "data-level": name },
      h("div", { class: "level-head" }, this.sign, this.opener, this.residual),
      h("div", { class: "level-facts" }, this.status, this.brief, this.time),
      this.rows, this.blocked, this.meta,
      h("span", { class: "movers" }, ...this.movers),
    );
  }

  private open(): void {
    this.opener.setAttribute("aria-expanded", String(this.root.classList.toggle("open")));
  }

  /** Opens if the card that it replaces was open; returns the button that takes over the focus, if any. */
  follow(before: LevelCard | undefined): HTMLButtonElement | undefined {
    if (before?.root.classList.contains("open")) this.open();
    if (before?.opener === document.activeElement) return this.opener;
    return this.movers[before?.movers.indexOf(document.activeElement as HTMLButtonElement) ?? -1];
  }

  show(state: LevelState, all: LevelState[]): void {
    const kind = state.status.replaceAll(" ", "-");
    if (this.root.dataset["status"] !== kind) this.root.dataset["status"] = kind;
    this.root.classList.toggle("held", blockers(state).length > 0);
    setText(this.sign, SIGNS[state.status]);
    setText(this.status, state.status);
    setText(this.residual, state.rows === 0 ? "" : quantity(seen(state.residual, state.unit), state.unit));
    setText(this.brief, briefOf(state, all));
    if (this.brief.title !== this.brief.textContent) this.brief.title = this.brief.textContent ?? "";
    setText(this.time, timeOf(state));
    setText(this.rows, rowsOf(state));
    setText(this.blocked, heldText(state, all));
    setText(this.meta, state.rows === 0 ? "" : metaOf(state));
  }
}

/** Rows that hold back a level that gives way or is minimised. */
function blockers({ status, blocked }: LevelState): LevelState["blocked"] {
  return status === "gives way" || status === "minimised" ? blocked : [];
}

/** What holds a level back, and at what cost; the control loop's estimate until the exact costs are known. */
export function heldText(state: LevelState, all: LevelState[]): string {
  const rows = blockers(state), { others, unit } = state;
  if (rows.length === 0) return "";
  const isExact = others !== undefined;
  const amount = (cost: number): string => {
    if (Number.isNaN(cost)) return " at a cost that is not known";
    if (cost > 0) return ` costs ${isExact ? "" : "about "}${quantity(cost, unit)}`;
    return isExact ? " costs nothing alone" : "";
  };
  const texts = rows.map(({ by, row, cost }) => `${nameOf(all, by)}: ${row}${amount(cost)}`);
  const whole = `held back by ${[...texts, ...(others ? [`${others} more`] : [])].join("; ")}`;
  return isExact ? whole : `${whole} (the control loop's estimate)`;
}

/** What matters most of a level, in a few words. */
export function briefOf(state: LevelState, all: LevelState[]): string {
  const [first] = state.active;
  const above = [...new Set(blockers(state).map(({ by }) => nameOf(all, by)))];
  if (above.length > 0) return `${state.status === "gives way" ? "to" : "held back by"} ${above.join(", ")}`;
  if (first !== undefined) return `${state.active.length > 1 ? `${state.active.length} rows: ` : ""}${first.name} ${sideOf(first.state)}${state.active.length > 1 ? ", …" : ""}`;
  return state.rows === 0 ? "" : counted(state.rows, "row");
}

/** Solving time of a level; "–": not measured. */
export function timeOf({ rows, time }: Pick<LevelState, "rows" | "time">): string {
  if (rows === 0) return "";
  return Number.isNaN(time) ? "–" : quantity(time, "µs");
}

/** Size of a level, and the freedom that it leaves. */
export function metaOf({ rows, freedom, iterations }: LevelState): string {
  return `${counted(rows, "row")} · leaves ${counted(freedom, "degree")} of freedom to the levels below · ${counted(iterations, "iteration")}`;
}

function sideOf(bound: number): string {
  return bound <= -3 ? "(below it)" : bound >= 3 ? "(above it)" : bound < 0 ? "(lower)" : "(upper)";
}

/** Whether the limits are of lengths or angles: these bound accelerations, so that the motion stops before the limit. */
export function boundsMotion({ unit }: Pick<LevelState, "unit">): boolean {
  return unit.endsWith("/s²");
}

/** State of a row at its bound; `isMotion`: of a length or angle, which may still have room. */
export function words(bound: number, isMotion: boolean): string {
  const side = bound < 0 ? "above its lower bound" : "below its upper bound";
  if (isMotion) return Math.abs(bound) >= 3 ? `not kept ${side}` : `kept ${side}`;
  return bound <= -3 ? "below its bound" : bound >= 3 ? "above its bound" : bound < 0 ? "at its lower bound" : "at its upper bound";
}

/** How far a row is beyond its bound. */
export function amountOf({ state, by }: Pick<RowNote, "state" | "by">, unit: string): string {
  return Math.abs(state) < 3 || Number.isNaN(by) ? "" : ` by ${quantity(Math.abs(by), unit)}`;
}

/** Rows at their limits, and equality rows that the level missed. */
export function rowsOf(state: Pick<LevelState, "active" | "missed" | "status" | "unit">): string {
  const limits = state.active.map((row) => `${row.name} ${words(row.state, boundsMotion(state))}${amountOf(row, state.unit)}`);
  const missed = state.status === "gives way" ? state.missed.map(({ name, by }) => `${name} missed by ${quantity(Math.abs(by), state.unit)}`) : [];
  return [...limits, ...missed].join(", ");
}
