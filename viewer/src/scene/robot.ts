import * as THREE from "three";
import URDFLoader, { type URDFRobot } from "urdf-loader";
import type { MeshLibrary } from "./mesh_library.ts";
import { bend, type Posture } from "./posture.ts";

/** A robot made from the URDF: its primitives at once, its meshes as they come. */
export class Robot {
  readonly root = new THREE.Group();
  readonly urdf: URDFRobot;
  private readonly primitives: THREE.Object3D[] = [];
  /** Centres of mass of the links, in their frames. */
  private readonly centres = new Map<string, THREE.Vector3>();

  /** `paint`: replaces every material, e.g. for a ghost. */
  constructor(urdf: string, library: MeshLibrary, private readonly paint?: THREE.Material) {
    const loader = new URDFLoader();
    loader.packages = (name: string) => `package://${name}`;
    loader.parseCollision = true;
    loader.loadMeshCb = (path, _manager, material, done) => {
      library.load(path, material).then(
        (object) => {
          done(object);
          this.dress();
        },
        () => this.dress(), // the library notes it
      );
    };
    this.urdf = loader.parse(urdf);
    this.root.add(this.urdf);
    for (const joint of Object.values(this.urdf.joints)) joint.ignoreLimits = true;
    this.collect();
    this.dress();
  }

  private collect(): void {
    for (const [name, { urdfNode }] of Object.entries(this.urdf.links)) this.centres.set(name, centreIn(urdfNode));
    this.urdf.traverse((child) => {
      if ("isURDFCollider" in child) this.primitives.push(child);
    });
    const body = new THREE.MeshLambertMaterial({ color: 0x9aa3ab });
    const ball = new THREE.SphereGeometry(1, 16, 10); // the loader's has 1740 triangles
    for (const primitive of this.primitives)
      primitive.traverse((child) => {
        if (!(child instanceof THREE.Mesh)) return;
        child.material = body;
        if (child.geometry instanceof THREE.SphereGeometry) child.geometry = ball;
        child.castShadow = child.receiveShadow = true;
      });
  }

  /** A link shows its meshes where they are all here, its primitives otherwise. */
  private dress(): void {
    this.urdf.traverse(stand);
    for (const primitive of this.primitives) {
      const siblings = (primitive.parent as THREE.Object3D).children.filter((child) => "isURDFVisual" in child);
      const dressed = siblings.length > 0 && siblings.every((visual) => visual.children.length > 0);
      primitive.visible = !dressed;
    }
    if (this.paint === undefined) return;
    this.urdf.traverse((child) => {
      if (!(child instanceof THREE.Mesh)) return;
      child.material = this.paint as THREE.Material;
      child.castShadow = child.receiveShadow = false;
    });
  }

  /** `joints`: names, in the posture's order; `like`: source of unknown angles. */
  pose({ p_SB, q_SB, q }: Posture, joints: string[], like?: Robot): void {
    this.root.position.set(p_SB[0] as number, p_SB[1] as number, p_SB[2] as number);
    this.root.quaternion.set(q_SB[1] as number, q_SB[2] as number, q_SB[3] as number, q_SB[0] as number);
    bend(this.urdf, joints, q, like?.urdf);
  }

  /** Centre of mass of a link in S [m], as the URDF has it; false: there is no link of that name. */
  centreOf(name: string, out: THREE.Vector3): boolean {
    const link = this.urdf.links[name], centre = this.centres.get(name);
    if (link === undefined || centre === undefined) return false;
    link.localToWorld(out.copy(centre));
    return true;
  }

  /** Place [m] and axis of a joint in S; false: there is no joint of that name. */
  axisOf(name: string, place: THREE.Vector3, axis: THREE.Vector3): boolean {
    const joint = this.urdf.joints[name];
    if (joint === undefined) return false;
    joint.getWorldPosition(place);
    axis.copy(joint.axis).transformDirection(joint.matrixWorld);
    return true;
  }
}

/** Only joints move relative to their parents; all other local transforms are computed once. */
function stand(part: THREE.Object3D): void {
  part.matrixAutoUpdate = "isURDFJoint" in part;
  if (!part.matrixAutoUpdate) part.updateMatrix();
}

/** A link's centre of mass in its frame; the frame's origin where the URDF has no inertia. */
function centreIn(link: Element | null): THREE.Vector3 {
  const origin = [...(link?.children ?? [])].find(({ nodeName }) => nodeName === "inertial")?.querySelector("origin");
  const [x = 0, y = 0, z = 0] = (origin?.getAttribute("xyz") ?? "").split(/\s+/).filter((word) => word !== "").map(Number);
  return new THREE.Vector3(x, y, z);
}
