import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { capitalised } from "../src/data/log_words.ts";
import { Notes } from "../src/panels/notes.ts";
import { fakePage } from "./fake_page.ts";

/** What is seen of messages that are said one after the other. */
function seenOf(said: [text: string, kind: "error" | "plain"][]): (string | undefined)[] {
  mock.timers.enable({ apis: ["setTimeout"] });
  const { part } = fakePage();
  const notes = new Notes();
  for (const [text, kind] of said) notes.say(text, kind);
  mock.timers.reset();
  return part("notes").children.map(({ children }) => children[0]?.textContent);
}

test("messages of what is usual don't push those of errors out", () => {
  const plain = ["a", "b", "c", "d", "e", "f"].map((text): [string, "plain"] => [text, "plain"]);
  assert.deepEqual(seenOf([["wrong", "error"], ...plain]), ["wrong", "c", "d", "e", "f"]);
  const errors = ["1", "2", "3", "4", "5", "6"].map((text): [string, "error"] => [text, "error"]);
  assert.deepEqual(seenOf([["a", "plain"], ...errors]), ["2", "3", "4", "5", "6"]);
});

test("words of the program begin as those of the page, names of files stay", () => {
  assert.deepEqual(["friction is 9; valid is 0.05 to 2", "The run ends.", "run.mcap is read", "9 N"].map(capitalised), ["Friction is 9; valid is 0.05 to 2", "The run ends.", "run.mcap is read", "9 N"]);
});
