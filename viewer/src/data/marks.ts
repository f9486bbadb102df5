import { endingText } from "./mark_columns.ts";
import type { Mark } from "./source.ts";

export type RawEvent = [time: number, event: number, leg: string | null] | { time: number; kind: "mode" | "change" | "damage" | "force"; text: string };

/** Mark of the end of a run, with its reason. */
export function endOf(time: number, why: string): Mark {
  return { time, text: endingText(why), leg: "", kind: "end" };
}

/** The program's events as marks. */
export function marksOf(raw: RawEvent[], events: string[]): Mark[] {
  return raw.map((entry) => {
    if (!Array.isArray(entry)) return { time: entry.time, text: entry.text, leg: "", kind: entry.kind };
    const [time, event, leg] = entry;
    return { time, text: events[event] ?? `event ${event}`, leg: leg ?? "", kind: "event" as const };
  });
}
