import { rotate } from "./geometry.ts";

export type UseClass = "good" | "near" | "bad";

/** Class of the share of its friction pyramid that a force uses; 1: at a face. */
export function useClass(use: number): UseClass {
  return use < 0.6 ? "good" : use < 0.9 ? "near" : "bad";
}

/**
 * Corners of the friction pyramid P at height `normal` over its tip, in S: points p with |p·x| = |p·y| = μ normal and
 * p·z = normal, where x, y, z are the axes that `q_WP` turns into S; counter-clockwise about z.
 */
export function pyramidCorners(q_WP: number[], mu: number, normal: number): number[][] {
  const half = mu * normal;
  return [[half, half], [-half, half], [-half, -half], [half, -half]].map(([x, y]) => rotate(q_WP, [x as number, y as number, normal]));
}

/** Least height of a pyramid, so that its colour stays visible under a small force [m]. */
const LEAST_HEIGHT = 0.1;

/** Height of a pyramid [m]: the force along its axis, at most the robot's weight; `newton`: length of 1 N [m/N]. */
export function pyramidHeight(normal: number, weight: number, newton: number): number {
  return Math.max(newton * Math.min(normal, weight), LEAST_HEIGHT);
}

/** A share in percent, as text. */
export function percent(share: number): string {
  return `${(100 * share).toFixed(0)} %`;
}
