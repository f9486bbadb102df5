import * as THREE from "three";
import { read } from "../data/frame.ts";
import type { Palette } from "../scene/palette.ts";
import { ON_GROUND_ORDER, paint, paintOnGround } from "./arrow.ts";
import { BelievedPlane } from "./ground_marks.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";
import { Pen, Trails } from "./trail.ts";

/** How much of the past and, of what is already known, the future a trail shows [s]. */
export const TRAIL_SECONDS = 3;

/** Centre of mass with its plumb line, and its plan on the ground. */
export class CentreOfMass implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly material = paint();
  private readonly planMaterial = paintOnGround();
  private readonly ball = new THREE.Mesh(new THREE.SphereGeometry(0.02, 20, 14), this.material);
  private readonly disc = new THREE.Mesh(new THREE.CircleGeometry(0.011, 24), this.material);
  private readonly ring = new THREE.Mesh(new THREE.RingGeometry(0.016, 0.022, 32), this.planMaterial);
  private readonly colour = new THREE.Color();
  private readonly planColour = new THREE.Color();
  private readonly plumb = new Trails(0.7, 1);
  private readonly planTrail = new Trails(1, 255, true);
  private readonly pastTrail = new Trails(0.7, 255, true);
  private readonly planPen = new Pen(this.planTrail, this.planColour);
  private readonly pastPen = new Pen(this.pastTrail, this.colour);
  private readonly plane = new BelievedPlane();
  private readonly com = new THREE.Vector3();
  private readonly point = new THREE.Vector3();
  private readonly plan = [0, 0];

  constructor() {
    this.material.depthTest = false; // seen through the torso
    this.ball.renderOrder = this.disc.renderOrder = 2;
    this.ring.renderOrder = ON_GROUND_ORDER;
    this.root.add(this.ball, this.disc, this.ring, this.plumb.lines, this.planTrail.lines, this.pastTrail.lines);
  }

  wear(palette: Palette): void {
    this.material.color.set(palette.com);
    this.colour.set(palette.com);
    this.planMaterial.color.set(palette.near);
    this.planColour.set(palette.near);
  }

  update(picture: Picture): void {
    const known = vector(picture.frame, "model.p_WCom", this.com) && this.plane.read(picture);
    this.root.visible = known;
    if (!known) return;
    const { x, y } = this.com;
    const ground = this.plane.height(x, y);
    this.ball.position.copy(this.com);
    this.disc.position.set(x, y, ground);
    this.plumb.begin();
    this.plumb.add(this.com, this.disc.position, this.colour);
    this.plumb.end();
    this.ring.visible = read(picture.frame, "plan.com.p", this.plan);
    const [px, py] = this.plan as [number, number];
    if (this.ring.visible) this.ring.position.set(px, py, this.plane.height(px, py));
    if (picture.trails) this.drawTrails(picture);
  }

  private drawTrails({ frame, source }: Picture): void {
    this.planTrail.begin();
    this.pastTrail.begin();
    this.planPen.lift();
    this.pastPen.lift();
    source.sample(frame.time - TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 240, (one) => {
      if (read(one, "plan.com.p", this.plan)) {
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
