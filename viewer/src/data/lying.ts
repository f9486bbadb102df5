import { scalar, type Frame } from "./frame.ts";
import { LEG_CHANNELS, LEGS } from "./schema.ts";

/** What of the robot beside its feet is on the ground, in truth, as `explain` says it; "" of one on its feet, and where nobody knows. */
export function lyingText(frame: Frame): string {
  const torso = scalar(frame, "truth.torso_contact"), legs = scalar(frame, "truth.shank_contacts"), most = scalar(frame, "truth.body_contact_force");
  const feet = LEG_CHANNELS.touching.map((name) => scalar(frame, name));
  if (Number.isNaN(torso + legs + most)) return "";
  const parts = partsText(torso > 0, LEGS.filter((_, k) => (legs >> k) & 1), most);
  const beside = feet.some((one) => one > 0) ? ", beside its feet" : "";
  if (parts !== "") return `${parts}${most > 0 ? `, up to ${most.toFixed(0)} N on a part` : ""}${beside}`;
  return beside === "" ? "nothing at this tick" : "";
}

function partsText(torso: boolean, legs: string[], most: number): string {
  const parts = [...(torso ? ["its torso"] : []), ...(legs.length > 0 ? [`thigh, knee or shank of ${legs.join(", ")}`] : [])];
  return parts.length === 0 && most > 0 ? "another part than its feet" : parts.join(" and ");
}
