import { scalar, type Frame } from "../data/frame.ts";
import { accountAt, levelStates, type LevelState } from "../data/hierarchy.ts";
import { Wish } from "../data/wish.ts";
import { counted, digits } from "../data/numbers.ts";
import { h, setText } from "./dom.ts";
import { LevelCard } from "./level_card.ts";

/** The levels in order: how each came out, which rows are active, and what held it back. */
export class HierarchyPanel {
  onOrder: (levels: string[]) => void = () => {};
  private readonly line = h("p", { class: "account-line" });
  private readonly account = h("div", { class: "account", id: "account" }, this.line);
  private readonly facts = h("p", { class: "facts" });
  private readonly list = h("ol", { class: "levels", "aria-label": "levels, highest priority first" });
  private cards: LevelCard[] = [];
  private names = "";
  /** Last order of the program. */
  newest: string[] = [];
  readonly wish = new Wish<string[]>();
  /** Whether the run is paused, so that no order takes effect. */
  paused = false;

  /** `isCut`: the log lacks its end, where the times of the ticks stand. */
  constructor(root: HTMLElement, private readonly isCut = false) {
    root.append(this.account, this.facts, this.list);
    this.clear();
  }

  /** The run begins again, with its scenario's order: hidden until the next tick. */
  clear(): void {
    this.wish.drop();
    this.account.hidden = this.facts.hidden = this.list.hidden = true;
  }

  /** Whether the order may be changed here. */
  set canReorder(can: boolean) {
    this.list.classList.toggle("movable", can);
  }

  show(frame: Frame, states = levelStates(frame), account = accountAt(frame, states)): void {
    const names = states.map((state) => state.name).join();
    if (names !== this.names) this.build(states, names);
    states.forEach((state, k) => this.cards[k]?.show(state, states));
    this.account.hidden = this.facts.hidden = this.list.hidden = false;
    this.account.dataset["kind"] = account.kind;
    setText(this.line, account.line);
    this.line.title = account.line; // three lines are visible
    setText(this.facts, effortOf(scalar(frame, "timings.solve"), scalar(frame, "timings.total"), states, this.isCut));
  }

  private build(states: LevelState[], names: string): void {
    this.names = names;
    const before = new Map(this.cards.map((card) => [card.name, card]));
    this.cards = states.map(({ name }, k) => new LevelCard(name, k, (steps) => this.move(name, steps)));
    const focus = this.cards.map((card) => card.follow(before.get(card.name)));
    this.list.replaceChildren(...this.cards.map((card) => card.root));
    for (const button of focus) button?.focus();
  }

  private get order(): string[] {
    return this.wish.or(this.newest, this.paused);
  }

  private move(name: string, steps: number): void {
    const levels = moved(this.order, name, steps);
    if (levels === undefined) return;
    this.wish.ask(levels);
    this.onOrder(levels);
  }
}

/** Moves a name `steps` down; undefined where that is not possible. */
export function moved(names: string[], name: string, steps: number): string[] | undefined {
  const from = names.indexOf(name), to = from + steps;
  if (from < 0 || to < 0 || to >= names.length) return undefined;
  const order = names.toSpliced(from, 1);
  order.splice(to, 0, name);
  return order;
}

const NO_TIMES = "no times: they stand at a log's end, and this one has none";

/** Text of a tick's times `solve` and `total` [µs], NaN: not known; `isCut`: because the log has no end. */
export function effortOf(solve: number, total: number, states: Pick<LevelState, "rows" | "iterations">[], isCut = false): string {
  if (states.every(({ rows }) => rows === 0)) return Number.isNaN(total) ? "" : `Tick: ${digits(total)} µs`;
  const iterations = counted(states.reduce((sum, state) => sum + (state.iterations || 0), 0), "iteration");
  if (Number.isNaN(solve + total)) return isCut ? `${iterations} · ${NO_TIMES}` : iterations;
  return `All levels: ${digits(solve)} µs, ${iterations} · tick: ${digits(total)} µs`;
}
