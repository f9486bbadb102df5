import * as THREE from "three";
import { read } from "../data/frame.ts";
import type { Palette } from "../scene/palette.ts";
import { paint } from "./arrow.ts";
import { BelievedPlane } from "./ground_marks.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";
import { Trail, trailMaterial } from "./trail.ts";

/** How much of the past and, of what is already known, the future a trail shows [s]. */
export const TRAIL_SECONDS = 3;

/** Centre of mass with its plumb line, and its plan on the ground. */
export class CentreOfMass implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly material = paint();
  private readonly planMaterial = paint();
  private readonly ball = new THREE.Mesh(new THREE.SphereGeometry(0.02, 20, 14), this.material);
  private readonly disc = new THREE.Mesh(new THREE.CircleGeometry(0.011, 24), this.material);
  private readonly ring = new THREE.Mesh(new THREE.RingGeometry(0.016, 0.022, 32), this.planMaterial);
  private readonly plumbMaterial = trailMaterial(0.7);
  private readonly plumb = new Trail(this.plumbMaterial, 2);
  private readonly planLine = trailMaterial();
  private readonly planTrail = new Trail(this.planLine);
  private readonly pastTrail = new Trail(this.plumbMaterial);
  private readonly plane = new BelievedPlane();
  private readonly com = new THREE.Vector3();
  private readonly plan = [0, 0];

  constructor() {
    this.material.depthTest = false; // seen through the torso
    this.ball.renderOrder = this.disc.renderOrder = 2;
    this.root.add(this.ball, this.disc, this.ring, this.plumb.line, this.planTrail.line, this.pastTrail.line);
  }

  wear(palette: Palette): void {
    this.material.color.set(palette.com);
    this.plumbMaterial.color.set(palette.com);
    this.planMaterial.color.set(palette.near);
    this.planLine.color.set(palette.near);
  }

  update(picture: Picture): void {
    const known = vector(picture.frame, "model.p_WCom", this.com) && this.plane.read(picture);
    this.root.visible = known;
    if (!known) return;
    const { x, y, z } = this.com;
    const ground = this.plane.height(x, y);
    this.ball.position.copy(this.com);
    this.disc.position.set(x, y, ground);
    this.plumb.begin();
    this.plumb.add(x, y, z);
    this.plumb.add(x, y, ground);
    this.plumb.end();
    this.ring.visible = read(picture.frame, "plan.com.p", this.plan);
    const [px, py] = this.plan as [number, number];
    if (this.ring.visible) this.ring.position.set(px, py, this.plane.height(px, py));
    if (picture.trails) this.drawTrails(picture);
  }

  private drawTrails({ frame, source }: Picture): void {
    this.planTrail.begin();
    this.pastTrail.begin();
    source.sample(frame.time - TRAIL_SECONDS, frame.time + TRAIL_SECONDS, 240, (one) => {
      if (read(one, "plan.com.p", this.plan)) {
        const [x, y] = this.plan as [number, number];
        this.planTrail.add(x, y, this.plane.height(x, y));
      }
      if (one.time <= frame.time && vector(one, "model.p_WCom", this.com))
        this.pastTrail.add(this.com.x, this.com.y, this.plane.height(this.com.x, this.com.y) + 0.001);
    });
    this.planTrail.end();
    this.pastTrail.end();
  }
}
