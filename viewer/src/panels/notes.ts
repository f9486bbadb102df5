import { h, part } from "./dom.ts";

/** More short messages than this push the oldest of them out. */
const MOST_SHORT = 5;

/** Short messages in a corner of the picture. Those with a key stay until they are taken away. */
export class Notes {
  private readonly root = part("notes");
  private readonly kept = new Map<string, HTMLElement>();
  private short: HTMLElement[] = [];

  say(text: string, kind: "error" | "plain" = "plain"): void {
    const note = h("p", { class: `note ${kind}` }, text);
    this.root.append(note);
    this.short.push(note);
    setTimeout(() => this.drop(note), kind === "error" ? 8000 : 4000);
    if (this.short.length > MOST_SHORT) this.drop(this.short[0] as HTMLElement);
  }

  private drop(note: HTMLElement): void {
    note.remove();
    this.short = this.short.filter((one) => one !== note);
  }

  keep(key: string, text: string, kind: "error" | "plain" = "plain"): void {
    let note = this.kept.get(key);
    if (note === undefined) {
      note = h("p", { "data-note": key });
      this.kept.set(key, note);
      this.root.prepend(note);
    }
    note.className = `note ${kind}`;
    if (note.textContent !== text) note.textContent = text;
  }

  take(key: string): void {
    this.kept.get(key)?.remove();
    this.kept.delete(key);
  }
}
