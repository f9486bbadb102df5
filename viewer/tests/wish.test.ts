import assert from "node:assert/strict";
import { test } from "node:test";
import { moved } from "../src/panels/hierarchy_panel.ts";
import { Wish, WISH_LASTS } from "../src/data/wish.ts";

function wishAt(): { wish: Wish<number>; pass: (ms: number) => void } {
  let now = 0;
  return { wish: new Wish<number>(() => now), pass: (ms) => (now += ms) };
}

test("commands in a row build on what was asked for, not on what is still shown", () => {
  const { wish, pass } = wishAt();
  for (let k = 0; k < 3; ++k) {
    wish.ask(2 * wish.or(1));
    pass(200);
  }
  assert.equal(wish.or(1), 8);
});

test("a wish ends when it comes true, and what comes then counts", () => {
  const { wish } = wishAt();
  wish.ask(4);
  assert.equal(wish.or(1), 4);
  assert.equal(wish.or(4), 4);
  assert.equal(wish.or(2), 2);
});

test("a wish that does not come true ends after a while, or when it is refused", () => {
  const { wish, pass } = wishAt();
  wish.ask(4);
  pass(WISH_LASTS + 1);
  assert.equal(wish.or(1), 1);
  wish.ask(4);
  wish.drop();
  assert.equal(wish.or(1), 1);
});

test("a wish that a paused run can't grant stands", () => {
  const { wish, pass } = wishAt();
  wish.ask(4);
  pass(10 * WISH_LASTS);
  assert.equal(wish.or(1, true), 4);
  pass(WISH_LASTS - 1);
  assert.equal(wish.or(1), 4);
});

test("false is a wish as well", () => {
  const wish = new Wish<boolean>();
  wish.ask(false);
  assert.equal(wish.or(true), false);
});

test("a name moves within an order and not beyond its ends", () => {
  const names = ["a", "b", "c"];
  assert.deepEqual(moved(names, "c", -2), ["c", "a", "b"]);
  assert.deepEqual(moved(names, "a", 1), ["b", "a", "c"]);
  assert.equal(moved(names, "c", 1), undefined);
  assert.equal(moved(names, "x", 1), undefined);
  assert.deepEqual(names, ["a", "b", "c"]);
});
