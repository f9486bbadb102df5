import { againText, logText, recordingText } from "../data/log_words.ts";
import type { Session } from "../protocol/session.ts";

/** Facts that become known only during a run. */
export interface Progress {
  /** The log of a live run; "": it is not recorded. */
  recording: string;
  hasEnded: boolean;
  /** Why it ended. */
  ended: string;
  /** The run was changed from outside. */
  isSteered: boolean;
  /** Text on missing meshes. */
  missing: string;
}

/** What a run is, in names and texts; "": not known. */
export function aboutRun({ header, version, source, cut, damage }: Session, { recording, hasEnded, ended, isSteered, missing }: Progress): [string, string][] {
  const isLog = source !== "";
  return [
    ["Scenario", `${header.scenario}: ${header.description}`], ["Seed", String(header.seed)], ["Stack", header.stack],
    ["Robot", `${header.robot.name}, ${header.robot.mass.toFixed(1)} kg`], ["Estimation", header.estimation],
    ["Log", !isLog ? recordingText(recording, hasEnded) : logText(source, cut, damage)],
    ["Ended", ended !== "" || cut === "" ? ended : "not known: see Log"], ["Meshes", missing],
    ["Again", againText(header.command, source || recording, cut === "", isSteered, isLog || hasEnded)],
    ["Version", version],
  ];
}
