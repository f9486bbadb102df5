import { part, say } from "./dom.ts";

/** How old the numbers are: the run's time when they came, and seconds since. */
export function staleText(time: number, ago: number): string {
  return `Nothing new for ${ago} s: all numbers are from ${time.toFixed(3)} s of the run.`;
}

/** Says that what is shown is old, and takes its colours away; "": it is new. */
export function showStale(text: string): void {
  const note = part("stale");
  note.hidden = text === "";
  say(note, text);
  document.body.classList.toggle("stale", text !== "");
}
