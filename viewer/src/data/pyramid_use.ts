import { scalar, type Frame } from "./frame.ts";
import type { LegChannels } from "./schema.ts";

/** A foot that carries less than this share of the robot's weight uses next to nothing, whatever share of its pyramid that is. */
const CARRIES = 0.02;

/** Share that a foot uses of its friction pyramid; NaN where it carries nothing worth the name. */
export function pyramidUse(frame: Frame, leg: LegChannels): number {
  const normal = scalar(frame, leg.normalForce);
  return normal < CARRIES * frame.schema.weight ? NaN : scalar(frame, leg.frictionUse);
}
