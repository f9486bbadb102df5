import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { MeshLibrary } from "../src/scene/mesh_library.ts";

const OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const STL = "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid one\n";

/** A library of a program that has this file, by that name. */
function libraryOf(uri: string, text: string): MeshLibrary {
  const answer = { fetch: async () => new Response(text), requestAnimationFrame: (call: () => void) => setTimeout(call) };
  for (const [name, value] of Object.entries(answer)) Object.defineProperty(globalThis, name, { value, configurable: true });
  return new MeshLibrary([{ id: 0, uri, found: true }], Promise.resolve(), () => 0);
}

function materialsIn(object: THREE.Object3D): THREE.Material[] {
  const materials: THREE.Material[] = [];
  object.traverse((child) => child instanceof THREE.Mesh && materials.push(child.material as THREE.Material));
  return materials;
}

test("links that share a mesh have each its own material", async () => {
  for (const [uri, text] of [["package://a/foot.obj", OBJ], ["package://a/foot.STL", STL]] as const) {
    const library = libraryOf(uri, text);
    const paints = [new THREE.MeshPhongMaterial(), new THREE.MeshPhongMaterial()];
    const objects = await Promise.all(paints.map((material) => library.load(uri, material)));
    assert.deepEqual(objects.map((object) => materialsIn(object).map(({ uuid }) => uuid)), paints.map(({ uuid }) => [uuid]), uri);
  }
});
