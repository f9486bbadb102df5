import { scalar, type Frame } from "./frame.ts";
import type { LegChannels } from "./schema.ts";

/** Least share of the robot's weight on a foot, below which its friction use means nothing. */
const CARRIES = 0.02;

/** Share of its friction pyramid that a foot uses; NaN where it carries almost nothing. */
export function pyramidUse(frame: Frame, leg: LegChannels): number {
  const normal = scalar(frame, leg.normalForce);
  return normal < CARRIES * frame.schema.weight ? NaN : scalar(frame, leg.frictionUse);
}
