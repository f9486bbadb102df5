import type { ConnectionState } from "../protocol/connection.ts";
import { secondsText } from "../data/numbers.ts";
import { part, setText } from "./dom.ts";

/** How long nothing has arrived [s]; followed by `timeText`. */
export function staleText(ago: number): string {
  return `Nothing new for ${ago} s`;
}

/** Time of the numbers in the panels; NaN: there are none. */
export function timeText(time: number): string {
  return Number.isNaN(time) ? "" : `: all numbers are from ${secondsText(time)} of the run.`;
}

/** Shows the time of the numbers, which may be of the past. */
export function showTime(time: number): void {
  setText(part("stale-time"), timeText(time));
}

/** Advice while the program does not answer. */
export const NO_ANSWER =
  "The program does not answer. Look in its terminal whether it still runs and is not stopped (^Z); over ssh, whether the port is still forwarded. The page waits for it.";

export interface Link {
  state: ConnectionState;
  silence: number;
  quiet: number;
  reason: string;
}

/** Text above the numbers: why there are none, or that they are old; `last`: time of the newest, NaN: there is none. */
export function linkText({ state, silence, quiet, reason }: Link, last: number): string {
  const away = silence > 0 || state === "lost";
  if (!Number.isNaN(last)) return away ? staleText(quiet) : "";
  if (state === "lost") return `No numbers here: ${reason === "" ? "there is no connection to the program" : reason}.`;
  if (silence > 0) return "No numbers yet: the program does not answer.";
  return state === "connecting" ? "Connecting to the program …" : "";
}

/** Shows the text; `old` numbers lose their colours. */
export function showLink(text: string, old: boolean): void {
  const note = part("stale");
  note.hidden = text === "";
  setText(part("stale-text"), text);
  document.body.classList.toggle("stale", old);
}
