import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** Orbits around a point, which follows the robot while `follow` is set. */
export class FollowCamera {
  follow = true;
  readonly controls: OrbitControls;
  private readonly target = new THREE.Vector3(0, 0, 0.35);
  private readonly shift = new THREE.Vector3();
  private placed = false;

  constructor(
    private readonly camera: THREE.PerspectiveCamera,
    element: HTMLElement,
  ) {
    this.controls = new OrbitControls(camera, element);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 25;
    this.controls.maxPolarAngle = 0.94 * Math.PI;
    this.home();
  }

  /** Back to the view from the front left. */
  home(): void {
    this.controls.target.copy(this.target);
    const wide = this.camera.aspect > 1 ? 1 : 1.35;
    this.camera.position.set(1.35 * wide, -1.55 * wide, 0.75 * wide).add(this.target);
    this.controls.update();
  }

  /** `p_SB`: the base's position; `dt` [s]. */
  update(p_SB: THREE.Vector3, dt: number): void {
    if (!this.placed) {
      this.target.copy(p_SB).setZ(p_SB.z - 0.15);
      this.placed = true;
      this.home();
    } else if (this.follow) {
      this.shift.copy(p_SB).setZ(p_SB.z - 0.15).sub(this.target);
      const far = this.shift.lengthSq() > 0.25;
      this.shift.multiplyScalar(far ? 1 : Math.min(1, 6 * dt));
      this.target.add(this.shift);
      this.controls.target.add(this.shift);
      this.camera.position.add(this.shift);
    }
    this.controls.update();
  }
}
