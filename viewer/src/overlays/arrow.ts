import * as THREE from "three";
import { Copies } from "./copies.ts";

const SHAFT = new THREE.CylinderGeometry(1, 1, 1, 10, 1).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const HEAD = new THREE.ConeGeometry(1, 1, 14).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const UP = new THREE.Vector3(0, 0, 1);

/** Arrows that are made once and moved. */
export class Arrows {
  readonly root = new THREE.Group();
  /** Of the last arrow. */
  readonly tip = new THREE.Vector3();
  private readonly shafts: Copies;
  private readonly heads: Copies;
  private readonly turn = new THREE.Quaternion();
  private readonly size = new THREE.Vector3();
  private readonly place = new THREE.Matrix4();
  private readonly direction = new THREE.Vector3();
  private readonly neck = new THREE.Vector3();

  constructor(
    material: THREE.MeshBasicMaterial,
    private readonly radius: number,
    capacity: number,
    order = 3,
    /** Distance between the two heads of a shortened arrow [m]. */
    private readonly twice = 5.4 * radius,
  ) {
    this.shafts = new Copies(SHAFT, material, capacity);
    this.heads = new Copies(HEAD, material, 2 * capacity);
    this.root.add(this.shafts.mesh, this.heads.mesh);
    if (!material.depthTest) this.shafts.mesh.renderOrder = this.heads.mesh.renderOrder = order;
  }

  begin(): void {
    this.shafts.begin();
    this.heads.begin();
  }

  /** From `start` along `vector` [m]; one longer than `most` is shortened and gets two heads. False where it is too short to see. */
  add(start: THREE.Vector3, vector: THREE.Vector3, colour: THREE.Color, most = Infinity): boolean {
    const whole = vector.length(), length = Math.min(whole, most);
    if (!(length > 0.01)) return false;
    const { radius, turn, size, place } = this;
    turn.setFromUnitVectors(UP, this.direction.copy(vector).divideScalar(whole));
    this.tip.copy(start).addScaledVector(this.direction, length);
    const head = Math.min(4.5 * radius, 0.5 * length);
    this.shafts.add(place.compose(start, turn, size.set(radius, radius, length - head)), colour);
    for (const back of whole > most ? [0, this.twice] : [0]) {
      this.neck.copy(start).addScaledVector(this.direction, length - head - back);
      this.heads.add(place.compose(this.neck, turn, size.set(2.2 * radius, 2.2 * radius, head)), colour);
    }
    return true;
  }

  end(): void {
    this.shafts.end();
    this.heads.end();
  }
}

/** For translucent surfaces of one colour: the order of their sides does not matter. */
export const SEEN_THROUGH = { transparent: true, depthWrite: false, side: THREE.DoubleSide, forceSinglePass: true } as const;

/** Paint that keeps its colour in any light. */
export function paint(opacity = 1): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({ ...(opacity < 1 ? SEEN_THROUGH : {}), opacity, fog: false });
}

/** The ground is drawn first, then what lies on it, then all else. */
export const GROUND_ORDER = -2;
export const ON_GROUND_ORDER = -1;

/** For marks on the ground that the controller believes: the true ground never hides them, the robot does. They blend without `transparent`,
 * since three.js draws transparent objects last. */
export const ON_GROUND = {
  depthTest: false, depthWrite: false, side: THREE.DoubleSide, fog: false,
  blending: THREE.CustomBlending, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneMinusSrcAlphaFactor,
} as const;

export function paintOnGround(opacity = 1): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({ ...ON_GROUND, opacity });
}

/** Paint that no body hides, for arrows that begin inside the robot. */
export function paintOverBodies(opacity = 1): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({ transparent: true, depthTest: false, depthWrite: false, opacity, fog: false });
}
