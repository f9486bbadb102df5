import { percent } from "../math/friction.ts";
import { scalar, word, type Frame } from "./frame.ts";
import { digits } from "./numbers.ts";
import { LEG_CHANNELS, LEGS } from "./schema.ts";

/** What the solution asks of a foot beyond its limits; "": nothing. */
function wishOf(frame: Frame, k: number): string {
  const beyond = word(frame, LEG_CHANNELS.beyond[k] as string);
  if (beyond === "force") return `${LEGS[k]} ${digits(scalar(frame, LEG_CHANNELS.normalForce[k] as string))} N`;
  return beyond === "" ? "" : `${LEGS[k]} ${percent(scalar(frame, LEG_CHANNELS.frictionUse[k] as string))} of its pyramid`;
}

/** That the command, which is the solution's, goes with forces on feet that no ground gives, and which; "": it does not. */
export function wishesText(frame: Frame): string {
  if (word(frame, "command.mode") !== "optimal") return "";
  const wishes = LEGS.map((_, k) => wishOf(frame, k)).filter((wish) => wish !== "");
  return wishes.length === 0 ? "" : `, but for contact forces that no ground gives: ${wishes.join(", ")}`;
}
