import * as THREE from "three";
import { ColladaLoader } from "three/examples/jsm/loaders/ColladaLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";
import { coarsen } from "./coarse_mesh.ts";
import { merged } from "./merge.ts";
import { askUntilAnswered, pause, textOf } from "../protocol/ask.ts";
import type { MeshInfo } from "../protocol/session.ts";

/** Pause before a mesh is requested again after a lost connection [ms]. */
const AGAIN = 1000;

/** Which meshes are replaced by primitives, and where to look; `missing`: reasons by address. "": none. */
export function missingText(missing: Map<string, string> = new Map()): string {
  if (missing.size === 0) return "";
  const names = [...missing.keys()].map((uri) => uri.slice(uri.lastIndexOf("/") + 1));
  const list = names.length > 3 ? `${names.slice(0, 3).join(", ")} and ${names.length - 3} more` : names.join(", ");
  return `Shown by primitives, as these meshes are missing: ${list}. $SUREFOOT_ROBOT_PACKAGES of the program says where they are looked for.`;
}

const kindOf = (uri: string): string => uri.slice(uri.lastIndexOf(".") + 1).toLowerCase();

/** Meshes of other kinds get their material from the URDF, link by link. */
const hasMaterials = (uri: string): boolean => kindOf(uri) === "dae";

function meshesOf(object: THREE.Object3D): THREE.Mesh[] {
  const meshes: THREE.Mesh[] = [];
  object.traverse((child) => child instanceof THREE.Mesh && meshes.push(child));
  return meshes;
}

function paint(object: THREE.Object3D, material: THREE.Material): void {
  for (const mesh of meshesOf(object)) mesh.material = material;
}

/** Loads each mesh of the session once, one after the other, with pictures in between. */
export class MeshLibrary {
  /** Meshes that could not be shown, and why. */
  readonly missing = new Map<string, string>();
  /** Meshes that are still loading. */
  loading = 0;
  /** All meshes requested so far. */
  wanted = 0;
  onMissing: () => void = () => {};
  onLoad: () => void = () => {};
  private readonly byUri = new Map<string, MeshInfo>();
  private readonly loads = new Map<string, Promise<THREE.Object3D>>();
  private queue: Promise<unknown>;

  /** Nothing is loaded before `ready`; `detail`: the smallest that is kept of a mesh, as a share of its size; 0: all. */
  constructor(
    meshes: MeshInfo[],
    ready: Promise<void>,
    private readonly detail: () => number,
  ) {
    this.queue = ready;
    for (const mesh of meshes) this.byUri.set(mesh.uri, mesh);
  }

  /** A copy that shares its geometry, with `material` unless the file has its own. Throws where there is no such mesh. */
  async load(uri: string, material: THREE.Material): Promise<THREE.Object3D> {
    let loading = this.loads.get(uri);
    if (loading === undefined) this.loads.set(uri, (loading = this.enqueue(() => this.fetch(uri))));
    try {
      const object = (await loading).clone();
      if (!hasMaterials(uri)) paint(object, material);
      this.onLoad();
      return object;
    } catch (error) {
      this.missing.set(uri, (error as Error).message);
      this.onMissing();
      throw error;
    }
  }

  /** Loading progress; "" where all meshes are loaded. */
  get progress(): string {
    return this.loading === 0 ? "" : `Loading meshes: ${this.wanted - this.loading} of ${this.wanted} are here`;
  }

  private enqueue<T>(work: () => Promise<T>): Promise<T> {
    ++this.loading;
    ++this.wanted;
    const result = this.queue.then(() => nextPicture()).then(work);
    this.queue = result.catch(() => undefined).then(() => --this.loading);
    return result;
  }

  private async fetch(uri: string): Promise<THREE.Object3D> {
    const info = this.byUri.get(uri);
    if (info === undefined || !info.found) throw new Error("the file is not there");
    const bytes = await askUntilAnswered(`/api/mesh/${info.id}`, () => pause(AGAIN));
    const rest = new Rest();
    const read = this.parse(uri, bytes);
    await rest.take();
    const detail = this.detail();
    if (detail > 0) coarsen(read, detail);
    await rest.take();
    const object = hasMaterials(uri) ? merged(read) : read;
    for (const mesh of meshesOf(object)) mesh.castShadow = mesh.receiveShadow = true;
    return object;
  }

  private parse(uri: string, bytes: ArrayBuffer): THREE.Object3D {
    const kind = kindOf(uri);
    switch (kind) {
      case "dae":
        return this.collada(uri, textOf(bytes));
      case "stl":
        return new THREE.Mesh(new STLLoader().parse(bytes));
      case "obj":
        return new OBJLoader().parse(textOf(bytes));
      default:
        throw new Error(`files of kind .${kind} can't be read; .dae, .stl and .obj can`);
    }
  }

  private collada(uri: string, text: string): THREE.Object3D {
    const folder = uri.slice(0, uri.lastIndexOf("/") + 1);
    const manager = new THREE.LoadingManager();
    manager.setURLModifier((url) => this.image(folder, url));
    manager.onLoad = () => this.onLoad();
    const scene = new ColladaLoader(manager).parse(text, folder)?.scene;
    if (scene === undefined) throw new Error("the file is no Collada document");
    const lights: THREE.Object3D[] = [];
    scene.traverse((child) => {
      if (child instanceof THREE.Light || child instanceof THREE.Camera) lights.push(child);
      if (child instanceof THREE.Mesh) child.material = plain(child.material);
    });
    for (const light of lights) light.removeFromParent();
    return scene;
  }

  /** Address of an image that a Collada file names; grey where the server has none. */
  private image(folder: string, url: string): string {
    const name = url.startsWith(folder) ? url : folder + url.replace(/^.*\//, "");
    const info = this.byUri.get(name);
    if (info?.found) return `/api/mesh/${info.id}`;
    return GREY;
  }
}

const GREY = `data:image/svg+xml,${encodeURIComponent('<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"><rect width="1" height="1" fill="#7d858c"/></svg>')}`;

/** Matt, as robots are: the files' highlights come from the tools that wrote them. */
function plain(material: THREE.Material | THREE.Material[]): THREE.Material | THREE.Material[] {
  if (Array.isArray(material)) return material.map((one) => plain(one) as THREE.Material);
  const { color, map } = material as THREE.MeshPhongMaterial;
  return new THREE.MeshLambertMaterial({
    color: map ? 0xffffff : color,
    map,
    side: THREE.DoubleSide,
  });
}

/** Shorter work needs no rest [ms]. */
const SHORT_WORK = 200;
/** Longest rest between two pieces of work [ms]. */
const LONGEST_REST = 300;

/** Rests after each piece of work for as long as it took, so that data and pictures get their turn. */
class Rest {
  private since = performance.now();

  async take(): Promise<void> {
    const took = performance.now() - this.since;
    if (took < SHORT_WORK) return;
    await pause(Math.min(took, LONGEST_REST));
    this.since = performance.now();
  }
}

/** Ends after the next picture, or after a short time in a hidden tab. */
function nextPicture(): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, 200);
    requestAnimationFrame(() => {
      clearTimeout(timer);
      setTimeout(resolve, 0);
    });
  });
}
