import type { Mark } from "./source.ts";

/** What the marks of a run tell of the forces from outside at a time. */
export interface ToldForces {
  /** Body that the operator pulls; undefined: none. */
  pulled: string | undefined;
  /** What that pull gives as a whole [N·s]; undefined as long as it has not ended. */
  given: number | undefined;
  /** Bodies that the operator or the scenario pushes. */
  pushed: Set<string>;
}

/** Of the frame at `time`, where frames lie `period` apart: the frame at the end of a force still has it. */
export function toldForces(marks: Mark[], time: number, period: number): ToldForces {
  const told: ToldForces = { pulled: undefined, given: undefined, pushed: new Set() };
  const scenario = new Set<string>();
  const before = time - 0.5 * period, after = time + 0.5 * period;
  let hasEnded = false;
  for (const { force, time: at } of marks) {
    if (force === undefined) continue;
    const { kind, body, begins, duration = 0, given } = force;
    if (kind === "push") {
      if (at <= after && at + duration > before) told.pushed.add(body);
    } else if (kind === "scenario") {
      if (begins && at <= after) scenario.add(body);
      else if (!begins && at <= before) scenario.delete(body);
    } else if (begins && at <= after) {
      told.pulled = body;
      told.given = undefined;
      hasEnded = false;
    } else if (!begins && !hasEnded) {
      hasEnded = at > before;
      if (!hasEnded) told.pulled = undefined;
      else if (told.pulled !== undefined) told.given = given;
    }
  }
  for (const body of scenario) told.pushed.add(body);
  return told;
}

/** A push of the operator or the scenario that is over. */
export interface SpentForce {
  body: string;
  begin: number;
  end: number;
}

/** Of each body the latest push that ended after `since` and does not act any more in the frame at `time`. */
export function spentForces(marks: Mark[], since: number, time: number, period: number): SpentForce[] {
  const spent = new Map<string, SpentForce>(), begun = new Map<string, number>();
  for (const { force, time: at } of marks) {
    if (force === undefined || force.kind === "pull") continue;
    const { kind, body, begins, duration = 0 } = force;
    if (kind === "scenario" && begins) begun.set(body, at);
    const [begin, end] = kind === "push" ? [at, at + duration] : [begun.get(body) ?? at, begins ? Infinity : at];
    if (end > since && end <= time - 0.5 * period) spent.set(body, { body, begin, end });
  }
  return [...spent.values()];
}

/** What stands beside the arrow of a push that is over. */
export function spentText(size: string, { begin, end }: SpentForce): string {
  return `pushed ${size} for ${Number((end - begin).toFixed(3))} s`;
}

/** What stands beside the arrow of the force on a body. */
export function forceText(body: string, size: string, { pulled, given, pushed }: ToldForces): string {
  if (pulled !== body) return `push ${size}`;
  if (pushed.has(body)) return `pull and push ${size}`;
  return `pull ${size}${given === undefined ? "" : ` (of ${given.toFixed(1)} N·s in all)`}`;
}
