import assert from "node:assert/strict";
import { test } from "node:test";
import page from "../src/index.html";

test("what counts seconds is not read out by itself: a message says it once", () => {
  const isLive = (id: string): boolean => /role="(status|alert|log)"|aria-live/.test(new RegExp(`<[^>]*id="${id}"[^>]*>`).exec(page)?.[0] ?? 'role="status"');
  assert.deepEqual(["link-state", "stale", "head-facts", "notes", "mode"].map(isLive), [false, false, false, true, true]);
});

test("all that is a place of its own in the page has a name for those who hear it", () => {
  const places = page.match(/<(section|dialog|canvas)\b[^>]*>/g) ?? [];
  assert.ok(places.length > 3);
  assert.deepEqual(places.filter((tag) => !tag.includes("aria-label=")), []);
});
