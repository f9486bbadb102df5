import * as THREE from "three";
import { scalar } from "../data/frame.ts";
import { LEG_CHANNELS, LEGS } from "../data/schema.ts";
import type { Palette } from "../scene/palette.ts";
import { Arrow, paint } from "./arrow.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";

/** Forces of the ground on the feet as they are, with their size in N. */
export class GroundForces implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly materials = LEGS.map(() => paint());
  private readonly arrows = this.materials.map((material) => new Arrow(material));
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    for (const arrow of this.arrows) this.root.add(arrow.root);
  }

  wear(palette: Palette): void {
    this.materials.forEach((material, k) => material.color.set(palette.legs[k] as number));
  }

  update({ frame, labels, newton }: Picture): void {
    LEGS.forEach((_, k) => {
      const arrow = this.arrows[k] as Arrow;
      arrow.hide();
      if (!(scalar(frame, LEG_CHANNELS.touching[k] as string) > 0)) return;
      if (!vector(frame, LEG_CHANNELS.trueForce[k] as string, this.force)) return;
      if (!vector(frame, LEG_CHANNELS.truePoint[k] as string, this.point)) return;
      const newtons = this.force.length();
      if (arrow.set(this.point, this.force.multiplyScalar(newton)))
        labels.put(arrow.tip, `${newtons.toFixed(0)} N`, `leg${k}`);
    });
  }
}

/** Contact forces that the controller's solution asks for. */
export class WantedForces implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly material = paint();
  private readonly arrows = LEGS.map(() => new Arrow(this.material, 0.003));
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    for (const arrow of this.arrows) this.root.add(arrow.root);
  }

  wear(palette: Palette): void {
    this.material.color.set(palette.com);
  }

  update({ frame, header, newton }: Picture): void {
    LEGS.forEach((_, k) => {
      const arrow = this.arrows[k] as Arrow;
      arrow.hide();
      if (!vector(frame, LEG_CHANNELS.force[k] as string, this.force)) return;
      if (!vector(frame, LEG_CHANNELS.foot[k] as string, this.point)) return;
      this.point.z -= header.robot.foot_radius;
      arrow.set(this.point, this.force.multiplyScalar(newton));
    });
  }
}

/** What pushes the robot beside the ground: as it is, and as the controller believes. */
export class OutsideForce implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly material = paint();
  private readonly believedMaterial = paint(0.45);
  private readonly arrow = new Arrow(this.material, 0.011);
  private readonly believed = new Arrow(this.believedMaterial, 0.009);
  private readonly force = new THREE.Vector3();
  private readonly part = new THREE.Vector3();
  private readonly com = new THREE.Vector3();
  private readonly turn = new THREE.Matrix4();

  constructor() {
    this.root.add(this.arrow.root, this.believed.root);
  }

  wear(palette: Palette): void {
    this.material.color.set(palette.push);
    this.believedMaterial.color.set(palette.push);
  }

  update({ frame, labels, newton, beliefToWorld, held }: Picture): void {
    this.arrow.hide();
    this.believed.hide();
    if (!vector(frame, "truth.p_WCom", this.com)) return;
    if (this.total(frame)) {
      const newtons = this.force.length();
      if (this.arrow.set(this.com, this.force.multiplyScalar(newton)) && !held)
        labels.put(this.arrow.tip, `push ${newtons.toFixed(0)} N`, "push");
    }
    if (!vector(frame, "state.external_force", this.force)) return;
    this.force.applyMatrix4(this.turn.extractRotation(beliefToWorld)).multiplyScalar(newton);
    this.believed.set(this.com, this.force);
  }

  /** Sum over the bodies of what is applied from outside. */
  private total(frame: Picture["frame"]): boolean {
    const channel = frame.schema.channel("truth.xfrc_applied");
    if (channel === undefined) return false;
    this.force.set(0, 0, 0);
    for (let i = 0; i + 6 <= channel.size; i += 6)
      if (vector(frame, channel.name, this.part, i)) this.force.add(this.part);
    return this.force.lengthSq() > 1;
  }
}
