import assert from "node:assert/strict";
import { test } from "node:test";
import { watchContext } from "../src/scene/context.ts";

test("a picture whose graphics card was taken away is drawn again once it is back", () => {
  const canvas = new EventTarget();
  const did: string[] = [];
  watchContext(canvas, () => did.push("told"), () => did.push("drawn"));
  for (const name of ["webglcontextlost", "webglcontextrestored"]) canvas.dispatchEvent(new Event(name));
  assert.deepEqual(did, ["told", "drawn"]);
});
