import assert from "node:assert/strict";
import { test } from "node:test";
import { numberIn, takeNumber } from "../src/panels/number_field.ts";

test("an empty field, or one without a number, has no value", () => {
  assert.deepEqual(["", "  ", "-", "abc", "1e999"].map(numberIn), Array(5).fill(undefined));
  assert.deepEqual(["0", " 12.5 ", "-3e2"].map(numberIn), [0, 12.5, -300]);
});

test("a field without a number gets its old one back", () => {
  const field = { value: "" };
  assert.equal(takeNumber(field, 450), undefined);
  assert.equal(field.value, "450");
  field.value = "0";
  assert.equal(takeNumber(field, 450), 0);
  assert.equal(field.value, "0");
});
