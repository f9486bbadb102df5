import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { coarsen } from "../src/scene/coarse_mesh.ts";
import { simplify } from "../src/scene/simplify.ts";

/** A square of n × n quads in the plane z = 0, as triangles; edge 1. */
function square(n: number): Float32Array {
  const corners: number[] = [];
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < n; ++j) {
      const [x, y, d] = [i / n, j / n, 1 / n];
      corners.push(x, y, 0, x + d, y, 0, x + d, y + d, 0, x, y, 0, x + d, y + d, 0, x, y + d, 0);
    }
  return Float32Array.from(corners);
}

function area(position: Float32Array, index: number[]): number {
  let sum = 0;
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * (index[t + k] as number)) as [number, number, number];
    const at = (i: number): number => position[i] as number;
    sum += 0.5 * ((at(b) - at(a)) * (at(c + 1) - at(a + 1)) - (at(b + 1) - at(a + 1)) * (at(c) - at(a)));
  }
  return sum;
}

test("a square keeps about its area and its side with a tenth of the triangles", () => {
  const position = square(40);
  const coarse = simplify({ position }, 0.1, [[0, position.length / 3]]);
  assert.ok(coarse.index.length / 3 < 320, `${coarse.index.length / 3} triangles`);
  assert.ok(Math.abs(area(coarse.position, coarse.index) - 1) < 0.15, String(area(coarse.position, coarse.index)));
});

test("corners come from within their cells", () => {
  const position = square(13);
  const { position: mean } = simplify({ position }, 0.25, [[0, position.length / 3]]);
  for (const value of mean) assert.ok(value >= 0 && value <= 1);
});

test("groups of triangles stay apart and cover all that is kept", () => {
  const position = square(10);
  const half = position.length / 6;
  const { ranges, index } = simplify({ position }, 0.2, [[0, half], [half, half]]);
  assert.equal(ranges[0]?.[0], 0);
  assert.equal(ranges[1]?.[0], ranges[0]?.[1]);
  assert.equal((ranges[0]?.[1] as number) + (ranges[1]?.[1] as number), index.length);
  assert.ok(ranges.every(([, count]) => count > 0));
});

test("each corner keeps a place in the picture that is painted on", () => {
  const position = square(4);
  const uv = Float32Array.from({ length: (position.length / 3) * 2 }, (_, i) => position[3 * Math.floor(i / 2) + (i % 2)] as number);
  const coarse = simplify({ position, uv }, 1e-3, [[0, position.length / 3]]);
  assert.equal(coarse.uv?.length, (2 * coarse.position.length) / 3);
  for (let i = 0; i < coarse.position.length / 3; ++i) assert.equal(coarse.uv?.[2 * i], coarse.position[3 * i]);
});

test("a thin tube stays one, however coarse", () => {
  const tube = new THREE.Mesh(new THREE.CylinderGeometry(0.02, 0.02, 1, 48, 40).toNonIndexed());
  const sizeOf = (): number[] => new THREE.Box3().setFromObject(tube).getSize(new THREE.Vector3()).toArray();
  const [before, triangles] = [sizeOf(), tube.geometry.getAttribute("position").count / 3];
  coarsen(tube, 1 / 10);
  assert.ok((tube.geometry.index?.count ?? Infinity) / 3 < triangles / 2);
  sizeOf().forEach((size, i) => assert.ok(size > 0.6 * (before[i] as number), String(size)));
});
