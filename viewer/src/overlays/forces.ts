import * as THREE from "three";
import { scalar } from "../data/frame.ts";
import { isFollowed } from "../data/hierarchy.ts";
import { digits } from "../data/numbers.ts";
import { leverOf, pushesOf, type Push } from "../data/pushes.ts";
import { LEG_CHANNELS } from "../data/schema.ts";
import { Arrows, paint, paintOverBodies } from "./arrow.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";

/** Forces of the ground on the feet as they are; their size in N stands under the foot, where no leg is. */
export class GroundForces implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly arrows = new Arrows(paint(), 0.0075, LEG_CHANNELS.length);
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    this.root.add(this.arrows.root);
  }

  update({ frame, labels, colours, newton, longest }: Picture): void {
    this.arrows.begin();
    LEG_CHANNELS.forEach(({ name, touching, trueForce, truePoint }, k) => {
      if (!(scalar(frame, touching) > 0) || !vector(frame, trueForce, this.force) || !vector(frame, truePoint, this.point)) return;
      const newtons = this.force.length();
      if (this.arrows.add(this.point, this.force.multiplyScalar(newton), colours.legs[k] as THREE.Color, longest))
        labels.put(this.point, `${name} ${newtons.toFixed(0)} N`, `leg${k}`, true);
    });
    this.arrows.end();
  }
}

/** Contact forces that the controller's solution asks for. */
export class WantedForces implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly arrows = new Arrows(paint(), 0.003, LEG_CHANNELS.length);
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    this.root.add(this.arrows.root);
  }

  update({ frame, header, colours, newton, longest }: Picture): void {
    this.arrows.begin();
    if (isFollowed(frame)) for (const { force, foot } of LEG_CHANNELS) {
      if (!vector(frame, force, this.force) || !vector(frame, foot, this.point)) continue;
      this.point.z -= header.robot.foot_radius;
      this.arrows.add(this.point, this.force.multiplyScalar(newton), colours.com, longest);
    }
    this.arrows.end();
  }
}

/** So much longer an arrow is that would be short beside the torso [m]: its number says how great a push is. */
const SEEN_LENGTH = 0.2;
/** Its number stands this far over its tip, so that it hides none of it [m]. */
const NUMBER_OVER = 0.12;
/** How far its edge goes beyond it [m]. */
const EDGE = 0.006;
/** Less is in what the controller believes where nobody pushes [N]. */
const LEAST_BELIEVED = 1;
/** As many bodies can be pushed at once. */
const MOST_PUSHES = 32;
/** No body reaches further from its centre of mass [m]. */
const BODY_REACH = 1;

/**
 * What pushes the robot beside the ground, each in the line in which it acts, and their sum as the controller believes it. Has an edge, as it is
 * seen over bodies of any colour.
 */
export class OutsideForce implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly believed = new Arrows(paintOverBodies(0.45), 0.009, 1, 2);
  private readonly edges = new Arrows(paintOverBodies(), 0.02, MOST_PUSHES, 3, 0.08);
  private readonly arrows = new Arrows(paintOverBodies(), 0.015, MOST_PUSHES, 4, 0.08);
  private readonly start = new THREE.Vector3();
  private readonly point = new THREE.Vector3();
  private readonly force = new THREE.Vector3();
  private readonly over = new THREE.Vector3();
  private readonly turn = new THREE.Matrix4();

  constructor() {
    this.root.add(this.believed.root, this.edges.root, this.arrows.root);
  }

  update(picture: Picture): void {
    const all = [this.arrows, this.edges, this.believed];
    for (const arrows of all) arrows.begin();
    for (const push of pushesOf(picture.frame)?.slice(0, MOST_PUSHES) ?? []) this.draw(push, picture);
    this.drawBelieved(picture);
    for (const arrows of all) arrows.end();
  }

  /** How a force is drawn [m]. */
  private stretch(newton: number): THREE.Vector3 {
    return this.force.setLength(SEEN_LENGTH + newton * this.force.length());
  }

  private draw(push: Push, { frame, labels, colours, newton, longest, centreOf }: Picture): void {
    if (centreOf(frame.schema.bodies[push.body] ?? "", this.start)) this.start.add(this.point.fromArray(leverOf(push, BODY_REACH)));
    else if (!vector(frame, "truth.p_WCom", this.start)) return;
    const newtons = this.force.fromArray(push.force).length();
    this.arrows.add(this.start, this.stretch(newton), colours.push, longest);
    this.point.copy(this.arrows.tip).z += NUMBER_OVER;
    labels.put(this.point, `push ${newtons < 10 ? digits(newtons) : newtons.toFixed(0)} N`, "push");
    this.over.copy(this.force).setLength(EDGE);
    this.edges.add(this.start.sub(this.over), this.force.addScaledVector(this.over, 2.5), colours.halo, longest + 2.5 * EDGE);
  }

  private drawBelieved({ frame, labels, colours, newton, longest, beliefToWorld }: Picture): void {
    if (!vector(frame, "truth.p_WCom", this.start)) return;
    if (!vector(frame, "state.external_force", this.force) || this.force.length() < LEAST_BELIEVED) return;
    const newtons = this.force.applyMatrix4(this.turn.extractRotation(beliefToWorld)).length();
    this.believed.add(this.start, this.stretch(newton), colours.push, longest);
    labels.put(this.believed.tip, `believed ${newtons.toFixed(0)} N`, "believed");
  }
}
