import { scalar, type Frame } from "../data/frame.ts";
import { accountAt, levelStates, type LevelState } from "../data/hierarchy.ts";
import { moved } from "../data/reorder.ts";
import { Wish } from "../data/wish.ts";
import { counted, digits } from "../data/numbers.ts";
import { AccountView } from "./account_view.ts";
import { h, say } from "./dom.ts";
import { LevelCard, type Moves } from "./level_card.ts";

/** The levels in order: how each came out, which rows are active, and what held it back. */
export class HierarchyPanel {
  /** `level`: the one that is moved. */
  onOrder: (levels: string[], level: string) => void = () => {};
  private readonly account = new AccountView();
  private readonly facts = h("p", { class: "facts" });
  private readonly list = h("ol", { class: "levels", "aria-label": "levels, highest priority first" });
  private cards: LevelCard[] = [];
  private names = "";
  private reordering = false;
  /** The level that the pointer has: all stand still under it. */
  private lifted: string | undefined;
  private readonly moves: Moves = {
    move: (name, steps) => this.move(name, steps),
    lift: (name) => (this.lifted = name),
    drop: () => (this.lifted = undefined),
    isLifted: () => this.reordering && this.lifted !== undefined,
    putAt: (name) => this.putAt(name),
  };
  private physics: ReadonlySet<string> = new Set();
  /** The order that the program had last, and what was asked of it since. */
  newest: string[] = [];
  readonly wish = new Wish<string[]>();
  /** Whether the run stands, so that no order comes to effect. */
  paused = false;

  /** `isCut`: of a log without its end, which has the times of all ticks. */
  constructor(root: HTMLElement, private readonly isCut = false) {
    root.append(this.account.root, this.facts, this.list);
    this.clear();
  }

  /** The run begins again, with the order of its scenario: nothing is said until the next tick. */
  clear(): void {
    this.lifted = undefined;
    this.wish.drop();
    this.account.root.hidden = this.facts.hidden = this.list.hidden = true;
  }

  /** Whether the order may be changed here. */
  set canReorder(can: boolean) {
    if (this.reordering === can) return;
    this.reordering = can;
    this.list.classList.toggle("movable", can);
    this.letDrag();
  }

  /** Levels that keep the physics: they have a place that nobody changes. */
  fix(names: string[]): void {
    this.physics = new Set(names);
    this.names = "";
  }

  /** Gives the line over the levels. */
  show(frame: Frame, states = levelStates(frame), account = accountAt(frame, states)): string {
    if (this.lifted !== undefined) return account.line;
    const names = states.map((state) => state.name).join();
    if (names !== this.names) this.build(states, names);
    states.forEach((state, k) => this.cards[k]?.show(state, states));
    this.account.root.hidden = this.facts.hidden = this.list.hidden = false;
    this.account.show(account);
    say(this.facts, effortOf(scalar(frame, "timings.solve"), scalar(frame, "timings.total"), states, this.isCut));
    return account.line;
  }

  private build(states: LevelState[], names: string): void {
    this.names = names;
    const before = new Map(this.cards.map((card) => [card.name, card]));
    const order = states.map(({ name }) => name);
    this.cards = order.map((name, k) => new LevelCard(name, k, order, this.physics, this.moves));
    this.letDrag();
    const focus = this.cards.map((card) => card.follow(before.get(card.name)));
    this.list.replaceChildren(...this.cards.map((card) => card.root));
    for (const button of focus) button?.focus();
  }

  private letDrag(): void {
    for (const card of this.cards) card.root.draggable = this.reordering && card.canMove;
  }

  private get order(): string[] {
    return this.wish.or(this.newest, this.paused);
  }

  private move(name: string, steps: number): void {
    const levels = moved(this.order, name, steps);
    if (levels === undefined) return;
    this.wish.ask(levels);
    this.onOrder(levels, name);
  }

  private putAt(place: string): void {
    const { order, lifted } = this;
    this.lifted = undefined;
    if (lifted !== undefined && order.includes(place)) this.move(lifted, order.indexOf(place) - order.indexOf(lifted));
  }
}

const NO_TIMES = "no times: they stand at a log's end, and this one has none";

/** What the tick cost: `solve` and `total` [µs], NaN where they aren't known; `isCut`: as the log has no end. */
export function effortOf(solve: number, total: number, states: Pick<LevelState, "rows" | "iterations">[], isCut = false): string {
  if (states.every(({ rows }) => rows === 0)) return Number.isNaN(total) ? "" : `Tick: ${digits(total)} µs`;
  const iterations = counted(states.reduce((sum, state) => sum + (state.iterations || 0), 0), "iteration");
  if (Number.isNaN(solve + total)) return isCut ? `${iterations} · ${NO_TIMES}` : iterations;
  return `All levels: ${digits(solve)} µs, ${iterations} · tick: ${digits(total)} µs`;
}
