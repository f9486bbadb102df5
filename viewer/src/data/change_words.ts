/** A direction in the plane, counted from the world's x towards its y; along an axis it is called by that, too. */
export function worldDirection(degrees: number): string {
  const axis = ["+x", "+y", "−x", "−y"][(((degrees / 90) % 4) + 4) % 4];
  return `${String(degrees).replace("-", "−")}°${axis === undefined ? "" : ` (${axis})`}`;
}

/** Share of a force that is told: less is within 22.5° of the others. */
export const TOLD = 0.38;

/** A force in the world [N], by its size and where it goes. */
function forceWords([x = 0, y = 0, z = 0]: number[]): string {
  const size = Math.hypot(x, y, z);
  const goes: string[] = [];
  if (Math.hypot(x, y) > TOLD * size) goes.push(`towards ${worldDirection(Math.round((Math.atan2(y, x) * 180) / Math.PI))}`);
  if (Math.abs(z) > TOLD * size) goes.push(z > 0 ? "upwards" : "downwards");
  return `${Number(size.toPrecision(3))} N ${goes.join(" and ")}`.trimEnd();
}

const VECTOR = /force \(([^()]+)\) N/g;
/** Names of levels, tasks and numbers; what is pushed or pulled has the name that the robot gives it. */
const NAME = /(?<!\bat )\b[a-z]+(?:_[a-z0-9]+)+\b/g;

/** What the program says of a change, as people read it. */
export function changeText(text: string): string {
  return text.replace(VECTOR, (_, parts: string) => forceWords(parts.split(",").map(Number))).replace(NAME, (name) => name.replaceAll("_", " "));
}
