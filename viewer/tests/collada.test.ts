import assert from "node:assert/strict";
import { test } from "node:test";
import { shortened } from "../src/scene/collada.ts";
import { numbersOf } from "../src/scene/number_list.ts";
import { randomNumbers } from "./make.ts";

test("numbers are read to the last bit as parseFloat reads them, however they are written", () => {
  const random = randomNumbers(3);
  const written = Array.from({ length: 20_000 }, (_, k) => {
    const value = (random() - 0.5) * 10 ** Math.floor(12 * random() - 6);
    return [value.toFixed(k % 12), value.toPrecision(1 + (k % 17)), String(value), value.toExponential(k % 9), String(Math.floor(1e6 * random()))][k % 5] as string;
  });
  written.push("-0", "0.0", ".5", "-.25", "7.", "1e-7", "123456789012345678901234567890", "+3");
  const spaces = [" ", "\n", "\t  ", "\r\n"];
  const text = `\n ${written.map((one, k) => one + spaces[k % 4]).join("")}`;
  const read = numbersOf(text);
  assert.equal(read.length, written.length);
  read.forEach((value, k) => assert.ok(Object.is(value, parseFloat(written[k] as string)), written[k]));
  assert.deepEqual(numbersOf(" \n"), []);
});

test("a document is shortened by its lists of numbers and by nothing else", () => {
  const text = '<param name="X"/><float_array id="a" count="3">1 2 3</float_array><float_array id="b" count="0"/><phong/><vcount>3 3</vcount><p>0 1 2\n</p><p></p><input set="0"/>5<';
  const { short, lists } = shortened(text);
  assert.deepEqual(lists, ["1 2 3", "3 3", "0 1 2\n", ""]);
  assert.equal(short, '<param name="X"/><float_array id="a" count="3">0</float_array><float_array id="b" count="0"/><phong/><vcount>1</vcount><p>2</p><p>3</p><input set="0"/>5<');
});
