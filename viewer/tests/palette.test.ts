import assert from "node:assert/strict";
import { test } from "node:test";
import { paletteOf } from "../src/scene/palette.ts";

type Colour = [number, number, number];

const linear = (colour: number): Colour =>
  [16, 8, 0].map((shift) => ((colour >> shift) & 255) / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)) as Colour;

function luminance(colour: number): number {
  const [r, g, b] = linear(colour);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/** What eyes without one kind of cone make of a colour (Machado 2009, severity 1). */
const EYES: Record<string, Colour[]> = {
  usual: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  "without red": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  "without green": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
};

const dot = (row: Colour, v: Colour): number => row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
const times = (rows: Colour[], v: Colour): Colour => rows.map((row) => dot(row, v)) as Colour;

/** Lightness and two axes of colour in which distances are as they are seen (Oklab). */
function seen(colour: number, eyes: Colour[]): Colour {
  const light = times(eyes, linear(colour)).map((v) => Math.min(Math.max(v, 0), 1)) as Colour;
  const cones = times([[0.4122, 0.5363, 0.0514], [0.2119, 0.6807, 0.1074], [0.0883, 0.2817, 0.63]], light).map(Math.cbrt) as Colour;
  return times([[0.2105, 0.7936, -0.0041], [1.978, -2.4286, 0.4506], [0.0259, 0.7828, -0.8087]], cones);
}

/** Two colours that lie nearer to each other are not told apart at a glance; those of Okabe and Ito lie 0.06 apart where they are nearest. */
const APART = 0.06;

test("legs and marks of the picture are told apart by any eyes", () => {
  for (const dark of [false, true]) {
    const { legs: [LF, RF, LM, RM, LH, RH], com, plan, zmp, support, plane, ghost, push } = paletteOf(dark);
    const colours = Object.entries({ LF, RF, LM, RM, LH, RH, com, plan, zmp, support, plane, ghost, push });
    for (const [name, eyes] of Object.entries(EYES)) {
      colours.forEach(([one, a], k) => {
        for (const [other, b] of colours.slice(k + 1)) {
          const [p, q] = [seen(a, eyes), seen(b, eyes)];
          const distance = Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
          assert.ok(distance > APART, `${one} and ${other}, ${name}, ${dark ? "dark" : "light"}: ${distance}`);
        }
      });
    }
  }
});

test("margins have no leg's colour, and the less is left the further they are from the ground's brightness", () => {
  for (const dark of [false, true]) {
    const { legs, margin, background } = paletteOf(dark);
    const colours = [margin.good, margin.near, margin.bad];
    for (const colour of colours) assert.ok(!legs.includes(colour));
    const contrast = colours.map((colour) => Math.abs(luminance(colour) - luminance(background)));
    assert.deepEqual(contrast, contrast.toSorted((a, b) => a - b));
  }
});

/** As WCAG has it. */
function contrast(a: number, b: number): number {
  const [dark, bright] = [luminance(a), luminance(b)].toSorted((p, q) => p - q) as [number, number];
  return (bright + 0.05) / (dark + 0.05);
}

test("marks of the legend stand out from their page, and the plan of the centre of mass from the ground", () => {
  for (const dark of [false, true]) {
    const { margin, plan, ground } = paletteOf(dark);
    for (const colour of Object.values(margin)) assert.ok(contrast(colour, dark ? 0x1c2024 : 0xffffff) >= 3, colour.toString(16));
    assert.ok(contrast(plan, ground) >= (dark ? 5 : 3), "a line is as thin as a pixel, and half of that where it passes between two");
  }
});

test("what is nearly used up is seen before the ground and before bodies, whatever their brightness and whatever eyes", () => {
  for (const dark of [false, true]) {
    const { margin, alarmEdge, background, ground } = paletteOf(dark);
    const apart = (a: number, b: number, eyes: Colour[]): number => Math.abs(seen(a, eyes)[0] - seen(b, eyes)[0]);
    for (const eyes of Object.values(EYES)) for (const behind of [background, ground, 0x000000, 0x5a5f66, 0xffffff])
      assert.ok(Math.max(apart(margin.bad, behind, eyes), apart(alarmEdge, behind, eyes)) > 0.3, `${behind.toString(16)}, ${dark ? "dark" : "light"}`);
  }
});
