import * as THREE from "three";
import { ON_GROUND, ON_GROUND_ORDER } from "./arrow.ts";

/** Coloured line segments, at most `capacity`, drawn in one call. */
export class Trails {
  readonly lines: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly points: THREE.BufferAttribute;
  private readonly colours: THREE.BufferAttribute;
  private readonly geometry = new THREE.BufferGeometry();
  private count = 0;

  constructor(opacity: number, private readonly capacity: number, onGround = false) {
    this.points = attribute(2 * capacity);
    this.colours = attribute(2 * capacity);
    this.geometry.setAttribute("position", this.points).setAttribute("color", this.colours);
    const material = new THREE.LineBasicMaterial({ vertexColors: true, opacity, fog: false, ...(onGround ? ON_GROUND : { transparent: opacity < 1 }) });
    this.lines = new THREE.LineSegments(this.geometry, material);
    if (onGround) this.lines.renderOrder = ON_GROUND_ORDER;
    this.lines.frustumCulled = this.lines.matrixAutoUpdate = false;
  }

  begin(): void {
    this.count = 0;
  }

  add(from: THREE.Vector3, to: THREE.Vector3, colour: THREE.Color): void {
    if (this.count === this.capacity) return;
    for (const [i, point] of [[2 * this.count, from], [2 * this.count + 1, to]] as const) {
      this.points.setXYZ(i, point.x, point.y, point.z);
      this.colours.setXYZ(i, colour.r, colour.g, colour.b);
    }
    ++this.count;
  }

  end(): void {
    this.geometry.setDrawRange(0, 2 * this.count);
    this.lines.visible = this.count > 0;
    this.points.needsUpdate = this.colours.needsUpdate = this.lines.visible;
  }
}

/** Adds a line to trails, point by point. */
export class Pen {
  private readonly last = new THREE.Vector3();
  private down = false;
  private colour = new THREE.Color();

  constructor(private readonly trails: Trails) {}

  /** Begins a line in this colour. */
  begin(colour: THREE.Color): void {
    this.colour = colour;
    this.lift();
  }

  lift(): void {
    this.down = false;
  }

  to(point: THREE.Vector3): void {
    if (this.down) this.trails.add(this.last, point, this.colour);
    this.last.copy(point);
    this.down = true;
  }
}

/** An attribute whose numbers change with each picture. */
export function attribute(count: number, size = 3): THREE.BufferAttribute {
  return new THREE.BufferAttribute(new Float32Array(size * count), size).setUsage(THREE.DynamicDrawUsage);
}
