import { scalar, type Frame } from "../data/frame.ts";
import { accountOf, levelStates, nameOf, type LevelState } from "../data/hierarchy.ts";
import { moved } from "../data/reorder.ts";
import { Wish } from "../data/wish.ts";
import { counted, digits, quantity } from "../data/numbers.ts";
import { h, plain, say } from "./dom.ts";

/** Sign and word of each status: colour is never the only sign. */
const SIGNS = { met: "✓", "at limit": "▲", "gives way": "✕", minimised: "·", "no rows": "–" } as const;

/** The levels in order: how each came out, which rows are active, and what held it back. */
export class HierarchyPanel {
  onOrder: (levels: string[]) => void = () => {};
  private readonly account = h("p", { class: "account", id: "account" });
  private readonly facts = h("p", { class: "facts" });
  private readonly list = h("ol", { class: "levels", "aria-label": "levels, highest priority first" });
  private cards: LevelCard[] = [];
  private names = "";
  private reordering = false;
  /** The order that the program had last, and what was asked of it since. */
  newest: string[] = [];
  readonly wish = new Wish<string[]>();
  /** Whether the run stands, so that no order comes to effect. */
  paused = false;

  constructor(root: HTMLElement) {
    root.append(this.account, this.facts, this.list);
    this.clear();
  }

  /** Says nothing until the next tick. */
  clear(): void {
    this.account.hidden = this.facts.hidden = this.list.hidden = true;
  }

  /** Whether the order may be changed here. */
  set canReorder(can: boolean) {
    if (this.reordering === can) return;
    this.reordering = can;
    this.list.classList.toggle("movable", can);
    for (const card of this.cards) card.root.draggable = can;
  }

  show(frame: Frame): void {
    const states = levelStates(frame);
    const names = states.map((state) => state.name).join();
    if (names !== this.names) this.build(states, names);
    states.forEach((state, k) => this.cards[k]?.show(state, states));
    this.account.hidden = this.facts.hidden = this.list.hidden = false;
    say(this.account, accountOf(states));
    this.account.classList.toggle("bad", states.some((state) => state.status === "gives way"));
    const solve = scalar(frame, "timings.solve");
    const total = scalar(frame, "timings.total");
    const iterations = states.reduce((sum, state) => sum + (state.iterations || 0), 0);
    const solveText = Number.isNaN(solve) ? "" : `Solved in ${digits(solve)} of the tick's ${digits(total)} µs, `;
    say(this.facts, `${solveText}${counted(iterations, "iteration")}`);
  }

  private build(states: LevelState[], names: string): void {
    this.names = names;
    this.cards = states.map((state, k) => new LevelCard(state.name, k, states.length, (name, steps) => this.move(name, steps), (name, at) => this.moveTo(name, at)));
    for (const card of this.cards) card.root.draggable = this.reordering;
    this.list.replaceChildren(...this.cards.map((card) => card.root));
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

  private moveTo(name: string, place: string): void {
    const { order } = this;
    if (order.includes(place)) this.move(name, order.indexOf(place) - order.indexOf(name));
  }
}

class LevelCard {
  readonly root: HTMLLIElement;
  private readonly sign = h("span", { class: "sign", "aria-hidden": "true" });
  private readonly status = h("span", { class: "status" });
  private readonly residual = h("span", { class: "residual" });
  private readonly meta = h("span", { class: "meta" });
  private readonly rows = h("p", { class: "rows" });
  private readonly blocked = h("p", { class: "blocked" });

  constructor(
    name: string,
    index: number,
    count: number,
    move: (name: string, steps: number) => void,
    moveTo: (name: string, place: string) => void,
  ) {
    const button = (text: string, steps: number, label: string): HTMLButtonElement =>
      h("button", {
        class: "small", "aria-label": `${plain(name)}: ${label}`, title: label,
        disabled: index + steps < 0 || index + steps >= count, onclick: () => move(name, steps),
      }, text);
    this.root = h("li", { class: "level", "data-level": name },
      h("div", { class: "level-head" },
        this.sign,
        h("span", { class: "level-name", title: plain(name) }, `${index + 1} ${plain(name)}`),
        h("span", { class: "movers" }, button("↑", -1, "one up"), button("↓", 1, "one down")),
        this.residual,
      ),
      h("div", { class: "level-facts" }, this.status, this.meta),
      this.rows, this.blocked,
    );
    this.drag(name, moveTo);
  }

  private drag(name: string, moveTo: (name: string, place: string) => void): void {
    this.root.addEventListener("dragstart", (event) => event.dataTransfer?.setData("text/plain", name));
    this.root.addEventListener("dragover", (event) => {
      event.preventDefault();
      this.root.classList.add("drop");
    });
    this.root.addEventListener("dragleave", () => this.root.classList.remove("drop"));
    this.root.addEventListener("drop", (event) => {
      event.preventDefault();
      this.root.classList.remove("drop");
      moveTo(event.dataTransfer?.getData("text/plain") ?? "", name);
    });
  }

  show(state: LevelState, all: LevelState[]): void {
    const kind = state.status.replaceAll(" ", "-");
    if (this.root.dataset["status"] !== kind) this.root.dataset["status"] = kind;
    say(this.sign, SIGNS[state.status]);
    say(this.status, state.status);
    say(this.residual, state.rows === 0 ? "" : quantity(state.residual < 1e-9 ? 0 : state.residual, state.unit));
    say(this.meta, state.rows === 0 ? "" : `${counted(state.rows, "row")} · ${state.freedom} free below · ${counted(state.iterations, "iteration")}`);
    say(this.rows, state.active.map(({ name, state: bound }) => `${name} ${words(bound)}`).join(", "));
    const blocked = state.status === "met" || state.status === "no rows" ? [] : state.blocked;
    say(this.blocked, blocked.map(({ by, row, cost }) =>
      `held back by ${nameOf(all, by)}: ${row} costs ${quantity(cost, state.unit)}`).join("; "));
  }
}

function words(bound: number): string {
  return bound <= -3 ? "below its bound" : bound >= 3 ? "above its bound" : bound < 0 ? "at its lower bound" : "at its upper bound";
}
