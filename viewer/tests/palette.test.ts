import assert from "node:assert/strict";
import { test } from "node:test";
import { paletteOf } from "../src/scene/palette.ts";

function luminance(colour: number): number {
  const [r, g, b] = [16, 8, 0].map((shift) => (((colour >> shift) & 255) / 255) ** 2.2) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

test("margins have no leg's colour, and the less is left the further they are from the ground's brightness", () => {
  for (const dark of [false, true]) {
    const { legs, margin, background } = paletteOf(dark);
    const colours = [margin.good, margin.near, margin.bad];
    for (const colour of colours) assert.ok(!legs.includes(colour));
    const contrast = colours.map((colour) => Math.abs(luminance(colour) - luminance(background)));
    assert.deepEqual(contrast, contrast.toSorted((a, b) => a - b));
  }
});
