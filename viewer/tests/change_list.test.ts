import assert from "node:assert/strict";
import { test } from "node:test";
import { ChangeList } from "../src/panels/change_list.ts";
import { fakePage, type FakeElement } from "./fake_page.ts";

test("of many changes the latest stand there, and all where they are asked for", () => {
  fakePage();
  const isHidden = (one: FakeElement): boolean => (one as unknown as { hidden: boolean }).hidden;
  const changes = new ChangeList(200);
  const root = changes.root as unknown as FakeElement;
  const seen = (): (string | undefined)[] => (root.children[1] as FakeElement).children.filter((one) => !isHidden(one)).map(({ textContent }) => textContent.split(" s ")[1]);
  const button = root.children[2] as FakeElement;
  for (let k = 1; k <= 5; ++k) changes.hear({ time: k, text: `change ${k}` });
  assert.deepEqual([seen().length, isHidden(button)], [5, true]);
  changes.hear({ time: 6, text: "change 6" });
  assert.deepEqual(seen(), [6, 5, 4, 3, 2].map((k) => `change ${k}`));
  assert.deepEqual([isHidden(button), button.textContent], [false, "all 6"]);
  button.press();
  assert.deepEqual([seen().length, button.textContent, button.getAttribute("aria-expanded")], [6, "only the latest 5", "true"]);
  changes.hear({ time: 7, text: "change 7" });
  assert.equal(seen().length, 7, "until it is closed");
  button.press();
  assert.deepEqual(seen(), [7, 6, 5, 4, 3].map((k) => `change ${k}`));
});
