import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { merged } from "../src/scene/merge.ts";
import { randomNumbers } from "./make.ts";

interface Triangle {
  corners: number[][];
  normals: number[][];
  look: string;
}

const IMAGES = [new THREE.Texture(), new THREE.Texture()];

/** All triangles below an object as they are drawn, in the coordinates of its parent. */
function trianglesOf(object: THREE.Object3D): Triangle[] {
  object.updateMatrixWorld(true);
  const found: Triangle[] = [];
  object.traverse((child) => {
    if (!(child instanceof THREE.Mesh)) return;
    const { geometry, material } = child as THREE.Mesh<THREE.BufferGeometry>;
    const [position, normal, uv, colour] = ["position", "normal", "uv", "color"].map((name) => geometry.getAttribute(name)) as THREE.BufferAttribute[];
    const count = geometry.index?.count ?? (position as THREE.BufferAttribute).count;
    const groups = Array.isArray(material) ? geometry.groups : [{ start: 0, count, materialIndex: 0 }];
    const turn = new THREE.Matrix3().getNormalMatrix(child.matrixWorld);
    for (const group of groups) {
      const { map, color, vertexColors } = [material].flat()[group.materialIndex ?? 0] as THREE.MeshLambertMaterial;
      for (let i = group.start; i < group.start + group.count; i += 3) {
        const corners = [i, i + 1, i + 2].map((k) => geometry.index?.getX(k) ?? k);
        const first = corners[0] as number;
        const seen = vertexColors ? new THREE.Color().fromBufferAttribute(colour as THREE.BufferAttribute, first) : color;
        const place = corners.map((k) => new THREE.Vector3().fromBufferAttribute(position as THREE.BufferAttribute, k).applyMatrix4(child.matrixWorld).toArray());
        if (child.matrixWorld.determinant() < 0) place.reverse(); // as it is drawn then
        const at = corners.map((k) => [uv?.getX(k), uv?.getY(k)].map((x) => x?.toFixed(5)).join());
        const normals = corners.map((k) => new THREE.Vector3().fromBufferAttribute(normal as THREE.BufferAttribute, k).applyMatrix3(turn).normalize().toArray());
        found.push({ corners: place, normals, look: map === null ? seen.getHexString() : `${IMAGES.indexOf(map)} ${at.sort().join(" ")}` });
      }
    }
  });
  return found;
}

function randomObject(random: () => number): THREE.Object3D {
  const paint = (): THREE.MeshLambertMaterial =>
    random() < 0.4 ? new THREE.MeshLambertMaterial({ map: IMAGES[Math.floor(2 * random())] as THREE.Texture }) : new THREE.MeshLambertMaterial({ color: Math.floor(0xffffff * random()) });
  const turned = <T extends THREE.Object3D>(one: T): T => {
    one.position.set(random(), random(), random());
    one.quaternion.set(random(), random(), random(), random()).normalize();
    one.scale.set(0.2 + random(), 0.2 + random(), random() < 0.5 ? -1 : 0.5);
    return one;
  };
  const root = new THREE.Group();
  root.scale.setScalar(0.1 + random());
  let holder: THREE.Object3D = root;
  for (let k = 0; k < 1 + Math.floor(5 * random()); ++k) {
    const box = new THREE.BoxGeometry(random(), random(), random()); // has indices and six groups
    const geometry = random() < 0.5 ? box.toNonIndexed() : box;
    const mesh = turned(new THREE.Mesh(geometry, random() < 0.5 ? paint() : Array.from({ length: 6 }, paint)));
    holder.add(mesh);
    if (random() < 0.5) holder = mesh;
  }
  return root;
}

const nearest = (triangle: Triangle, all: Triangle[]): number =>
  Math.min(...all.filter(({ look }) => look === triangle.look).map((other) => off(triangle, other)));

/** How far apart the same corners of two triangles are at most, wherever they begin to count. */
function off(a: Triangle, b: Triangle): number {
  return Math.min(...[0, 1, 2].map((shift) => Math.max(...a.corners.flatMap((corner, k) => corner.map((x, i) => Math.abs(x - ((b.corners[(k + shift) % 3] as number[])[i] as number)))))));
}

test("merged meshes have the triangles, sides, colours and images of those that they were", () => {
  const random = randomNumbers(7);
  for (let round = 0; round < 40; ++round) {
    const object = randomObject(random);
    const before = trianglesOf(object);
    const result = merged(object);
    const after = trianglesOf(result);
    assert.equal(after.length, before.length);
    for (const triangle of before) assert.ok(nearest(triangle, after) < 1e-5);
    const normals = (list: Triangle[]): number => list.flatMap((one) => one.normals.flat()).reduce((sum, x) => sum + x, 0);
    assert.ok(Math.abs(normals(before) - normals(after)) < 1e-3);
  }
});

test("merged meshes are one for what has no image, and one for each image", () => {
  const random = randomNumbers(8);
  for (let round = 0; round < 40; ++round) {
    const object = randomObject(random);
    const looks = new Set(trianglesOf(object).map(({ look }) => (look.includes(" ") ? look[0] : "")));
    const result = merged(object);
    assert.equal(result.children.length, looks.size);
    assert.ok(result.children.every((child) => child.children.length === 0));
  }
});
