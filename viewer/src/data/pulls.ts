import type { Mark } from "./source.ts";

const BEGIN = "pull at ";
const END = "the pull ends ";

/** Whether the operator pulls the robot in the frame at `time`, as the changes of the run have it; those of the frames lie `period` apart. */
export function isPulled(marks: Mark[], time: number, period: number): boolean {
  for (let i = marks.length - 1; i >= 0; --i) {
    const { kind, text, time: at } = marks[i] as Mark;
    if (kind !== "change" || at > time + 0.5 * period) continue;
    if (text.startsWith(BEGIN)) return true;
    // The frame at the end still has the force that acted up to it.
    if (text.startsWith(END)) return at > time - 0.5 * period;
  }
  return false;
}
