import { capitalised } from "../data/log_words.ts";
import { h, part, setText } from "./dom.ts";

/** Most short messages; more remove the oldest, errors last. */
const MOST_SHORT = 5;
type Kind = "error" | "plain";

/** Messages in a corner of the picture. Those with a key stay until they are taken back or dismissed. */
export class Notes {
  private readonly root = part("notes");
  private readonly kept = new Map<string, Note>();
  /** Dismissed texts, by key. */
  private readonly dismissed = new Map<string, string>();
  private short: Note[] = [];

  /** Shows a short message. A repeated message is counted; a new one of the same `topic` replaces the old. */
  say(text: string, kind: Kind = "plain", topic?: string): void {
    let note = this.short.find((one) => one.kind === kind && (one.text === text || (topic !== undefined && one.topic === topic)));
    if (note === undefined) this.short.push((note = new Note(kind)));
    else if (note.text === text) note.count();
    note.topic = topic;
    this.root.append(note.root);
    note.show(text);
    const said = note;
    note.forget(() => this.drop(said), kind === "error" ? 8000 : 4000);
    if (this.short.length > MOST_SHORT) this.drop(this.leastNeeded);
  }

  private get leastNeeded(): Note {
    return this.short.find(({ kind }) => kind === "plain") ?? (this.short[0] as Note);
  }

  private drop(note: Note): void {
    note.root.remove();
    this.short = this.short.filter((one) => one !== note);
  }

  keep(key: string, text: string, kind: Kind = "plain"): void {
    if (this.dismissed.get(key) === text) return;
    let note = this.kept.get(key);
    if (note === undefined || note.kind !== kind) {
      this.take(key);
      note = new Note(kind, key, () => this.dismiss(key));
      this.kept.set(key, note);
      this.root.prepend(note.root);
    }
    note.show(text);
  }

  take(key: string): void {
    this.kept.get(key)?.root.remove();
    this.kept.delete(key);
    this.dismissed.delete(key);
  }

  private dismiss(key: string): void {
    const text = this.kept.get(key)?.text ?? "";
    this.take(key);
    this.dismissed.set(key, text);
  }
}

/** A message; a long one is cut, with a button for the rest. */
class Note {
  readonly root: HTMLElement;
  text = "";
  topic: string | undefined;
  private readonly words = h("span", { class: "note-text" });
  private readonly times = h("b", { class: "times", hidden: true });
  private readonly more = h("button", { class: "small", "aria-expanded": "false", onclick: () => this.open() }, "more");
  private said = 1;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private drop: () => void = () => {};

  constructor(readonly kind: Kind, key?: string, dismiss?: () => void) {
    const close = dismiss && h("button", { class: "small close", "aria-label": "take this message away", onclick: dismiss }, "×");
    this.root = h("p", { class: `note ${kind} ${key === undefined ? "short" : "kept"}`, "data-note": key }, this.words, this.times, this.more, close);
  }

  /** Call it when the note is in the page, so that its text can be measured. */
  show(text: string): void {
    if (this.text === text) return;
    this.text = text;
    this.said = 1;
    this.times.hidden = true;
    setText(this.words, capitalised(text));
    this.more.hidden = this.words.scrollHeight <= this.words.clientHeight + 1;
  }

  count(): void {
    this.times.hidden = false;
    setText(this.times, `× ${++this.said}`);
  }

  /** Drops the note after a while [ms], unless it is open. */
  forget(drop: () => void, after: number): void {
    this.drop = drop;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.root.classList.contains("open") || drop(), after);
  }

  private open(): void {
    const open = this.root.classList.toggle("open");
    if (!open) this.drop();
    this.more.setAttribute("aria-expanded", String(open));
    setText(this.more, open ? "less" : "more");
  }
}
