import assert from "node:assert/strict";
import { test } from "node:test";
import { Theme } from "../src/theme.ts";

test("a browser that is to keep nothing shows the page all the same, light or dark", () => {
  const dataset: Record<string, string> = {};
  const refuse = (): never => {
    throw new Error("access is denied");
  };
  const page = { documentElement: { dataset } }, system = Object.assign(new EventTarget(), { matches: true });
  for (const [name, value] of Object.entries({ document: page, matchMedia: () => system, localStorage: { getItem: refuse, setItem: refuse } }))
    Object.defineProperty(globalThis, name, { value, configurable: true });
  const theme = new Theme();
  assert.equal(dataset["theme"], "dark");
  theme.toggle();
  assert.equal(dataset["theme"], "light");
});
