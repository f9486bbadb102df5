import assert from "node:assert/strict";
import { test } from "node:test";
import { followToken, tokenOf } from "../src/protocol/token.ts";

test("the token stands in the link's fragment", () => {
  assert.deepEqual(["#token=abc", "", "#", "#other=1", "#x=1&token=abc"].map(tokenOf), ["abc", "", "", "", "abc"]);
});

test("a link with another token that is opened in the same tab takes effect", () => {
  let loads = 0;
  const location = { hash: "#token=old", reload: () => void ++loads };
  const page = Object.assign(new EventTarget(), { location });
  followToken(page as unknown as Parameters<typeof followToken>[0]);
  page.dispatchEvent(new Event("hashchange"));
  assert.equal(loads, 0);
  location.hash = "#token=new";
  page.dispatchEvent(new Event("hashchange"));
  assert.equal(loads, 1);
});
