import { h, part } from "./dom.ts";

/** Short messages in a corner of the picture. Those with a key stay until they are taken away. */
export class Notes {
  private readonly root = part("notes");
  private readonly kept = new Map<string, HTMLElement>();

  say(text: string, kind: "error" | "plain" = "plain"): void {
    const note = h("p", { class: `note ${kind}` }, text);
    this.root.append(note);
    setTimeout(() => note.remove(), kind === "error" ? 8000 : 4000);
    while (this.root.children.length > 5) this.root.firstElementChild?.remove();
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
