import * as THREE from "three";
import type { Palette } from "../scene/palette.ts";
import { Arrows, paint } from "./arrow.ts";
import type { Overlay, Picture } from "./overlay.ts";

/** Of an axis [m]. */
const LENGTH = 0.12;

/** Each joint's axis and name. By the right hand, a positive angle turns about the arrow. No body hides it. */
export class JointAxes implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly material = paint();
  private readonly arrows: Arrows;
  private readonly colour = new THREE.Color(0xffffff);
  private readonly place = new THREE.Vector3();
  private readonly axis = new THREE.Vector3();

  /** `capacity`: most joints of a robot. */
  constructor(capacity = 32) {
    this.material.depthTest = false; // seen through the links
    this.arrows = new Arrows(this.material, 0.004, capacity);
    this.root.add(this.arrows.root);
  }

  recolour(palette: Palette): void {
    this.colour.set(palette.plan);
  }

  update({ header, labels, axisOf }: Picture): void {
    this.arrows.begin();
    for (const name of header.robot.joint_names) {
      if (!axisOf(name, this.place, this.axis)) continue;
      this.arrows.add(this.place, this.axis.multiplyScalar(LENGTH), this.colour);
      labels.put(this.arrows.tip, name, "joint");
    }
    this.arrows.end();
  }
}
