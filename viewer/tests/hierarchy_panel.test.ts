import assert from "node:assert/strict";
import { test } from "node:test";
import { FrameTable } from "../src/data/table.ts";
import type { Frame } from "../src/data/frame.ts";
import { HierarchyPanel } from "../src/panels/hierarchy_panel.ts";
import { FakeElement, fakePage } from "./fake_page.ts";
import { schemaOf } from "./make.ts";

const LEVELS = ["first", "second", "third"];

function frameOf(levels: string[]): Frame {
  const header = { robot: { mass: 30 }, level_names: LEVELS, level_units: ["N", "m", "m"], event_names: [] };
  const schema = schemaOf(Object.fromEntries(LEVELS.map((level) => [`hierarchy.level.${level}.num_rows`, 1])), { header, orders: [{ tick: 0, levels }] } as unknown as Parameters<typeof schemaOf>[1]);
  const table = new FrameTable(schema, 1);
  table.append(0, 0, Float32Array.from(LEVELS, () => 2), undefined);
  return table.frame(0);
}

/** A panel of a run whose levels can be moved, and what was asked of the run. */
function panelOf(): { panel: HierarchyPanel; root: FakeElement; asked: string[]; button: (label: string) => FakeElement } {
  const { root } = fakePage();
  const panel = new HierarchyPanel(root as unknown as HTMLElement);
  const asked: string[] = [];
  panel.onOrder = (levels) => asked.push(levels.join(" "));
  panel.canReorder = true;
  panel.newest = LEVELS;
  panel.show(frameOf(LEVELS));
  return { panel, root, asked, button: (label) => root.find({ attribute: ["aria-label", label] }) };
}

test("what was asked of a paused run adds up, and is forgotten when it begins again", () => {
  const { panel, asked, button } = panelOf();
  panel.paused = true;
  button("third: one up").press();
  button("third: one up").press();
  panel.clear();
  panel.show(frameOf(LEVELS));
  button("second: one down").press();
  assert.deepEqual(asked, ["first third second", "third first second", "first third second"]);
});

test("a level that is moved stays open and keeps the focus, so that it can be moved on by keyboard", () => {
  const { panel, root, button } = panelOf();
  const opener = root.find({ text: "3 third" });
  opener.press();
  button("third: one up").focus();
  panel.show(frameOf(["first", "third", "second"]));
  assert.equal(root.find({ text: "2 third" }).getAttribute("aria-expanded"), "true");
  assert.equal(root.find({ text: "3 second" }).getAttribute("aria-expanded"), "false");
  assert.equal(document.activeElement as unknown, button("third: one up"));
  panel.show(frameOf(["third", "first", "second"]));
  assert.equal(document.activeElement as unknown, button("third: one up"));
});
