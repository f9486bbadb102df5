import * as THREE from "three";

/** Many copies of a shape, each at its place and in its colour, drawn in one call. */
export class Copies {
  readonly mesh: THREE.InstancedMesh;
  private readonly colours: THREE.InstancedBufferAttribute;

  /** The material must be white. */
  constructor(geometry: THREE.BufferGeometry, material: THREE.MeshBasicMaterial, capacity: number) {
    this.mesh = new THREE.InstancedMesh(geometry, material, capacity);
    this.colours = new THREE.InstancedBufferAttribute(new Float32Array(3 * capacity), 3);
    this.mesh.instanceColor = this.colours;
    this.mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    this.mesh.frustumCulled = this.mesh.matrixAutoUpdate = false;
    this.begin();
    this.end();
  }

  begin(): void {
    this.mesh.count = 0;
  }

  add(place: THREE.Matrix4, colour: THREE.Color): void {
    if (this.mesh.count === this.mesh.instanceMatrix.count) return;
    this.mesh.setMatrixAt(this.mesh.count, place);
    this.mesh.setColorAt(this.mesh.count++, colour);
  }

  end(): void {
    this.mesh.visible = this.mesh.count > 0;
    this.mesh.instanceMatrix.needsUpdate = this.colours.needsUpdate = this.mesh.visible;
  }
}
