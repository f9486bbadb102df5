import { scalar, type Frame } from "./frame.ts";
import { LEG_CHANNELS } from "./schema.ts";

/** A foot that carries less than this share of the robot's weight uses next to nothing, whatever share of its pyramid that is. */
const CARRIES = 0.02;

/** Share that foot `k` uses of its friction pyramid; NaN where it carries nothing worth the name. */
export function pyramidUse(frame: Frame, k: number): number {
  const normal = scalar(frame, LEG_CHANNELS.normalForce[k] as string);
  return normal < CARRIES * frame.schema.weight ? NaN : scalar(frame, LEG_CHANNELS.frictionUse[k] as string);
}
