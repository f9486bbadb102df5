import * as THREE from "three";
import type { Palette } from "./palette.ts";

/** From the camera's target to the sun. */
export const SUN_OFFSET = new THREE.Vector3(-1.6, 2.2, 4.5);
export const SUN = SUN_OFFSET.clone().normalize();

/** Intensity of sky and sun. */
export function lightOf({ dark }: Palette): { sky: number; sun: number } {
  return dark ? { sky: 1.9, sun: 2.5 } : { sky: 1.5, sun: 2.4 };
}
