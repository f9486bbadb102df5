import assert from "node:assert/strict";
import { test } from "node:test";
import { Announcer } from "../src/panels/announcer.ts";

/** What is said of texts that are told one after the other, each for 100 ms. */
function saidOf(texts: string[]): string[] {
  const said: string[] = [];
  const announcer = new Announcer((text) => said.push(text));
  texts.forEach((text, k) => announcer.update(text, 100 * k));
  return said;
}

test("levels that give way and hold by turns are not read out ten times a second", () => {
  const turns = Array.from({ length: 100 }, (_, k) => (k % 2 === 0 ? "all levels are met" : "com xy gives way"));
  assert.ok(saidOf(turns).length <= 4);
});

test("what came while something was read out is told behind it", () => {
  const texts = ["all levels are met", ...Array<string>(10).fill("com xy gives way"), ...Array<string>(30).fill("torso gives way")];
  assert.deepEqual(saidOf(texts), ["all levels are met", "torso gives way"]);
});
