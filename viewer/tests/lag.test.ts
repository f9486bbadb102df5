import assert from "node:assert/strict";
import { test } from "node:test";
import { paceText, PictureAge } from "../src/data/lag.ts";

const status = (more = {}) => ({ clock: 0, time: 0, paused: false, ended: null, speed: 1, real_factor: 1, ...more });

test("a run that can't go as fast as was asked for says so", () => {
  assert.equal(paceText(status()), "1× real time");
  assert.equal(paceText(status({ real_factor: 0.42 })), "0.42× of 1× asked: the program's machine is busy");
  assert.equal(paceText(status({ speed: 8, real_factor: 3.04 })), "3× of 8× asked: the program's machine is busy");
  assert.equal(paceText(status({ speed: 0.25, real_factor: 0.25 })), "1/4× real time");
  assert.equal(paceText(status({ real_factor: 4.71 })), "4.7× real time", "of a calibration that nobody looks at");
});

test("of a speed that was asked for just now nothing is known yet, and of a run that stands nothing is said", () => {
  assert.equal(paceText(status({ speed: 8, real_factor: 0 })), "8× real time");
  assert.equal(paceText(status({ real_factor: 0.1, paused: true })), "");
  assert.equal(paceText(status({ real_factor: 0.1, ended: "fell" })), "");
});

test("a picture is as old as the clock says, whatever both clocks begin at and however fast the run is", () => {
  for (const rate of [0.25, 1, 4]) {
    const age = new PictureAge();
    age.hear(status({ clock: 50, time: 7, speed: rate, real_factor: rate }), 1000.01);
    age.hear(status({ clock: 51, time: 7 + rate, speed: rate, real_factor: rate }), 1001);
    const made = 7 + 0.8 * rate; // 0.8 s after the first of these
    assert.ok(Math.abs(age.of(made, 1001.3) - 0.5) < 1e-9);
    assert.ok(Math.abs(age.of(7 + 1.2 * rate, 1001.3) - 0.1) < 1e-9);
  }
});

test("what comes ever later makes the picture old, and is told once it is more than a few tenths of a second", () => {
  const age = new PictureAge();
  let said = "";
  for (let k = 0; k < 100; ++k) {
    const clock = 0.1 * k;
    const late = 0.02 * k; // the page is ever further behind
    age.hear(status({ clock, time: clock }), 30 + clock + late);
    said = age.text(clock, 30 + clock + late);
    if (late < 0.3) assert.equal(said, "");
  }
  assert.match(said, /^the picture is 1\.[89] s old$/);
});

test("a picture is young again after the program's machine slept, and one that came late through a pause of the network is not", () => {
  for (const [slept, late] of [[600, 0], [0, 2]] as const) {
    const age = new PictureAge();
    let said = "";
    for (let k = 0; k < 200; ++k) {
      const clock = 0.1 * k + (k >= 50 ? 10 : 0); // nothing comes for ten seconds
      const now = 30 + clock + (k >= 50 ? slept : 0);
      age.hear(status({ clock, time: clock }), now + (k >= 100 ? late : 0));
      said = age.text(clock, now + (k >= 100 ? late : 0));
    }
    assert.equal(said, late === 0 ? "" : "the picture is 2.0 s old");
  }
});

test("a picture of a run that stands does not age, nor one of another program", () => {
  const age = new PictureAge();
  assert.equal(age.of(3, 100), 0);
  age.hear(status({ clock: 5, time: 3, paused: true }), 100);
  assert.equal(age.of(3, 160), 0);
  age.forget();
  age.hear(status({ clock: 1, time: 3 }), 200);
  assert.equal(age.of(3, 200), 0);
});

test("of a run whose speed is not measured yet no picture has an age, and none is left over once it is", () => {
  const age = new PictureAge();
  for (let k = 0; k < 10; ++k) {
    age.hear(status({ clock: 0.1 * k, time: 0.07 + 0.1 * k, real_factor: 0 }), 20 + 0.1 * k);
    assert.equal(age.of(0, 20 + 0.1 * k), 0);
    assert.equal(age.text(0, 20 + 0.1 * k), "");
  }
  age.hear(status({ clock: 1, time: 1.07 }), 21);
  assert.equal(age.text(1.07, 21), "");
});
