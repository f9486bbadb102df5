import type { Account } from "../data/hierarchy.ts";
import { h, say } from "./dom.ts";

/** One line on what the hierarchy came to, and the rest when asked for. */
export class AccountView {
  readonly root: HTMLElement;
  private readonly line = h("p", { class: "account-line" });
  private readonly button = h("button", { class: "small", "aria-expanded": "false", "aria-controls": "account-more", onclick: () => this.open() }, "more");
  private readonly list = h("ul", { id: "account-more", hidden: true });

  constructor() {
    this.root = h("div", { class: "account", id: "account" }, this.button, this.line, this.list);
  }

  show({ kind, line, more }: Account): void {
    this.root.dataset["kind"] = kind;
    say(this.line, line);
    this.line.title = line; // of a long one three lines are seen
    this.button.hidden = more.length === 0;
    this.list.hidden = this.button.hidden || this.button.getAttribute("aria-expanded") !== "true";
    while (this.list.children.length > more.length) this.list.lastElementChild?.remove();
    while (this.list.children.length < more.length) this.list.append(h("li"));
    more.forEach((text, k) => say(this.list.children[k] as Element, text));
  }

  private open(): void {
    const open = this.button.getAttribute("aria-expanded") !== "true";
    this.button.setAttribute("aria-expanded", String(open));
    this.list.hidden = !open;
    say(this.button, open ? "less" : "more");
  }
}
