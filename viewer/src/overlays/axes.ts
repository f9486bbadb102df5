import type * as THREE from "three";
import { svg } from "../panels/dom.ts";

/** Direction of an axis of S in the picture, a unit vector: right, up, towards the camera. */
export type AxisDirection = [right: number, up: number, nearer: number];

/** The directions of x, y and z for a camera. */
export function axisDirections(camera: THREE.Camera): AxisDirection[] {
  const { elements } = camera.matrixWorldInverse;
  return [0, 4, 8].map((column) => [elements[column], elements[column + 1], elements[column + 2]] as AxisDirection);
}

/** Lengths in the drawing [pixels]. */
const SIZE = 60, MIDDLE = 0.5 * SIZE, ARM = 18, LETTER = 25;

const NAMES = ["x", "y", "z"];

/** The world's axes in a corner of the picture; directions of pushes refer to them. */
export class Axes {
  readonly root = svg("svg", { id: "axes", viewBox: `0 0 ${SIZE} ${SIZE}`, "aria-hidden": "true" });
  private readonly arms = NAMES.map(() => svg("path", {}));
  private readonly letters = NAMES.map(() => svg("text", { "text-anchor": "middle", "dominant-baseline": "central" }));
  private drawn = "";

  constructor() {
    NAMES.forEach((name, k) => (this.letters[k] as Element).append(name));
    this.root.append(...this.arms, ...this.letters);
  }

  turn(camera: THREE.Camera): void {
    const places = axisDirections(camera).map(([right, up, nearer]) => [right.toFixed(3), (-up).toFixed(3), nearer < -0.3 ? "away" : ""] as const);
    if (places.join() === this.drawn) return;
    this.drawn = places.join();
    places.forEach(([x, y, kind], k) => {
      const at = (length: number): [string, string] => [(MIDDLE + length * Number(x)).toFixed(1), (MIDDLE + length * Number(y)).toFixed(1)];
      const letter = this.letters[k] as Element, [left, top] = at(LETTER);
      (this.arms[k] as Element).setAttribute("d", `M${MIDDLE} ${MIDDLE}L${at(ARM).join(" ")}`);
      letter.setAttribute("x", left);
      letter.setAttribute("y", top);
      for (const part of [letter, this.arms[k] as Element]) part.setAttribute("class", kind);
    });
  }
}
