import { percent } from "../math/friction.ts";
import { scalar, word, type Frame } from "./frame.ts";
import { digits } from "./numbers.ts";
import { LEG_CHANNELS, LEGS } from "./schema.ts";

/** Further beyond a limit than this is no rounding [N], of a friction pyramid as a share; those of `explain`. */
export const FORCE_SLACK = 1, SHARE_SLACK = 0.01;

/** What the solution asks of a foot beyond its limits; "": nothing. */
function wishOf(frame: Frame, k: number): string {
  const [normal, most, use] = [LEG_CHANNELS.normalForce, LEG_CHANNELS.mostForce, LEG_CHANNELS.frictionUse].map((names) => scalar(frame, names[k] as string)) as [number, number, number];
  if (normal < -FORCE_SLACK || normal > most + FORCE_SLACK) return `${LEGS[k]} ${digits(normal)} N`;
  return use > 1 + SHARE_SLACK ? `${LEGS[k]} ${percent(use)} of its pyramid` : "";
}

/** That the command, which is the solution's, goes with forces on feet that no ground gives, and which; "": it does not. */
export function wishesText(frame: Frame): string {
  if (word(frame, "command.mode") !== "optimal") return "";
  const wishes = LEGS.map((_, k) => wishOf(frame, k)).filter((wish) => wish !== "");
  return wishes.length === 0 ? "" : `, but for contact forces that no ground gives: ${wishes.join(", ")}`;
}
