import { scalar, type Frame } from "./frame.ts";
import { LEG_CHANNELS, LEGS } from "./schema.ts";
import type { FrameSource } from "./source.ts";

/** Over how long it is looked what has touched the ground, as by `explain`: who lies rattles [s]. */
export const LYING_WINDOW = 0.05;

/** What of the robot has touched the ground, in truth. */
export interface GroundTouch {
  /** Any of them. */
  feet: boolean;
  torso: boolean;
  /** Bit k: thigh, knee or shank of leg k. */
  shanks: number;
  /** Force on another part than a foot [N]; NaN: nobody knows any of this. */
  largest: number;
}

/** At a frame and, where they are here, up to `LYING_WINDOW` before it. */
export function touchOf(frame: Frame, source?: FrameSource): GroundTouch {
  const touch = { feet: false, torso: false, shanks: 0, largest: NaN };
  const see = (one: Frame): void => {
    const largest = scalar(one, "truth.body_contact_force");
    if (Number.isNaN(largest)) return;
    touch.feet ||= LEG_CHANNELS.touching.some((name) => scalar(one, name) > 0);
    touch.torso ||= scalar(one, "truth.torso_contact") > 0;
    touch.shanks |= scalar(one, "truth.shank_contacts");
    touch.largest = Math.max(touch.largest || 0, largest);
  };
  source?.sample(frame.time - LYING_WINDOW + 1e-6, frame.time, Infinity, see);
  see(frame);
  return touch;
}

/** What of the robot beside its feet is on the ground, as `explain` says it; "" of one on its feet, and where nobody knows. */
export function lyingText({ feet, torso, shanks, largest }: GroundTouch): string {
  if (Number.isNaN(largest)) return "";
  const parts = partsText(torso, LEGS.filter((_, k) => (shanks >> k) & 1), largest);
  if (parts !== "") return `${parts}${largest > 0 ? `, up to ${largest.toFixed(0)} N on a part` : ""}${feet ? ", beside its feet" : ""}`;
  return feet ? "" : "nothing: it is in the air";
}

function partsText(torso: boolean, legs: string[], largest: number): string {
  const parts = [...(torso ? ["its torso"] : []), ...(legs.length > 0 ? [`thigh, knee or shank of ${legs.join(", ")}`] : [])];
  return parts.length === 0 && largest > 0 ? "another part than its feet" : parts.join(" and ");
}
