import * as THREE from "three";
import { read } from "../data/frame.ts";
import { isFollowed } from "../data/hierarchy.ts";
import type { Palette } from "../scene/palette.ts";
import { ON_GROUND_ORDER, paint, paintOnGround } from "./arrow.ts";
import { convexHull, distanceOutside } from "../math/geometry.ts";
import { BelievedPlane, standing } from "./ground_marks.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";
import { Pen, Trails } from "./trail.ts";

/** A trail shows this much of the past and, as far as it is known, of the future [s]. */
export const TRAIL_SECONDS = 3;

/** A point this near to the support polygon counts as inside [m]. */
const ON_EDGE = 0.001;
const PLUMB = new THREE.CylinderGeometry(1, 1, 1, 8).rotateX(Math.PI / 2).translate(0, 0, 0.5);

/** Centre of mass with its plumb line, and its plan on the ground. The plumb line ends in a disc inside the support polygon, and outside it in a
 * ring with the distance. No body hides it. */
export class CentreOfMass implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly material = paint();
  private readonly planMaterial = paintOnGround();
  private readonly ball = new THREE.Mesh(new THREE.SphereGeometry(0.02, 20, 14), this.material);
  private readonly plumb = new THREE.Mesh(PLUMB, this.material);
  private readonly inside = new THREE.Mesh(new THREE.CircleGeometry(0.016, 24), this.material);
  private readonly outside = new THREE.Mesh(new THREE.RingGeometry(0.018, 0.026, 32), this.material);
  private readonly ring = new THREE.Mesh(new THREE.RingGeometry(0.016, 0.022, 32), this.planMaterial);
  /** The plan, visible while the robot follows it. */
  private readonly planned = new THREE.Group();
  private readonly planTrail = new Trails(1, 255, true);
  private readonly pastTrail = new Trails(0.7, 255, true);
  private readonly planPen = new Pen(this.planTrail);
  private readonly pastPen = new Pen(this.pastTrail);
  private readonly plane = new BelievedPlane();
  private readonly com = new THREE.Vector3();
  private readonly point = new THREE.Vector3();
  private readonly plan = [0, 0];

  constructor() {
    this.material.depthTest = false; // seen through the torso
    for (const mesh of [this.ball, this.plumb, this.inside, this.outside]) mesh.renderOrder = 2;
    this.ring.renderOrder = ON_GROUND_ORDER;
    this.planned.add(this.ring, this.planTrail.lines);
    this.root.add(this.ball, this.plumb, this.inside, this.outside, this.planned, this.pastTrail.lines);
  }

  recolour(palette: Palette): void {
    this.material.color.set(palette.com);
    this.planMaterial.color.set(palette.plan);
  }

  update(picture: Picture): void {
    const known = vector(picture.frame, "model.p_WCom", this.com) && this.plane.read(picture);
    this.root.visible = known;
    if (!known) return;
    const { x, y } = this.com;
    const ground = this.plane.height(x, y);
    this.ball.position.copy(this.com);
    this.drop(picture, ground);
    this.planned.visible = isFollowed(picture.frame);
    this.ring.visible = read(picture.frame, "plan.com.p", this.plan);
    const [px, py] = this.plan as [number, number];
    if (this.ring.visible) this.ring.position.set(px, py, this.plane.height(px, py));
    if (picture.trails) this.drawTrails(picture);
  }

  /** Places the plumb line and its end. */
  private drop(picture: Picture, ground: number): void {
    const { x, y, z } = this.com;
    for (const mesh of [this.plumb, this.inside, this.outside]) mesh.position.set(x, y, ground);
    this.plumb.scale.set(0.003, 0.003, z - ground);
    const distance = distanceOutside(convexHull(standing(picture)), [x, y]);
    this.inside.visible = distance < ON_EDGE;
    this.outside.visible = !this.inside.visible;
    if (this.inside.visible || !Number.isFinite(distance)) return;
    this.point.set(x, y, ground).applyMatrix4(picture.beliefToWorld);
    picture.labels.put(this.point, `COM ${(100 * distance).toFixed(1)} cm outside`, "com");
  }

  private drawTrails({ frame, source, colours }: Picture): void {
    this.planTrail.begin();
    this.pastTrail.begin();
    this.planPen.begin(colours.plan);
    this.pastPen.begin(colours.com);
    source.sample(frame.time - TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 240, (one) => {
      if (!isFollowed(one)) this.planPen.lift();
      else if (read(one, "plan.com.p", this.plan)) {
        const [x, y] = this.plan as [number, number];
        this.planPen.to(this.point.set(x, y, this.plane.height(x, y)));
      }
      if (one.time <= frame.time && vector(one, "model.p_WCom", this.com))
        this.pastPen.to(this.com.setZ(this.plane.height(this.com.x, this.com.y) + 0.001));
    });
    this.planTrail.end();
    this.pastTrail.end();
  }
}
