import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { NoGraphics, Stage, withoutPictureText } from "../src/scene/stage.ts";

/** A canvas of a browser that draws nothing in three dimensions. */
const canvas = Object.assign(new EventTarget(), { getContext: () => null, style: {} });

test("that WebGL is missing is told from all else that keeps a picture from being made", () => {
  Object.defineProperty(globalThis, "document", { value: { createElement: () => canvas }, configurable: true });
  mock.method(console, "error", () => {});
  const make = (): Stage => new Stage(canvas as unknown as HTMLCanvasElement);
  assert.throws(make, (error) => error instanceof NoGraphics);
  mock.reset();
  assert.match(withoutPictureText(new Error("a joint mimics itself")), /: a joint mimics itself\. All else works\.$/);
});
