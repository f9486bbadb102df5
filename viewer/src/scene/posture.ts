import { read, type Frame } from "../data/frame.ts";

/** Joints that can be set one by one; angle: where one is [rad]. */
export interface Jointed {
  joints: Record<string, { angle: unknown }>;
  setJointValue(name: string, value: number): unknown;
}

/** Where a tick has a robot. */
export class Posture {
  readonly p_WB = [0, 0, 0];
  /** w, x, y, z. */
  readonly q_WB = [1, 0, 0, 0];
  /** Of each joint; NaN: not known [rad]. */
  readonly q: number[];

  constructor(joints: number) {
    this.q = new Array<number>(joints).fill(NaN);
  }

  /** `base`, `legs`: topics that say where these are. False: the base's place is not known. */
  read(frame: Frame, base: string, legs: string): boolean {
    if (frame.schema.offset(`${legs}.q`) < 0) this.q.fill(NaN);
    else read(frame, `${legs}.q`, this.q); // those that are not known are NaN
    return read(frame, `${base}.p_WB`, this.p_WB) && read(frame, `${base}.q_WB`, this.q_WB);
  }
}

/** A joint of which the angle is not known stands as in `like`, or where it is. */
export function bend(robot: Jointed, names: string[], q: number[], like?: Jointed): void {
  names.forEach((name, j) => {
    const angle = Number.isNaN(q[j]) ? like?.joints[name]?.angle : q[j];
    if (typeof angle === "number") robot.setJointValue(name, angle);
  });
}
