import { endingText } from "../data/mark_columns.ts";
import type { Player } from "../data/player.ts";
import { part, say } from "./dom.ts";
import type { Course } from "./transport.ts";

const MODES: Record<Course, string> = { runs: "live", paused: "paused", ended: "ended", unheard: "not known" };

/** How a live run goes on, in a word or two. */
export function modeText({ past }: Pick<Player, "past">, course: Course): string {
  return past ? "past" : MODES[course];
}

export function showMode(player: Pick<Player, "past">, course: Course): void {
  const badge = part("mode");
  badge.dataset["state"] = player.past ? "past" : course;
  say(badge, modeText(player, course));
  badge.title = !player.past && course === "unheard" ? "how the run goes on is not known" : "";
}

/** Why a run has ended; "": it has not, or nobody knows. */
export const endFact = (why: string): string => (why === "" ? "" : endingText(why));

/** What is to be known beside it; where there is no room for all, it is told to a pointer. */
export function showFacts(facts: string[]): void {
  const text = facts.filter((one) => one !== "").join(" · ");
  const line = part("head-facts");
  say(line, text);
  if (line.title !== text) line.title = text;
}
