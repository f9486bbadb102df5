import * as THREE from "three";
import { read, scalar } from "../data/frame.ts";
import { LEG_CHANNELS, LEGS } from "../data/schema.ts";
import { frictionState, marginClass, pyramidAxes, pyramidCorners } from "../math/friction.ts";
import type { Palette } from "../scene/palette.ts";
import { paint } from "./arrow.ts";
import type { Overlay, Picture } from "./overlay.ts";

/** Sides as triangles: tip 0, corners 1 … 4. */
const SIDES = [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1];
/** How dense the sides are: the less is left, the denser. */
const DENSITY = { good: 0.18, near: 0.35, bad: 0.55 };
const EDGES = [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1];

class Pyramid {
  readonly root = new THREE.Group();
  readonly fill = paint(0.22);
  readonly line = new THREE.LineBasicMaterial({ fog: false });
  private readonly points = new THREE.BufferAttribute(new Float32Array(15), 3);

  constructor() {
    const sides = new THREE.BufferGeometry().setAttribute("position", this.points).setIndex(SIDES);
    const edges = new THREE.BufferGeometry().setAttribute("position", this.points).setIndex(EDGES);
    const mesh = new THREE.Mesh(sides, this.fill);
    const lines = new THREE.LineSegments(edges, this.line);
    mesh.frustumCulled = lines.frustumCulled = false;
    this.root.add(mesh, lines);
  }

  set(corners: number[][]): void {
    corners.forEach(([x, y, z], k) => this.points.setXYZ(k + 1, x as number, y as number, z as number));
    this.points.needsUpdate = true;
  }
}

/**
 * The friction pyramids that hold the solution's forces, as high as the normal force: an arrow whose tip lies within
 * the square is within friction. Coloured by μ f_n − |f_t|.
 */
export class FrictionPyramids implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly pyramids = LEGS.map(() => new Pyramid());
  private readonly colours = { good: 0, near: 0, bad: 0 };
  private readonly R: number[] = new Array<number>(9).fill(0);
  private readonly force = [0, 0, 0];
  private readonly point = [0, 0, 0];

  constructor() {
    for (const pyramid of this.pyramids) this.root.add(pyramid.root);
  }

  wear(palette: Palette): void {
    Object.assign(this.colours, palette.margin);
  }

  update({ frame, header, tasks, newton }: Picture): void {
    const known = read(frame, "plan.R_WC", this.R);
    const choices = tasks.find(({ task }) => task === "friction_cone")?.choices;
    const axes = pyramidAxes(this.R, choices?.["axes"] === "gravity");
    const inner = choices?.["pyramid"] === "outer" ? 1 : Math.SQRT1_2;
    LEGS.forEach((_, k) => {
      const pyramid = this.pyramids[k] as Pyramid;
      pyramid.root.visible = false;
      if (!known || !(scalar(frame, LEG_CHANNELS.phase[k] as string) <= 1)) return;
      if (!read(frame, LEG_CHANNELS.force[k] as string, this.force) || !read(frame, LEG_CHANNELS.foot[k] as string, this.point)) return;
      const mu = scalar(frame, LEG_CHANNELS.friction[k] as string);
      const normal = [axes[2] as number, axes[5] as number, axes[8] as number];
      const state = frictionState(this.force, normal, mu);
      if (!(state.normal > 2)) return;
      const margin = marginClass(state.share);
      const colour = this.colours[margin];
      pyramid.fill.opacity = DENSITY[margin];
      pyramid.fill.color.set(colour);
      pyramid.line.color.set(colour);
      pyramid.set(pyramidCorners(axes, inner * mu, state.normal * newton));
      const r = header.robot.foot_radius;
      pyramid.root.position.set(
        (this.point[0] as number) - r * (normal[0] as number),
        (this.point[1] as number) - r * (normal[1] as number),
        (this.point[2] as number) - r * (normal[2] as number),
      );
      pyramid.root.visible = true;
    });
  }
}
