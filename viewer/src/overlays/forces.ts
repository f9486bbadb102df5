import * as THREE from "three";
import { scalar } from "../data/frame.ts";
import { isPulled } from "../data/pulls.ts";
import { LEG_CHANNELS, LEGS } from "../data/schema.ts";
import type { Palette } from "../scene/palette.ts";
import { Arrows, paint, paintOverBodies } from "./arrow.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";

/** Forces of the ground on the feet as they are, with their size in N. */
export class GroundForces implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly arrows = new Arrows(paint(), 0.0075, LEGS.length);
  private readonly colours = LEGS.map(() => new THREE.Color());
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    this.root.add(this.arrows.root);
  }

  wear(palette: Palette): void {
    this.colours.forEach((colour, k) => colour.set(palette.legs[k] as number));
  }

  update({ frame, labels, newton }: Picture): void {
    this.arrows.begin();
    LEGS.forEach((_, k) => {
      if (!(scalar(frame, LEG_CHANNELS.touching[k] as string) > 0)) return;
      if (!vector(frame, LEG_CHANNELS.trueForce[k] as string, this.force)) return;
      if (!vector(frame, LEG_CHANNELS.truePoint[k] as string, this.point)) return;
      const newtons = this.force.length();
      if (this.arrows.add(this.point, this.force.multiplyScalar(newton), this.colours[k] as THREE.Color))
        labels.put(this.arrows.tip, `|f| ${newtons.toFixed(0)} N`, `leg${k}`);
    });
    this.arrows.end();
  }
}

/** Contact forces that the controller's solution asks for. */
export class WantedForces implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly arrows = new Arrows(paint(), 0.003, LEGS.length);
  private readonly colour = new THREE.Color();
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    this.root.add(this.arrows.root);
  }

  wear(palette: Palette): void {
    this.colour.set(palette.com);
  }

  update({ frame, header, newton }: Picture): void {
    this.arrows.begin();
    LEGS.forEach((_, k) => {
      if (!vector(frame, LEG_CHANNELS.force[k] as string, this.force)) return;
      if (!vector(frame, LEG_CHANNELS.foot[k] as string, this.point)) return;
      this.point.z -= header.robot.foot_radius;
      this.arrows.add(this.point, this.force.multiplyScalar(newton), this.colour);
    });
    this.arrows.end();
  }
}

/** What pushes the robot beside the ground: as it is, and as the controller believes. */
export class OutsideForce implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly colour = new THREE.Color();
  private readonly arrow = new Arrows(paintOverBodies(), 0.011, 1);
  private readonly believed = new Arrows(paintOverBodies(0.45), 0.009, 1);
  private readonly force = new THREE.Vector3();
  private readonly part = new THREE.Vector3();
  private readonly com = new THREE.Vector3();
  private readonly turn = new THREE.Matrix4();

  constructor() {
    this.root.add(this.arrow.root, this.believed.root);
  }

  wear(palette: Palette): void {
    this.colour.set(palette.push);
  }

  update(picture: Picture): void {
    this.arrow.begin();
    this.believed.begin();
    this.draw(picture);
    this.arrow.end();
    this.believed.end();
  }

  private draw({ frame, source, labels, newton, beliefToWorld, held }: Picture): void {
    if (!vector(frame, "truth.p_WCom", this.com)) return;
    if (this.total(frame)) {
      const newtons = this.force.length();
      const what = isPulled(source.marks, frame.time, source.schema.period) ? "pull" : "push";
      if (this.arrow.add(this.com, this.force.multiplyScalar(newton), this.colour) && !held)
        labels.put(this.arrow.tip, `${what} ${newtons.toFixed(0)} N`, "push");
    }
    if (!vector(frame, "state.external_force", this.force)) return;
    this.force.applyMatrix4(this.turn.extractRotation(beliefToWorld)).multiplyScalar(newton);
    this.believed.add(this.com, this.force, this.colour);
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
