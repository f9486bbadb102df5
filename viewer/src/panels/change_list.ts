import { secondsText } from "../data/numbers.ts";
import { Changes, folded, type Change } from "../data/changes.ts";
import { h, say } from "./dom.ts";

/** So many lines stand there unless all are asked for: what can be changed stands below them. */
const MOST_LINES = 5;

/** What was changed in this run, the latest first, and over it what the next tick will take. */
export class ChangeList {
  readonly root: HTMLElement;
  private readonly none = h("p", { class: "soft" }, "No change so far.");
  private readonly list = h("ol", { class: "changes", "aria-label": "changes so far, the latest first" });
  private readonly button = h("button", { class: "small", id: "all-changes", "aria-expanded": "false", hidden: true, onclick: () => this.open() });
  private readonly changes: Changes;
  private isOpen = false;
  private pending = "";

  /** `most`: as many as are kept, the latest. */
  constructor(most: number) {
    this.changes = new Changes(most);
    this.root = h("div", {}, this.none, this.list, this.button);
  }

  hear(change: Change): void {
    this.changes.hear(change);
    this.show();
  }

  /** What the program has heard of, before this page came or meanwhile. */
  recall(changes: Change[]): void {
    this.changes.recall(changes);
    this.show();
  }

  /** What is wanted and no tick has taken yet; "": nothing. */
  wait(pending: string): void {
    if (pending === this.pending) return;
    this.pending = pending;
    this.show();
  }

  clear(): void {
    this.pending = "";
    this.changes.clear();
    this.show();
  }

  private open(): void {
    this.isOpen = !this.isOpen;
    this.button.setAttribute("aria-expanded", String(this.isOpen));
    this.show();
  }

  private show(): void {
    const lines = folded(this.changes.all).map(({ time, text }) => line(secondsText(time), text));
    if (this.pending !== "") lines.push(line("with the next tick", this.pending, "pending"));
    lines.reverse().forEach((one, k) => (one.hidden = !this.isOpen && k >= MOST_LINES));
    this.list.replaceChildren(...lines);
    this.button.hidden = lines.length <= MOST_LINES;
    say(this.button, this.isOpen ? `only the latest ${MOST_LINES}` : `all ${lines.length}`);
    this.none.hidden = lines.length > 0;
  }
}

function line(when: string, text: string, kind?: string): HTMLElement {
  return h("li", { class: kind }, h("span", { class: "soft" }, `${when} `), text);
}
