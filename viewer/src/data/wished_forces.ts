import { percent } from "../math/friction.ts";
import { scalar, word, type Frame } from "./frame.ts";
import { digits } from "./numbers.ts";
import { LEG_CHANNELS, type LegChannels } from "./schema.ts";

/** What the solution asks of a foot beyond its limits; "": nothing. */
function wishOf(frame: Frame, leg: LegChannels): string {
  const beyond = word(frame, leg.beyond);
  if (beyond === "force") return `${leg.name} ${digits(scalar(frame, leg.normalForce))} N`;
  return beyond === "" ? "" : `${leg.name} ${percent(scalar(frame, leg.frictionUse))} of its pyramid`;
}

/** That the command, which is the solution's, goes with forces on feet that no ground gives, and which; "": it does not. */
export function wishesText(frame: Frame): string {
  if (word(frame, "command.mode") !== "optimal") return "";
  const wishes = LEG_CHANNELS.map((leg) => wishOf(frame, leg)).filter((wish) => wish !== "");
  return wishes.length === 0 ? "" : `, but for contact forces that no ground gives: ${wishes.join(", ")}`;
}
