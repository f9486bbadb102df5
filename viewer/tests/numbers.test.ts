import assert from "node:assert/strict";
import { test } from "node:test";
import { counted, digits, fixed, quantity, seen } from "../src/data/numbers.ts";

test("numbers stand in plain decimals with the digits that count", () => {
  assert.deepEqual([0, 0.0123, 1.2345, -45.67, 123.4, 3.8e-4, 9.96e-4, -5.04e-6, 123456, NaN].map(digits), ["0", "0.012", "1.23", "−45.7", "123", "0.00038", "0.0010", "−0.0000050", "123456", "–"]);
  assert.deepEqual([1e-7, -2.5e12].map(digits), ["1.0·10⁻⁷", "−2.5·10¹²"]);
});

test("what is rounded to nothing has no sign", () => {
  assert.deepEqual([-0.0004, -0, 0.0004, -0.0006, -10.2].map((value) => fixed(value, 3)), ["0.000", "0.000", "0.000", "−0.001", "−10.200"]);
  assert.deepEqual([-0.4, -3].map((value) => fixed(value, 0)), ["0", "−3"]);
});

test("a quantity of nothing has its unit as well", () => {
  assert.equal(quantity(0, "m/s²"), "0 m/s²");
  assert.equal(quantity(2, ""), "2.00");
});

test("one is not many", () => {
  assert.deepEqual([0, 1, 2].map((count) => counted(count, "row")), ["0 rows", "1 row", "2 rows"]);
});

test("of lengths, angles and forces less than a millionth is nothing, of other numbers it may be something", () => {
  for (const unit of ["m", "m/s", "rad/s²", "N", "N·m", "N and N·m"]) assert.deepEqual([1.7e-7, -9e-7, 2e-6].map((value) => seen(value, unit)), [0, 0, 2e-6], unit);
  for (const unit of ["", "ms", "mm", "1/s", "µs"]) assert.deepEqual([1.7e-7, 1e-10].map((value) => seen(value, unit)), [1.7e-7, 0], unit);
});
