import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import limbLimits from "../../surefoot/tasks/limb_extension_limits.cpp";
import type { Frame } from "../src/data/frame.ts";
import { brakeOf, LIMB_ROW, limbText } from "../src/overlays/feet.ts";
import { boxOf, reachOf } from "../src/overlays/labels.ts";
import { leaderOf, spread, type Wanted } from "../src/overlays/label_layout.ts";
import { randomNumbers, schemaOf } from "./make.ts";

const BUTTONS = [{ left: 0, right: 120, top: 0, bottom: 48 }];
const label = (x: number, y: number, rank = 1): Wanted => ({ x, y, width: 50, height: 16, rank });

test("a text that has room stands over its point", () => {
  assert.deepEqual(spread([label(100, 100), label(300, 100)], 400, 200, BUTTONS), [[100, 100 - 0.7 * 16], [300, 100 - 0.7 * 16]]);
});

test("no text covers another, wherever their points are, and those that are shown stand near them", () => {
  const random = randomNumbers(7);
  for (let round = 0; round < 200; ++round) {
    const wanted = Array.from({ length: 1 + Math.floor(12 * random()) }, () => label(200 * random(), 160 * random(), Math.floor(3 * random())));
    const places = spread(wanted, 220, 200, BUTTONS);
    places.forEach((place, k) => {
      if (place === undefined) return;
      const { x, y } = wanted[k] as Wanted;
      const top = place[0] - 25 < 120 ? 48 : 0;
      assert.ok(place[0] >= 25 && place[0] <= 220 - 25 && place[1] >= top + 8 && place[1] <= 200 - 8, "all of it is in the picture, off the buttons");
      assert.ok(Math.abs(place[0] - x) <= 1.2 * 50 && Math.abs(place[1] - Math.max(y, top)) <= 3 * 16);
      for (const other of places.slice(k + 1)) if (other !== undefined) assert.ok(Math.abs(place[0] - other[0]) >= 50 || Math.abs(place[1] - other[1]) >= 16);
    });
  }
});

test("a text that stands away from its point has a line to it, from its edge", () => {
  assert.equal(leaderOf(label(100, 100), [100, 100 - 0.7 * 16]), undefined, "where it has room");
  assert.equal(leaderOf(label(100, 100), [100, 100 + 1.2 * 16]), undefined, "beside it");
  const right = leaderOf(label(200, 100), [100, 100]), down = leaderOf(label(100, 160), [100, 100]);
  assert.deepEqual(right, { x: 25, y: 0, length: 75, angle: 0 });
  assert.deepEqual([down?.x, down?.y, down?.length, down?.angle], [0, 8, 52, Math.PI / 2]);
  const random = randomNumbers(3);
  for (let round = 0; round < 100; ++round) {
    const [x, y] = [400 * random(), 300 * random()], leader = leaderOf(label(x, y), [200, 150]);
    if (leader === undefined) continue;
    assert.ok(Math.abs(200 + leader.x + leader.length * Math.cos(leader.angle) - x) < 1e-9 && Math.abs(150 + leader.y + leader.length * Math.sin(leader.angle) - y) < 1e-9);
    assert.ok(Math.abs(Math.abs(leader.x) - 25) < 1e-9 || Math.abs(Math.abs(leader.y) - 8) < 1e-9, "the edge");
  }
});

test("a text that stands under its point goes over it only where it has no room there", () => {
  const under = { ...label(100, 100), under: true }, [place] = spread([under], 400, 200, []) as [[number, number]];
  assert.deepEqual(place, [100, 100 + 0.7 * 16]);
  assert.equal(leaderOf(under, place), undefined);
  const two = spread([under, under], 400, 200, []) as [number, number][];
  assert.deepEqual(two.map(([x]) => x), [100, 100]);
  assert.ok((two[1] as [number, number])[1] >= (two[0] as [number, number])[1] + 16, "in lines");
  const mark = { left: 0, right: 400, top: 101, bottom: 200 };
  const [over] = spread([under], 400, 200, [], [mark]) as [[number, number]];
  assert.ok(over[1] + 8 <= 101);
});

test("a text has the upper edge for it where no button is, and none where there is no room for it", () => {
  assert.deepEqual(spread([label(300, 10), label(60, 10)], 400, 200, BUTTONS), [[300, 8], [60, 56]]);
  assert.deepEqual([...spread([label(60, 30), label(300, 30)], 400, 50, BUTTONS)], [undefined, [300, 30 - 0.7 * 16]]);
  assert.deepEqual([...spread([label(20, 100)], 40, 200, BUTTONS)], [undefined]);
});

test("a text stands beside what is to be seen itself, and over it only where there is no other place", () => {
  const mark = { left: 80, right: 120, top: 80, bottom: 100 };
  const [place] = spread([label(100, 100)], 400, 200, [], [mark]) as [[number, number]];
  assert.ok(place[0] + 25 <= mark.left || place[0] - 25 >= mark.right || place[1] + 8 <= mark.top || place[1] - 8 >= mark.bottom);
  const all = { left: 0, right: 400, top: 0, bottom: 200 };
  assert.deepEqual(spread([label(100, 100)], 400, 200, [], [all]), [[100, 100 - 0.7 * 16]]);
});

test("no text is under a message, wherever in the upper edge it stands", () => {
  const message = { left: 250, right: 400, top: 0, bottom: 60 };
  assert.deepEqual(spread([label(300, 40), label(180, 40)], 400, 200, [...BUTTONS, message]), [[300, 68], [180, 40 - 0.7 * 16]]);
});

test("two texts at the same point are both shown; where there is no room the more important one is", () => {
  assert.ok(spread([label(100, 100), label(100, 100)], 400, 200, BUTTONS).every((place) => place !== undefined));
  const crowd = [...Array.from({ length: 40 }, () => label(100, 100, 2)), label(100, 100, 0)];
  const places = spread(crowd, 400, 200, BUTTONS);
  assert.ok(places.includes(undefined));
  assert.deepEqual(places.at(-1), [100, 100 - 0.7 * 16]);
});

test("beside a leg stand its name, its length, and what is left of its limits", () => {
  assert.equal(limbText("LF", 0.4213, 0.053), "LF 42.1 cm, 5.3 cm left");
  assert.equal(limbText("RH", 0.48, -0.0061), "RH 48.0 cm, 0.6 cm beyond");
  for (const room of [-0.0001, 0, 0.0004]) assert.equal(limbText("RH", 0.48, room), "RH 48.0 cm, at limit");
  assert.equal(limbText("RH", 0.48, -0.0006), "RH 48.0 cm, 0.1 cm beyond");
  assert.equal(limbText("LF", 0.4213, 0.008, "braked"), "LF 42.1 cm, 0.8 cm left, braked", "the limit acts before it is reached");
  assert.equal(limbText("LF", 0.48, 0.0001, "braked"), "LF 48.0 cm, at limit");
  assert.equal(limbText("RH", 0.48, Infinity), "RH 48.0 cm", "without limits");
});

test("a leg whose limit is violated is not called braked", () => {
  const schema = schemaOf({}, { rows: [["LF extension"], ["LF extension", "RF extension"]] });
  const brake = (...states: number[]): string => brakeOf({ schema, active: states.map((state, row) => ({ level: 1, state, row })) } as unknown as Frame, "LF", 1);
  assert.deepEqual([[], [1], [-1], [3], [-3], [-1, 3]].map((states) => brake(...states)), ["", "braked", "braked", "not braked enough", "not braked enough", "braked"]);
  assert.equal(brakeOf({ schema, active: [{ level: 0, state: 1, row: 0 }] } as unknown as Frame, "LF", 1), "", "of another level");
  assert.equal(limbText("LF", 0.4213, 0.008, "not braked enough"), "LF 42.1 cm, 0.8 cm left, not braked enough");
});

test("rows of the legs' limits are called as the controller calls them", () => {
  assert.ok(limbLimits.includes(`+ "${LIMB_ROW}";`));
});

test("what is spared of a picture is what lies before the camera", () => {
  const camera = new THREE.PerspectiveCamera(90, 1, 0.1, 10); // looks along −z
  camera.updateMatrixWorld();
  const [left, right, behind] = [new THREE.Vector3(-0.5, 0, -1), new THREE.Vector3(0.5, 0.5, -1), new THREE.Vector3(9, 9, 1)];
  for (const points of [[left, right], [left, right, behind], [behind, left, right]]) {
    const box = boxOf(points, camera, 200, 100);
    assert.deepEqual(Object.entries(box ?? {}).map(([side, at]) => [side, Math.round(at)]), [["left", 50], ["right", 150], ["top", 25], ["bottom", 50]]);
  }
  assert.equal(boxOf([behind], camera, 200, 100), undefined);
});

test("only numbers of forces stand at the picture's edge for what is beyond it", () => {
  const reaches = { push: 2, leg0: 2, com: 1, believed: 1, "limb leg0": 1, "use leg1 bad": 1 };
  for (const [className, reach] of Object.entries(reaches)) assert.equal(reachOf(className), reach, className);
});
