import { rotate } from "./geometry.ts";

export type UseClass = "good" | "near" | "bad";

/** Of the share of its friction pyramid that a force uses; 1: at a face. */
export function useClass(use: number): UseClass {
  return use < 0.6 ? "good" : use < 0.9 ? "near" : "bad";
}

/**
 * Corners of the friction pyramid P at height `normal` over its tip, in W: points p with |p·x| = |p·y| = μ normal and
 * p·z = normal, where x, y, z are the axes that `q_WP` turns into W; counter-clockwise about z.
 */
export function pyramidCorners(q_WP: number[], mu: number, normal: number): number[][] {
  const half = mu * normal;
  return [[half, half], [-half, half], [-half, -half], [half, -half]].map(([x, y]) => rotate(q_WP, [x as number, y as number, normal]));
}

/** A share as the page tells it. */
export function percent(share: number): string {
  return `${(100 * share).toFixed(0)} %`;
}
