import assert from "node:assert/strict";
import { test } from "node:test";
import { Tabs } from "../src/panels/tabs.ts";
import { type FakeElement, fakePage } from "./fake_page.ts";

/** Three tabs, and which of them is shown, has the focus, and is reached by the tab key. */
function tabsOf(): { tabs: FakeElement[]; seen: () => (string | undefined)[] } {
  const { part } = fakePage();
  const made = new Tabs();
  const panels = ["hierarchy", "state", "drive"].map((id) => made.add(id, id) as unknown as FakeElement);
  const tabs = part("tabs").children;
  const nameOf = (test: (tab: FakeElement, k: number) => boolean): string | undefined => tabs.filter(test).map(({ textContent }) => textContent).join() || undefined;
  const seen = () => [
    nameOf((_, k) => !(panels[k] as unknown as HTMLElement).hidden), nameOf((tab) => (tab as unknown) === document.activeElement),
    nameOf((tab) => tab.getAttribute("tabindex") === "0"),
  ];
  return { tabs, seen };
}

test("arrows go from tab to tab and around, and the tab key to the one that is shown", () => {
  const { tabs, seen } = tabsOf();
  assert.deepEqual(seen(), ["hierarchy", undefined, "hierarchy"]);
  const press = (key: string): (string | undefined)[] => {
    (document.activeElement as unknown as FakeElement).strike(key);
    return seen();
  };
  tabs[0]?.focus();
  assert.deepEqual(press("ArrowRight"), ["state", "state", "state"]);
  assert.deepEqual(press("End"), ["drive", "drive", "drive"]);
  assert.deepEqual(press("ArrowRight"), ["hierarchy", "hierarchy", "hierarchy"]);
  assert.deepEqual(press("ArrowLeft"), ["drive", "drive", "drive"]);
  assert.deepEqual(press("Home"), ["hierarchy", "hierarchy", "hierarchy"]);
  assert.deepEqual(press("x"), ["hierarchy", "hierarchy", "hierarchy"], "which is the page's");
  tabs[1]?.press();
  assert.equal(seen()[0], "state");
});
