import * as THREE from "three";
import { read, scalar } from "../data/frame.ts";
import { pyramidUse } from "../data/pyramid_use.ts";
import { MOST_LEGS } from "../data/schema.ts";
import { percent, pyramidCorners, pyramidHeight, useClass } from "../math/friction.ts";
import { SEEN_THROUGH } from "./arrow.ts";
import { vector, type Overlay, type Picture } from "./overlay.ts";
import { attribute } from "./trail.ts";

/** Sides as triangles: tip 0, corners 1 … 4. */
const SIDES = [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1];
/** Opacity of the sides. */
const DENSITY = { good: 0.18, near: 0.35, bad: 0.55 };
const EDGES = [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1];

/** Some pyramids, each in its colour and density; sides and edges are drawn in one call each. */
class Pyramids {
  readonly root = new THREE.Group();
  private readonly points: THREE.BufferAttribute;
  private readonly sideColours: THREE.BufferAttribute;
  private readonly edgeColours: THREE.BufferAttribute;
  private readonly sides = new THREE.BufferGeometry();
  private readonly edges = new THREE.BufferGeometry();
  private count = 0;

  /** `over`: no body hides them. */
  constructor(private readonly capacity: number, over = false) {
    this.points = attribute(5 * capacity, 3);
    this.sideColours = attribute(5 * capacity, 4);
    this.edgeColours = attribute(5 * capacity, 3);
    const each = (list: number[]): number[] => Array.from({ length: capacity }, (_, k) => list.map((corner) => 5 * k + corner)).flat();
    this.sides.setAttribute("position", this.points).setAttribute("color", this.sideColours).setIndex(each(SIDES));
    this.edges.setAttribute("position", this.points).setAttribute("color", this.edgeColours).setIndex(each(EDGES));
    const fill = new THREE.MeshBasicMaterial({ ...SEEN_THROUGH, vertexColors: true, fog: false, depthTest: !over });
    const mesh = new THREE.Mesh(this.sides, fill);
    const lines = new THREE.LineSegments(this.edges, new THREE.LineBasicMaterial({ vertexColors: true, fog: false, depthTest: !over, transparent: over }));
    if (over) mesh.renderOrder = lines.renderOrder = 1;
    mesh.frustumCulled = lines.frustumCulled = mesh.matrixAutoUpdate = lines.matrixAutoUpdate = false;
    this.root.add(mesh, lines);
  }

  begin(): void {
    this.count = 0;
  }

  add(tip: THREE.Vector3, corners: number[][], colour: THREE.Color, density: number, edge = colour): void {
    if (this.count === this.capacity) return;
    const first = 5 * this.count++;
    this.points.setXYZ(first, tip.x, tip.y, tip.z);
    corners.forEach(([x, y, z], k) => this.points.setXYZ(first + 1 + k, tip.x + (x as number), tip.y + (y as number), tip.z + (z as number)));
    for (let k = first; k < first + 5; ++k) {
      this.sideColours.setXYZW(k, colour.r, colour.g, colour.b, density);
      this.edgeColours.setXYZ(k, edge.r, edge.g, edge.b);
    }
  }

  end(): void {
    this.sides.setDrawRange(0, SIDES.length * this.count);
    this.edges.setDrawRange(0, EDGES.length * this.count);
    this.root.visible = this.count > 0;
    this.points.needsUpdate = this.sideColours.needsUpdate = this.edgeColours.needsUpdate = this.root.visible;
  }
}

/**
 * The friction pyramids of the solution, as high as the normal force: friction holds a force that ends inside the square. Colour and label show the
 * share of the pyramid that is used. Pyramids that are nearly used up are visible through their leg.
 */
export class FrictionPyramids implements Overlay {
  readonly space = "belief";
  readonly root = new THREE.Group();
  private readonly pyramids = new Pyramids(MOST_LEGS);
  private readonly alarms = new Pyramids(MOST_LEGS, true);
  private readonly tip = new THREE.Vector3();
  private readonly outline = Array.from({ length: 5 }, () => new THREE.Vector3());
  private readonly q_WP = [1, 0, 0, 0];

  constructor() {
    this.root.add(this.pyramids.root, this.alarms.root);
  }

  update({ frame, header, labels, colours, newton, beliefToWorld }: Picture): void {
    this.pyramids.begin();
    this.alarms.begin();
    frame.schema.legs.forEach((leg, k) => {
      const use = pyramidUse(frame, leg);
      if (Number.isNaN(use) || !read(frame, leg.pyramid, this.q_WP) || !vector(frame, leg.foot, this.tip)) return;
      this.tip.z -= header.robot.foot_radius;
      const height = pyramidHeight(scalar(frame, leg.normalForce), frame.schema.weight, newton);
      const corners = pyramidCorners(this.q_WP, scalar(frame, leg.pyramidFriction), height);
      const kind = useClass(use);
      if (kind === "bad") this.alarms.add(this.tip, corners, colours.margin.bad, DENSITY.bad, colours.alarmEdge);
      else this.pyramids.add(this.tip, corners, colours.margin[kind], DENSITY[kind]);
      labels.spare(this.outlineOf(corners, beliefToWorld));
      labels.put(this.tip.applyMatrix4(beliefToWorld), `${leg.name} ${percent(use)}`, `use leg${k} ${kind}`, true);
    });
    this.pyramids.end();
    this.alarms.end();
  }

  /** Tip and corners in S. */
  private outlineOf(corners: number[][], beliefToWorld: THREE.Matrix4): THREE.Vector3[] {
    this.outline.forEach((point, k) => point.fromArray(corners[k] ?? [0, 0, 0]).add(this.tip).applyMatrix4(beliefToWorld));
    return this.outline;
  }
}
