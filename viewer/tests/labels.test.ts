import assert from "node:assert/strict";
import { test } from "node:test";
import { spread, type Wanted } from "../src/overlays/label_layout.ts";
import { randomNumbers } from "./make.ts";

const label = (x: number, y: number, rank = 1): Wanted => ({ x, y, width: 50, height: 16, rank });

test("a text that has room stands over its point", () => {
  assert.deepEqual(spread([label(100, 100), label(300, 100)]), [[100, 100 - 0.7 * 16], [300, 100 - 0.7 * 16]]);
});

test("no text covers another, wherever their points are, and those that are shown stand near them", () => {
  const random = randomNumbers(7);
  for (let round = 0; round < 200; ++round) {
    const wanted = Array.from({ length: 1 + Math.floor(12 * random()) }, () => label(200 * random(), 90 * random(), Math.floor(3 * random())));
    const places = spread(wanted);
    places.forEach((place, k) => {
      if (place === undefined) return;
      const { x, y } = wanted[k] as Wanted;
      assert.ok(Math.abs(place[0] - x) <= 1.2 * 50 && Math.abs(place[1] - y) <= 3 * 16);
      for (const other of places.slice(k + 1)) if (other !== undefined) assert.ok(Math.abs(place[0] - other[0]) >= 50 || Math.abs(place[1] - other[1]) >= 16);
    });
  }
});

test("two texts at the same point are both shown; where there is no room the more important one is", () => {
  assert.ok(spread([label(100, 100), label(100, 100)]).every((place) => place !== undefined));
  const crowd = [...Array.from({ length: 40 }, () => label(100, 100, 2)), label(100, 100, 0)];
  const places = spread(crowd);
  assert.ok(places.includes(undefined));
  assert.deepEqual(places.at(-1), [100, 100 - 0.7 * 16]);
});
