import * as THREE from "three";
import { simplify } from "./simplify.ts";

/** Largest cell, as a share of the file's shortest extent: in larger cells tubes collapse. */
const THIN = 1 / 3;
/** Meshes with fewer triangles stay as they are. */
const SMALL = 200;

/** Replaces the meshes below `object` by coarser ones, for machines that draw slowly; `share`: size of the cells in which corners are merged, of
 * the file's longest extent. */
export function coarsen(object: THREE.Object3D, share: number): void {
  object.updateMatrixWorld(true);
  const extent = new THREE.Box3().setFromObject(object).getSize(new THREE.Vector3());
  const sides = extent.toArray();
  const cell = Math.min(share * Math.max(...sides), THIN * Math.min(...sides));
  if (!(cell > 0)) return;
  object.traverse((child) => {
    if (!(child instanceof THREE.Mesh)) return;
    const geometry = child.geometry as THREE.BufferGeometry;
    const position = geometry.getAttribute("position");
    if (geometry.index !== null || position.count < 3 * SMALL) return;
    const scale = child.getWorldScale(new THREE.Vector3()).x;
    child.geometry = coarser(geometry, position, cell / scale);
  });
}

function coarser(geometry: THREE.BufferGeometry, position: THREE.BufferAttribute | THREE.InterleavedBufferAttribute, cell: number): THREE.BufferGeometry {
  const uv = geometry.getAttribute("uv");
  const groups = geometry.groups.length > 0 ? geometry.groups : [{ start: 0, count: position.count, materialIndex: 0 }];
  const soup = { position: position.array as Float32Array, ...(uv === undefined ? {} : { uv: uv.array as Float32Array }) };
  const coarse = simplify(soup, cell, groups.map(({ start, count }) => [start, count]));
  const result = new THREE.BufferGeometry();
  result.setAttribute("position", new THREE.BufferAttribute(coarse.position, 3));
  if (coarse.uv !== undefined) result.setAttribute("uv", new THREE.BufferAttribute(coarse.uv, 2));
  result.setIndex(coarse.index);
  if (geometry.groups.length > 0)
    coarse.ranges.forEach(([begin, count], k) => result.addGroup(begin, count, groups[k]?.materialIndex ?? 0));
  result.computeVertexNormals();
  return result;
}
