import * as THREE from "three";

const SHAFT = new THREE.CylinderGeometry(1, 1, 1, 10, 1).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const HEAD = new THREE.ConeGeometry(1, 1, 14).rotateX(Math.PI / 2).translate(0, 0, 0.5);
const UP = new THREE.Vector3(0, 0, 1);

/** An arrow that is made once and moved. */
export class Arrow {
  readonly root = new THREE.Group();
  readonly tip = new THREE.Vector3();
  private readonly shaft: THREE.Mesh;
  private readonly head: THREE.Mesh;
  private readonly direction = new THREE.Vector3();

  constructor(
    material: THREE.Material,
    private readonly radius = 0.0075,
  ) {
    this.shaft = new THREE.Mesh(SHAFT, material);
    this.head = new THREE.Mesh(HEAD, material);
    this.root.add(this.shaft, this.head);
    this.root.visible = false;
  }

  /** From `start` along `vector` [m]; hidden where it is too short to see. */
  set(start: THREE.Vector3, vector: THREE.Vector3): boolean {
    const length = vector.length();
    this.root.visible = length > 0.01;
    this.tip.copy(start).add(vector);
    if (!this.root.visible) return false;
    this.root.position.copy(start);
    this.root.quaternion.setFromUnitVectors(UP, this.direction.copy(vector).divideScalar(length));
    const head = Math.min(4.5 * this.radius, 0.5 * length);
    this.shaft.scale.set(this.radius, this.radius, length - head);
    this.head.scale.set(2.2 * this.radius, 2.2 * this.radius, head);
    this.head.position.z = length - head;
    return true;
  }

  hide(): void {
    this.root.visible = false;
  }
}

/** Paint that keeps its colour in any light. */
export function paint(opacity = 1): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({
    transparent: opacity < 1,
    opacity,
    depthWrite: opacity === 1,
    side: opacity < 1 ? THREE.DoubleSide : THREE.FrontSide,
    forceSinglePass: true, // of one colour: which side comes first is not seen
    fog: false,
  });
}
