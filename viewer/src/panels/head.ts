import { endingText, weightOf } from "../data/mark_columns.ts";
import type { Player } from "../data/player.ts";
import { h, part, setText } from "./dom.ts";
import type { RunState } from "./transport.ts";

const MODES: Record<RunState, string> = { runs: "live", paused: "paused", ended: "ended", unheard: "not known" };

/** State of a live run, in a word or two; `calibrates`: the robot calibrates before it walks. */
export function modeText({ past }: Pick<Player, "past">, runState: RunState, calibrates = false): string {
  return past ? "past" : calibrates && runState === "runs" ? "calibrating" : MODES[runState];
}

/** Time left of a calibration; "": there is none, or the past is shown. */
export function calibrationText({ past }: Pick<Player, "past">, left: number | null): string {
  if (past || left === null) return "";
  return left > 0 ? `${Math.ceil(left)} s left, then it walks` : "once more";
}

export function showMode(player: Pick<Player, "past">, runState: RunState, calibrating: number | null = null): void {
  const badge = part("mode");
  const words = modeText(player, runState, calibrating !== null);
  badge.dataset["state"] = player.past ? "past" : words === "calibrating" ? words : runState;
  setText(badge, words);
  setText(part("calibration"), runState === "ended" || runState === "unheard" ? "" : calibrationText(player, calibrating));
  badge.title = !player.past && runState === "unheard" ? "how the run goes on is not known" : "";
}

/** Why a run has ended, or that its log does not say so; "": it has not. */
export function endFact(why: string, cut: string): string {
  if (why !== "") return endingText(why);
  return cut === "" ? "" : "cut off or never closed: how it ended is not known";
}

/** Shows facts; the title has those for which there is no room. `end`: the fact on how the run ended, which is highlighted. */
export function showFacts(facts: string[], end: string): void {
  const shown = facts.filter((one) => one !== "");
  const text = shown.join(" · ");
  const line = part("head-facts");
  if (line.textContent === text) return;
  const weight = weightOf({ kind: "end", text: end });
  line.replaceChildren(...shown.flatMap((one, k) => [...(k === 0 ? [] : [" · "]), one === end ? h("strong", { "data-weight": weight }, one) : one]));
  line.title = text;
}
