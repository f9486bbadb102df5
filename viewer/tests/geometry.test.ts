import assert from "node:assert/strict";
import { test } from "node:test";
import { centreOfPressure, convexHull, distanceOutside, planeHeight, rotate, wrap, yawOf, type Point } from "../src/math/geometry.ts";
import { TerrainGeometry } from "../src/scene/terrain_geometry.ts";
import { randomNumbers } from "./make.ts";

const close = (a: number, b: number): void => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);
const piece = { position: [0, 0, 0], q_SG: [1, 0, 0, 0], size: [0, 0, 0], columns: 0, rows: 0, heights: [] };

test("every point lies inside the hull, whose corners are some of the points", () => {
  const random = randomNumbers(5);
  for (let run = 0; run < 100; ++run) {
    const points: Point[] = Array.from({ length: 3 + Math.floor(random() * 6) }, () => [random(), random()]);
    const hull = convexHull(points);
    hull.forEach((a, k) => {
      const b = hull[(k + 1) % hull.length] as Point;
      assert.ok(points.includes(a));
      for (const p of points) assert.ok((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > -1e-12);
    });
  }
});

test("the hull of fewer than three points is the points", () => {
  assert.equal(convexHull([]).length, 0);
  assert.equal(convexHull([[0, 0], [1, 0]]).length, 2);
});

test("the heading of a turn about z is its angle, and angles are wrapped", () => {
  for (const angle of [-3, -1, 0, 0.3, 3]) close(yawOf([Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)]), angle);
  close(wrap(3 * Math.PI), Math.PI);
  close(wrap(-0.1), -0.1);
  close(wrap(2 * Math.PI - 0.1), -0.1);
});

test("a plane's height follows its normal", () => {
  const normal = [-0.6, 0, 0.8];
  close(planeHeight([1, 0, 2], normal, 1, 7), 2);
  close(planeHeight([1, 0, 2], normal, 2, 0), 2.75);
});

test("the centre of pressure lies between the feet as they carry", () => {
  assert.deepEqual(centreOfPressure([[0, 0, 0], [1, 0, 0]], [[0, 0, 30], [0, 0, 10]]), [0.25, 0, 0]);
  assert.equal(centreOfPressure([[0, 0, 0]], [[0, 0, 0]]), undefined);
});

test("each triangle of a turned box looks outward, and its corners are the box's", () => {
  const q = [0.5, 0.5, -0.5, 0.5];
  const box = { ...piece, shape: "box", position: [1, 2, 3], q_SG: q, size: [2, 4, 6] };
  const { positions, normals, indices } = new TerrainGeometry([box]);
  const vertex = (list: number[], i: number): number[] => list.slice(3 * i, 3 * i + 3);
  assert.equal(indices.length, 36);
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => vertex(positions, indices[t + k] as number)) as [number[], number[], number[]];
    const u = b.map((x, i) => x - (a[i] as number));
    const v = c.map((x, i) => x - (a[i] as number));
    const n = vertex(normals, indices[t] as number);
    const area = [1, 2, 0].map((i) => (u[i] as number) * (v[(i + 1) % 3] as number) - (u[(i + 1) % 3] as number) * (v[i] as number)) as number[];
    const out = area.reduce((sum, x, i) => sum + x * (n[i] as number), 0);
    assert.ok(out > 0, "turned inward");
    const local = rotate([0.5, -0.5, 0.5, -0.5], a.map((x, i) => x - ([1, 2, 3][i] as number))).map(Math.abs);
    local.forEach((x, i) => close(x, [1, 2, 3][i] as number));
  }
});

test("a height grid has its points where the log says, row by row along y", () => {
  const grid = { ...piece, shape: "heights", position: [10, 20, 1], size: [4, 2, 0], columns: 3, rows: 2, heights: [0, 1, 2, 3, 4, 5] };
  const { positions, indices } = new TerrainGeometry([grid]);
  assert.deepEqual(positions.slice(0, 3), [8, 19, 1]);
  assert.deepEqual(positions.slice(6, 9), [12, 19, 3]);
  assert.deepEqual(positions.slice(15, 18), [12, 21, 6]);
  assert.equal(indices.length, 12);
});

test("the distance outside of a hull is that to its nearest point, of any number of corners", () => {
  const random = randomNumbers(7);
  for (let run = 0; run < 300; ++run) {
    const hull = convexHull<Point>(Array.from({ length: 1 + Math.floor(random() * 5) }, () => [random(), random()]));
    const p: Point = [3 * random() - 1, 3 * random() - 1];
    let nearest = Infinity; // among points that a fine net of mixtures of the corners gives
    for (let k = 0; k < 1000; ++k) {
      const shares = hull.map(() => random() ** 6);
      const total = shares.reduce((sum, share) => sum + share, 0);
      const q = [0, 1].map((i) => hull.reduce((sum, corner, c) => sum + ((shares[c] as number) / total) * (corner[i] as number), 0)) as Point;
      nearest = Math.min(nearest, Math.hypot(p[0] - q[0], p[1] - q[1]));
    }
    const told = distanceOutside(hull, p);
    assert.ok(told <= nearest + 1e-12 && told > nearest - 0.1, `${told}, ${nearest}`);
  }
  assert.equal(distanceOutside([[0, 0], [1, 0], [0, 1]], [0.2, 0.2]), 0);
  assert.equal(distanceOutside([[0, 0], [1, 0], [0, 1]], [0.5, -0.25]), 0.25);
  assert.equal(distanceOutside([], [0, 0]), Infinity);
});
