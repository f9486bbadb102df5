import { read, type Frame } from "../data/frame.ts";
import { baseChannel } from "../data/schema.ts";

/** A robot with joints; angle in rad. */
export interface Jointed {
  joints: Record<string, { angle: unknown }>;
  setJointValue(name: string, value: number): unknown;
}

/** The robot's posture at a tick, in S; of a log without truth in S. */
export class Posture {
  readonly p_SB = [0, 0, 0];
  /** w, x, y, z. */
  readonly q_SB = [1, 0, 0, 0];
  /** Of each joint; NaN: not known [rad]. */
  readonly q: number[];

  constructor(joints: number) {
    this.q = new Array<number>(joints).fill(NaN);
  }

  /** `base`, `legs`: topics with their positions. False: the base's pose is not known. */
  read(frame: Frame, base: string, legs: string): boolean {
    if (frame.schema.offset(`${legs}.q`) < 0) this.q.fill(NaN);
    else read(frame, `${legs}.q`, this.q); // those that are not known are NaN
    return read(frame, baseChannel(base, "p"), this.p_SB) && read(frame, baseChannel(base, "q"), this.q_SB);
  }
}

/** Sets the joints; a joint with an unknown angle is set as in `like`, or stays. */
export function bend(robot: Jointed, names: string[], q: number[], like?: Jointed): void {
  names.forEach((name, j) => {
    const angle = Number.isNaN(q[j]) ? like?.joints[name]?.angle : q[j];
    if (typeof angle === "number") robot.setJointValue(name, angle);
  });
}
