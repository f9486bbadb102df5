import * as THREE from "three";

/** A line through points that change; made once for at most `capacity` of them. */
export class Trail {
  readonly line: THREE.Line;
  private readonly points: THREE.BufferAttribute;
  private readonly geometry = new THREE.BufferGeometry();
  private count = 0;

  constructor(
    material: THREE.LineBasicMaterial,
    private readonly capacity = 256,
  ) {
    this.points = new THREE.BufferAttribute(new Float32Array(3 * capacity), 3);
    this.geometry.setAttribute("position", this.points);
    this.line = new THREE.Line(this.geometry, material);
    this.line.frustumCulled = false;
  }

  begin(): void {
    this.count = 0;
  }

  add(x: number, y: number, z: number): void {
    if (this.count < this.capacity) this.points.setXYZ(this.count++, x, y, z);
  }

  end(): void {
    this.geometry.setDrawRange(0, this.count);
    this.points.needsUpdate = true;
  }
}

export function trailMaterial(opacity = 1): THREE.LineBasicMaterial {
  return new THREE.LineBasicMaterial({ transparent: opacity < 1, opacity, fog: false });
}
