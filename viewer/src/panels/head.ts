import { endingText, weightOf } from "../data/mark_columns.ts";
import type { Player } from "../data/player.ts";
import { h, part, say } from "./dom.ts";
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

/** Why a run has ended, or that its log does not say so; "": it has not. */
export function endFact(why: string, cut: string): string {
  if (why !== "") return endingText(why);
  return cut === "" ? "" : "cut off or never closed: how it ended is not known";
}

/** What is to be known beside it; where there is no room for all, it is told to a pointer. `end`: the one of how a run ended, which is to be seen. */
export function showFacts(facts: string[], end: string): void {
  const told = facts.filter((one) => one !== "");
  const text = told.join(" · ");
  const line = part("head-facts");
  if (line.textContent === text) return;
  const weight = weightOf({ kind: "end", text: end });
  line.replaceChildren(...told.flatMap((one, k) => [...(k === 0 ? [] : [" · "]), one === end ? h("strong", { "data-weight": weight }, one) : one]));
  line.title = text;
}
