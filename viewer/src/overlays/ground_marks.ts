import * as THREE from "three";
import { read, scalar } from "../data/frame.ts";
import { isFollowed } from "../data/hierarchy.ts";
import { MOST_LEGS } from "../data/schema.ts";
import { centreOfPressure, convexHull, planeHeight, type Point3 } from "../math/geometry.ts";
import type { Palette } from "../scene/palette.ts";
import { ON_GROUND, ON_GROUND_ORDER, paint, paintOnGround } from "./arrow.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";

/** Height of marks over the ground [m]. */
const OVER = 0.004;

/** The plane that the controller believes the ground to be. */
export class BelievedPlane {
  readonly normal = [0, 0, 1];
  private readonly point = [0, 0, 0];
  private readonly R: number[] = new Array<number>(9).fill(0);

  read({ frame, header }: Picture): boolean {
    if (!read(frame, "plan.R_WC", this.R) || !read(frame, "plan.terrain_point", this.point)) return false;
    this.normal[0] = this.R[2] as number;
    this.normal[1] = this.R[5] as number;
    this.normal[2] = this.R[8] as number;
    this.point[2] = (this.point[2] as number) - header.robot.foot_radius / (this.normal[2] as number);
    return true;
  }

  height(x: number, y: number): number {
    return planeHeight(this.point, this.normal, x, y) + OVER;
  }
}

/** Ground points of the feet that are in stance and, where the truth is known, touch the ground. */
export function standing({ frame, header }: Picture): Point3[] {
  const points: Point3[] = [];
  if (!isFollowed(frame)) return points;
  for (const leg of frame.schema.legs) {
    const foot: Point3 = [0, 0, 0];
    if (!(scalar(frame, leg.phase) <= 1) || scalar(frame, leg.touching) === 0 || !read(frame, leg.foot, foot)) continue;
    foot[2] += OVER - header.robot.foot_radius;
    points.push(foot);
  }
  return points;
}

/** Convex hull of the stance feet. */
export class SupportPolygon implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly fill = paintOnGround(0.16);
  private readonly line = new THREE.LineBasicMaterial(ON_GROUND);
  private readonly points = new THREE.BufferAttribute(new Float32Array(3 * MOST_LEGS), 3);
  private readonly area = new THREE.BufferGeometry().setAttribute("position", this.points).setIndex(Array.from({ length: MOST_LEGS - 2 }, (_, k) => [0, k + 1, k + 2]).flat());
  private readonly outline = new THREE.BufferGeometry().setAttribute("position", this.points);

  constructor() {
    const mesh = new THREE.Mesh(this.area, this.fill);
    const loop = new THREE.LineLoop(this.outline, this.line);
    mesh.frustumCulled = loop.frustumCulled = false;
    this.root.add(mesh, loop);
    this.root.renderOrder = ON_GROUND_ORDER;
  }

  recolour(palette: Palette): void {
    this.fill.color.set(palette.support);
    this.line.color.set(palette.support);
  }

  update(picture: Picture): void {
    const hull = convexHull(standing(picture));
    this.root.visible = hull.length >= 2;
    hull.forEach((corner, k) => this.points.setXYZ(k, ...corner));
    this.points.needsUpdate = true;
    this.area.setDrawRange(0, 3 * Math.max(0, hull.length - 2));
    this.outline.setDrawRange(0, hull.length);
  }
}

/** Zero-moment point of the plan (a square) and of the true forces (a ring). */
export class ZeroMomentPoint implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly material = paintOnGround();
  private readonly planned = new THREE.Mesh(new THREE.RingGeometry(0.012, 0.022, 4), this.material);
  private readonly actual = new THREE.Mesh(new THREE.RingGeometry(0.022, 0.03, 32), this.material);
  private readonly plane = new BelievedPlane();
  private readonly zmp = [0, 0];
  private readonly toBelief = new THREE.Matrix4();

  constructor() {
    this.root.add(this.planned, this.actual);
    this.root.renderOrder = ON_GROUND_ORDER;
  }

  recolour(palette: Palette): void {
    this.material.color.set(palette.zmp);
  }

  update(picture: Picture): void {
    const known = isFollowed(picture.frame) && this.plane.read(picture) && read(picture.frame, "plan.com.zmp", this.zmp);
    this.planned.visible = known;
    const [x, y] = this.zmp as [number, number];
    if (known) this.planned.position.set(x, y, this.plane.height(x, y) + 0.002);
    const points: number[][] = [];
    const forces: number[][] = [];
    for (const { touching, truePoint, trueForce } of picture.frame.schema.legs) {
      const point = [0, 0, 0];
      const force = [0, 0, 0];
      if (!(scalar(picture.frame, touching) > 0) || !read(picture.frame, truePoint, point) || !read(picture.frame, trueForce, force)) continue;
      points.push(point);
      forces.push(force);
    }
    const centre = centreOfPressure(points, forces);
    this.actual.visible = centre !== undefined;
    if (centre === undefined) return;
    this.actual.position.fromArray(centre).applyMatrix4(this.toBelief.copy(picture.beliefToWorld).invert());
    this.actual.position.z += OVER;
  }
}

/** A piece of the controller's terrain plane, with its normal. */
export class TerrainPlane implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly fill = paint(0.12);
  private readonly grid: THREE.GridHelper;
  private readonly R: number[] = new Array<number>(9).fill(0);
  private readonly point = new THREE.Vector3();
  private readonly basis = new THREE.Matrix4();

  constructor() {
    this.grid = new THREE.GridHelper(1.2, 12);
    this.grid.rotateX(Math.PI / 2);
    this.grid.material.transparent = true;
    this.grid.material.opacity = 0.35;
    const normal = new THREE.Mesh(new THREE.CylinderGeometry(0.003, 0.003, 0.2).rotateX(Math.PI / 2).translate(0, 0, 0.1), this.fill);
    this.root.add(new THREE.Mesh(new THREE.PlaneGeometry(1.2, 1.2), this.fill), this.grid, normal);
  }

  recolour(palette: Palette): void {
    this.fill.color.set(palette.plane);
    const colours = this.grid.geometry.getAttribute("color") as THREE.BufferAttribute;
    const colour = new THREE.Color(palette.plane);
    for (let i = 0; i < colours.count; ++i) colours.setXYZ(i, colour.r, colour.g, colour.b);
    colours.needsUpdate = true;
  }

  update({ frame, header }: Picture): void {
    const known = isFollowed(frame) && read(frame, "plan.R_WC", this.R) && vector(frame, "plan.terrain_point", this.point);
    this.root.visible = known;
    if (!known) return;
    const [a, b, c, d, e, f, g, h, i] = this.R as [number, number, number, number, number, number, number, number, number];
    this.basis.set(a, b, c, 0, d, e, f, 0, g, h, i, 0, 0, 0, 0, 1);
    this.root.quaternion.setFromRotationMatrix(this.basis);
    const down = OVER - header.robot.foot_radius;
    this.root.position.set(this.point.x + down * c, this.point.y + down * f, this.point.z + down * i);
  }
}
