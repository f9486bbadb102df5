import { read, type Frame } from "./frame.ts";
import { PUSHES } from "./schema.ts";

/** Smaller forces are rounding errors [N]. */
const LEAST_PUSH = 1e-6;

type Three = [number, number, number];

/** A force from outside on a body, and its torque about the body's centre of mass, in S [N, N·m]; `body` is its number among those that can be pushed. */
export interface Push {
  body: number;
  force: Three;
  torque: Three;
}

/**
 * Shortest vector from the body's centre of mass to the force's line of action, in S [m]: r = f × τ / |f|². Zero if longer than `reach`: the torque
 * then has another cause.
 */
export function leverOf({ force, torque }: Push, reach: number): Three {
  const [fx, fy, fz] = force, [tx, ty, tz] = torque;
  const square = fx * fx + fy * fy + fz * fz;
  const lever: Three = [(fy * tz - fz * ty) / square, (fz * tx - fx * tz) / square, (fx * ty - fy * tx) / square];
  return Math.hypot(...lever) <= reach ? lever : [0, 0, 0];
}

/** Outside forces on the robot; undefined: not known. */
export function pushesOf(frame: Frame): Push[] | undefined {
  const size = frame.schema.channel(PUSHES)?.size ?? 0;
  const numbers = Array<number>(size).fill(0);
  if (!read(frame, PUSHES, numbers)) return undefined;
  const pushes: Push[] = [];
  for (let begin = 6; begin + 6 <= size; begin += 6) { // the world comes first
    const force = numbers.slice(begin, begin + 3) as Three;
    if (Math.hypot(...force) >= LEAST_PUSH) pushes.push({ body: begin / 6 - 1, force, torque: numbers.slice(begin + 3, begin + 6) as Three });
  }
  return pushes;
}
