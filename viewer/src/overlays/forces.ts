import * as THREE from "three";
import { scalar } from "../data/frame.ts";
import { isFollowed } from "../data/hierarchy.ts";
import { digits } from "../data/numbers.ts";
import { leverOf, pushesOf, type Push } from "../data/pushes.ts";
import { MOST_LEGS } from "../data/schema.ts";
import { Arrows, paint, paintOverBodies } from "./arrow.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";

/** True forces of the ground on the feet; the size in N stands under the foot. */
export class GroundForces implements Overlay {
  readonly space = "world";
  readonly root = new THREE.Group();
  private readonly arrows = new Arrows(paint(), 0.0075, MOST_LEGS);
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    this.root.add(this.arrows.root);
  }

  update({ frame, labels, colours, newton, longest }: Picture): void {
    this.arrows.begin();
    frame.schema.legs.forEach(({ name, touching, trueForce, truePoint }, k) => {
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
  private readonly arrows = new Arrows(paint(), 0.003, MOST_LEGS);
  private readonly force = new THREE.Vector3();
  private readonly point = new THREE.Vector3();

  constructor() {
    this.root.add(this.arrows.root);
  }

  update({ frame, header, colours, newton, longest }: Picture): void {
    this.arrows.begin();
    if (isFollowed(frame)) for (const { force, foot } of frame.schema.legs) {
      if (!vector(frame, force, this.force) || !vector(frame, foot, this.point)) continue;
      this.point.z -= header.robot.foot_radius;
      this.arrows.add(this.point, this.force.multiplyScalar(newton), colours.com, longest);
    }
    this.arrows.end();
  }
}

/** Every arrow of a push is longer by this, or the torso would dwarf it [m]; the label has its size. */
const SEEN_LENGTH = 0.2;
/** Height of the label over the tip, so that it does not cover the arrow [m]. */
const NUMBER_OVER = 0.12;
/** Width of the outline [m]. */
const EDGE = 0.006;
/** Estimates below this are noise [N]. */
const LEAST_BELIEVED = 1;
/** Pushes drawn at once. */
const MOST_PUSHES = 32;
/** Greatest distance of a point of a body from its centre of mass [m]. */
const BODY_REACH = 1;

/** Outside forces on the robot, each in its line of action, and the sum that the controller estimates. Outlined, to stand out from any colour. */
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

  /** The arrow of `this.force` [m]. */
  private stretch(newton: number): THREE.Vector3 {
    return this.force.setLength(SEEN_LENGTH + newton * this.force.length());
  }

  private draw(push: Push, { frame, labels, colours, newton, longest, centreOf }: Picture): void {
    if (centreOf(frame.schema.bodies[push.body] ?? "", this.start)) this.start.add(this.point.fromArray(leverOf(push, BODY_REACH)));
    else if (!vector(frame, "truth.p_SCom", this.start)) return;
    const newtons = this.force.fromArray(push.force).length();
    this.arrows.add(this.start, this.stretch(newton), colours.push, longest);
    this.point.copy(this.arrows.tip).z += NUMBER_OVER;
    labels.put(this.point, `push ${newtons < 10 ? digits(newtons) : newtons.toFixed(0)} N`, "push");
    this.over.copy(this.force).setLength(EDGE);
    this.edges.add(this.start.sub(this.over), this.force.addScaledVector(this.over, 2.5), colours.halo, longest + 2.5 * EDGE);
  }

  private drawBelieved({ frame, labels, colours, newton, longest, beliefToWorld }: Picture): void {
    if (!vector(frame, "truth.p_SCom", this.start)) return;
    if (!vector(frame, "state.external_force", this.force) || this.force.length() < LEAST_BELIEVED) return;
    const newtons = this.force.applyMatrix4(this.turn.extractRotation(beliefToWorld)).length();
    this.believed.add(this.start, this.stretch(newton), colours.push, longest);
    labels.put(this.believed.tip, `believed ${newtons.toFixed(0)} N`, "believed");
  }
}
