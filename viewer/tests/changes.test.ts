import assert from "node:assert/strict";
import { test } from "node:test";
import { Changes, folded, type Change } from "../src/data/changes.ts";

const at = (time: number, text = "push"): Change => ({ time, text });

function heard(...changes: Change[]): Changes {
  const all = new Changes(200);
  for (const change of changes) all.hear(change);
  return all;
}

/** What is known of these after the program was asked and told those. */
function recalled(known: Change[], told: Change[]): Change[] {
  const changes = heard(...known);
  changes.recall(told);
  return changes.all;
}

test("a page that comes late knows the changes from before it came, those that both know once", () => {
  assert.deepEqual(recalled([], [at(1), at(2)]), [at(1), at(2)]);
  assert.deepEqual(recalled([at(2), at(3)], [at(1), at(2)]), [at(1), at(2), at(3)]);
});

test("two pushes of a paused run are two", () => {
  assert.deepEqual(recalled([at(2)], [at(2), at(2)]), [at(2), at(2)]);
  assert.deepEqual(recalled([at(2), at(2)], [at(2)]), [at(2), at(2)]);
});

test("a change whose message comes behind the answer that has it is known once, and one that is told again after that twice", () => {
  const changes = heard(at(1));
  changes.recall([at(1), at(2), at(2)]);
  changes.hear(at(2));
  changes.hear(at(2));
  assert.deepEqual(changes.all, [at(1), at(2), at(2)]);
  changes.hear(at(2));
  changes.hear(at(1));
  assert.equal(changes.all.length, 5);
});

test("of a run before nothing is known, and of this one the latest", () => {
  const changes = new Changes(2);
  changes.recall([at(1)]);
  changes.clear();
  for (const time of [1, 2, 3]) changes.hear(at(time));
  assert.deepEqual(changes.all, [at(2), at(3)]);
  changes.clear();
  changes.recall([at(1), at(2)]);
  assert.deepEqual(changes.all, [at(1), at(2)]);
});

test("a walk that is steered by a key again and again is one change, told as it ended", () => {
  const steer = (time: number, speed: number): Change => at(time, `the operator commands: walk, velocity (${speed}, 0) m/s`);
  const all = [at(0), steer(1, 1), steer(1.5, 2), steer(2.4, 3), steer(3.5, 4), at(3.6), at(3.6), steer(3.7, 5)];
  assert.deepEqual(folded(all), [at(0), steer(2.4, 3), steer(3.5, 4), at(3.6), at(3.6), steer(3.7, 5)]);
});
