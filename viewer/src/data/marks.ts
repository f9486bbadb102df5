import { LEGS } from "./schema.ts";
import { scalar, word, type Frame } from "./frame.ts";
import type { Mark } from "./source.ts";

/** Finds marks in frames as they come: the planner's events and changes of the command's mode. */
export class MarkFinder {
  readonly marks: Mark[] = [];
  private mode = "";
  private phases = ["", "", "", ""];

  see(frame: Frame): void {
    const event = scalar(frame, "plan.event");
    const leg = this.changedLeg(frame);
    if (event > 0)
      this.marks.push({ time: frame.time, text: frame.schema.events[event] ?? `event ${event}`, leg, kind: "event" });
    const mode = word(frame, "command.mode");
    if (mode !== this.mode && this.mode !== "")
      this.marks.push({ time: frame.time, text: `command: ${mode}`, leg: "", kind: "mode" });
    this.mode = mode;
  }

  /** The leg whose phase changes with this frame, as the events' leg; "" where it isn't one. */
  private changedLeg(frame: Frame): string {
    const phases = LEGS.map((leg) => word(frame, `plan.feet.${leg}.phase`));
    const changed = LEGS.filter((_, k) => phases[k] !== this.phases[k] && this.phases[k] !== "");
    this.phases = phases;
    return changed.length === 1 ? (changed[0] as string) : "";
  }

  clear(): void {
    this.marks.length = 0;
    this.mode = "";
    this.phases = ["", "", "", ""];
  }

  dropBefore(time: number): void {
    const kept = this.marks.findIndex((mark) => mark.time >= time);
    if (kept > 0) this.marks.splice(0, kept);
    else if (kept < 0) this.marks.length = 0;
  }
}

type RawEvent = [number, string | number, string | number | null] | { time: number; kind: "mode" | "change" | "damage"; text: string };

/** What `/api/events` answers, as marks. */
export function marksOf(raw: RawEvent[], events: string[]): Mark[] {
  return raw.map((entry) => {
    if (!Array.isArray(entry)) return { time: entry.time, text: entry.text, leg: "", kind: entry.kind };
    const [time, event, leg] = entry;
    const text = typeof event === "number" ? (events[event] ?? `event ${event}`) : event;
    const name = typeof leg === "number" ? (LEGS[leg] ?? "") : (leg ?? "");
    return { time, text, leg: name, kind: "event" as const };
  });
}
