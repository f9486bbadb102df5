import { withTold, type Change } from "../data/changes.ts";
import { h } from "./dom.ts";

/** As many as the program tells a page that comes late. */
const MOST = 200;

/** What was changed in this run, the latest first, and over it what the next tick will take. */
export class ChangeList {
  readonly root: HTMLElement;
  private readonly none = h("p", { class: "soft" }, "No change so far.");
  private readonly list = h("ol", { class: "changes", "aria-label": "changes so far, the latest first" });
  private changes: Change[] = [];
  private pending = "";

  constructor() {
    this.root = h("div", {}, this.none, this.list);
  }

  add(change: Change): void {
    this.show([...this.changes, change]);
  }

  /** What the program has heard of, before this page came or meanwhile. */
  remember(changes: Change[]): void {
    this.show(withTold(this.changes, changes));
  }

  /** What is wanted and no tick has taken yet; "": nothing. */
  wait(pending: string): void {
    if (pending === this.pending) return;
    this.pending = pending;
    this.show(this.changes);
  }

  clear(): void {
    this.pending = "";
    this.show([]);
  }

  private show(changes: Change[]): void {
    this.changes = changes.slice(-MOST);
    const lines = this.changes.map(({ time, text }) => line(`${time.toFixed(2)} s`, text));
    if (this.pending !== "") lines.push(line("with the next tick", this.pending, "pending"));
    this.list.replaceChildren(...lines.reverse());
    this.none.hidden = lines.length > 0;
  }
}

function line(when: string, text: string, kind?: string): HTMLElement {
  return h("li", { class: kind }, h("span", { class: "soft" }, `${when} `), text);
}
