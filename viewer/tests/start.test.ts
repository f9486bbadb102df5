import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { startPage } from "../src/start.ts";

/** Starts a page whose program fails a few times; what was said, and how often a page was made. */
async function started(failures: number, make: () => void): Promise<{ said: string[]; made: number }> {
  mock.timers.enable({ apis: ["setTimeout"] });
  for (const name of ["warn", "error"] as const) mock.method(console, name, () => {});
  const said: string[] = [];
  let made = 0, left = failures;
  const read = async (): Promise<string> => {
    if (left-- > 0) throw new Error("the program does not answer");
    return "a run";
  };
  const notes = { keep: (_: string, text: string) => said.push(text), take: (key: string) => key === "start" && said.push("") };
  const show = (words: string): void => void (words === "page incomplete" && said.push("broken"));
  void startPage(read, () => (++made, make()), notes as unknown as Parameters<typeof startPage>[2], show);
  for (let k = 0; k < 10; ++k) {
    await new Promise((resolve) => setImmediate(resolve));
    mock.timers.tick(6000);
  }
  mock.reset();
  mock.timers.reset();
  return { said, made };
}

test("a run that can't be read is asked for again, and shown once it can", async () => {
  const { said, made } = await started(2, () => {});
  const failure = "The run can't be shown: the program does not answer. The page tries again by itself.";
  assert.deepEqual([said, made], [[failure, failure, ""], 1]);
});

test("a page that can't be made is not made again on top of what there is of it", async () => {
  const { said, made } = await started(0, () => {
    throw new Error("the page has no part \"tabs\"");
  });
  assert.deepEqual([made, said.slice(0, -1)], [1, ["", "broken"]]);
  assert.match(said.at(-1) as string, /^The page can't show this run: the page has no part "tabs"\. Load it again/);
});
