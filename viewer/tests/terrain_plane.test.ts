import assert from "node:assert/strict";
import { test } from "node:test";
import { TerrainGeometry } from "../src/scene/terrain_geometry.ts";

test("an endless plane is small triangles where robots walk: what is drawn on it is not lost in it", () => {
  const plane = new TerrainGeometry([{ shape: "plane", position: [0, 0, 0], q_SG: [1, 0, 0, 0] } as never]);
  for (const place of [[0.5, 0.5], [-1.5, 3], [8, -3], [-13, 12], [500, 800]] as [number, number][]) {
    let found = 0;
    for (let i = 0; i < plane.indices.length; i += 3) {
      const corners = plane.indices.slice(i, i + 3).map((at) => plane.positions.slice(3 * at, 3 * at + 2));
      const low = [0, 1].map((axis) => Math.min(...corners.map((p) => p[axis] as number))) as [number, number];
      const high = [0, 1].map((axis) => Math.max(...corners.map((p) => p[axis] as number))) as [number, number];
      if (place[0] < low[0] || place[0] > high[0] || place[1] < low[1] || place[1] > high[1]) continue;
      ++found;
      if (Math.hypot(...place) < 20) assert.ok(Math.max(high[0] - low[0], high[1] - low[1]) <= 6, `at ${place}`);
    }
    assert.ok(found > 0, `ground at ${place}`);
  }
});
