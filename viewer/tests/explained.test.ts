import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { NoAnswer } from "../src/protocol/ask.ts";
import { Explainer, readExplained, type ExplainAnswer } from "../src/data/explained.ts";

const schema = { levels: ["physics", "limb_extension_limits", "torso_height"] };

/** Of so many rows as cost something, all of which are worth telling. */
function answerOf(...costs: (number | null)[]): ExplainAnswer {
  return { costs_are_exact: true, gave_way: [{ level: "torso_height", told: costs.length, to: costs.map((cost, k) => ({ level: "limb_extension_limits", row: `row ${k}`, cost })) }] };
}

async function answered(): Promise<void> {
  for (let k = 0; k < 10; ++k) await Promise.resolve();
}

test("of what holds a level back the rows are told that the program says are worth it, and how many others there are", () => {
  const answer = answerOf(9, null, 0.5);
  answer.gave_way![0]!.told = 2;
  const level = readExplained(answer, schema)?.get("torso_height");
  assert.deepEqual([level?.rows.map(({ cost }) => cost), level?.others], [[9, NaN], 1]);
});

test("a row stands for others that say the same, and for its level by number", () => {
  const answer = answerOf(2);
  answer.gave_way![0]!.to[0]!.same = [{ level: "limb_extension_limits", row: "LH" }, { level: "physics", row: "z" }];
  assert.deepEqual(readExplained(answer, schema)?.get("torso_height")?.rows, [{ by: 1, row: "row 0 with LH with physics z", cost: 2 }]);
});

test("estimates, and a tick that can't be explained, are no explanation", () => {
  assert.equal(readExplained({ ...answerOf(1), costs_are_exact: false }, schema), undefined);
  assert.equal(readExplained({ problem: "no such file" } as ExplainAnswer, schema), undefined);
});

test("only a tick that is looked at for long is asked for, again until it is explained, and once", async (t) => {
  mock.timers.enable({ apis: ["setTimeout"] });
  t.after(() => mock.timers.reset());
  const asked: number[] = [];
  let answer: ExplainAnswer | undefined;
  let told = 0;
  const explainer = new Explainer(async (tick) => (asked.push(tick), answer), schema);
  explainer.onChange = () => ++told;
  const pass = async (ms: number): Promise<void> => {
    mock.timers.tick(ms);
    await answered();
  };
  for (const tick of [1, 2, 3]) {
    assert.equal(explainer.at(tick), undefined);
    await pass(100);
  }
  assert.deepEqual(asked, []);
  await pass(300);
  await pass(500);
  assert.deepEqual(asked, [3, 3]);
  assert.deepEqual([told, explainer.isComputing(3), explainer.isComputing(2)], [1, true, false]);
  answer = answerOf(4);
  await pass(500);
  assert.deepEqual([told, explainer.isComputing(3)], [2, false]);
  assert.equal(explainer.at(3)?.get("torso_height")?.rows[0]?.cost, 4);
  explainer.at(5);
  explainer.at(3);
  await pass(5000);
  assert.deepEqual(asked, [3, 3, 3], "what is known is not asked for again, nor what nobody looks at");
});

test("a tick that was left is not asked for again, one whose question was lost is, and one that is refused stays an estimate", async (t) => {
  mock.timers.enable({ apis: ["setTimeout"] });
  t.after(() => mock.timers.reset());
  const asked: number[] = [];
  let failure: Error | undefined;
  let answerLate: (answer?: ExplainAnswer) => void = () => {};
  const explainer = new Explainer((tick) => {
    asked.push(tick);
    return failure === undefined ? new Promise((resolve) => (answerLate = resolve)) : Promise.reject(failure);
  }, schema);
  const pass = async (ms: number): Promise<void> => {
    mock.timers.tick(ms);
    await answered();
  };
  explainer.at(1);
  await pass(300);
  explainer.at(2);
  answerLate();
  await answered();
  explainer.at(1);
  explainer.at(2);
  failure = new NoAnswer();
  await pass(2000);
  assert.deepEqual(asked, [1, 2], "of a tick that was left for another nobody waits for the answer");
  failure = new Error("a log of another version");
  await pass(400);
  assert.deepEqual([asked, explainer.isComputing(2)], [[1, 2, 2], false]);
  explainer.at(2);
  await pass(5000);
  assert.deepEqual(asked, [1, 2, 2]);
});
