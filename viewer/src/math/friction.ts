/** Where a contact force stands against friction. */
export interface FrictionState {
  /** Part of the force along the ground's normal [N]. */
  normal: number;
  /** Part along the ground [N]. */
  tangential: number;
  /** μ f_n − |f_t| [N]: what is left before the foot slides. */
  margin: number;
  /** The margin as a share of μ f_n; 1: no force along the ground, below 0: it slides. */
  share: number;
}

export function frictionState(force: number[], normal: number[], mu: number): FrictionState {
  const [fx, fy, fz] = force as [number, number, number];
  const [nx, ny, nz] = normal as [number, number, number];
  const along = fx * nx + fy * ny + fz * nz;
  const tangential = Math.hypot(fx - along * nx, fy - along * ny, fz - along * nz);
  const margin = mu * along - tangential;
  return { normal: along, tangential, margin, share: along > 0 && mu > 0 ? margin / (mu * along) : 0 };
}

export type MarginClass = "good" | "near" | "bad";

/** A force at the face of the pyramid that lies inside the cone has a share of 1 − 1/√2 = 0.29. */
export function marginClass(share: number): MarginClass {
  return share > 0.4 ? "good" : share > 0.1 ? "near" : "bad";
}

/**
 * Corners of the friction pyramid at height `normal` over its tip: points p with |p·x| = |p·y| = μ normal,
 * where x, y, z are the columns of `R` (row by row), counter-clockwise about z.
 */
export function pyramidCorners(R: number[], mu: number, normal: number): number[][] {
  const signs = [[1, 1], [-1, 1], [-1, -1], [1, -1]] as const;
  return signs.map(([sx, sy]) =>
    [0, 1, 2].map(
      (i) =>
        normal * ((R[3 * i + 2] as number) + mu * (sx * (R[3 * i] as number) + sy * (R[3 * i + 1] as number))),
    ),
  );
}

/** Axes of the pyramid: those of C, or with gravity as normal and C's heading. */
export function pyramidAxes(R_WC: number[], gravity: boolean): number[] {
  if (!gravity) return R_WC;
  const heading = Math.atan2(R_WC[3] as number, R_WC[0] as number);
  const c = Math.cos(heading);
  const s = Math.sin(heading);
  return [c, -s, 0, s, c, 0, 0, 0, 1];
}
