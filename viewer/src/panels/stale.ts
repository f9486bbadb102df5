import type { ConnectionState } from "../protocol/connection.ts";
import { part, say } from "./dom.ts";

/** How old the numbers are: the run's time when they came, and seconds since. */
export function staleText(time: number, ago: number): string {
  return `Nothing new for ${ago} s: all numbers are from ${time.toFixed(3)} s of the run.`;
}

/** What to look at where the program says nothing. */
export const NO_ANSWER =
  "The program does not answer. Look in its terminal whether it still runs and is not stopped (^Z); over ssh, whether the port is still forwarded. The page waits for it.";

export interface Link {
  state: ConnectionState;
  silence: number;
  quiet: number;
  reason: string;
}

/** What is said above the numbers: why there are none, or that they are old; `last`: time of the newest, NaN: there is none. */
export function linkText({ state, silence, quiet, reason }: Link, last: number): string {
  const away = silence > 0 || state === "lost";
  if (!Number.isNaN(last)) return away ? staleText(last, quiet) : "";
  if (state === "lost") return `No numbers here: ${reason === "" ? "there is no connection to the program" : reason}.`;
  if (silence > 0) return "No numbers yet: the program does not answer.";
  return state === "connecting" ? "Connecting to the program …" : "";
}

/** Says it; the colours of numbers that are `old` are taken away. */
export function showLink(text: string, old: boolean): void {
  const note = part("stale");
  note.hidden = text === "";
  say(note, text);
  document.body.classList.toggle("stale", old);
}
