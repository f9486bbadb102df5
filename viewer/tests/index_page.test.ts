import assert from "node:assert/strict";
import { test } from "node:test";
import page from "../src/index.html";

test("what counts seconds is not read out by itself: a message says it once", () => {
  const isLive = (id: string): boolean => /role="(status|alert|log)"|aria-live/.test(new RegExp(`<[^>]*id="${id}"[^>]*>`).exec(page)?.[0] ?? 'role="status"');
  assert.deepEqual(["link-state", "stale", "head-facts", "notes", "mode"].map(isLive), [false, false, false, true, true]);
});
