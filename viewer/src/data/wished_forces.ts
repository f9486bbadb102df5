import { percent } from "../math/friction.ts";
import { scalar, word, type Frame } from "./frame.ts";
import { digits } from "./numbers.ts";
import type { LegChannels } from "./schema.ts";

/** Force beyond its limits that the solution asks of a foot; "": none. */
function wishOf(frame: Frame, leg: LegChannels): string {
  const beyond = word(frame, leg.beyond);
  if (beyond === "force") return `${leg.name} ${digits(scalar(frame, leg.normalForce))} N`;
  return beyond === "" ? "" : `${leg.name} ${percent(scalar(frame, leg.frictionUse))} of its pyramid`;
}

/** Note on contact forces of the solution that no ground can give; "": none. */
export function wishesText(frame: Frame): string {
  if (word(frame, "command.mode") !== "optimal") return "";
  const wishes = frame.schema.legs.map((leg) => wishOf(frame, leg)).filter((wish) => wish !== "");
  return wishes.length === 0 ? "" : `, but for contact forces that no ground gives: ${wishes.join(", ")}`;
}
