import assert from "node:assert/strict";
import { test } from "node:test";
import { aboutRun, type Progress } from "../src/panels/about_run.ts";
import { endFact } from "../src/panels/head.ts";
import { effortOf } from "../src/panels/hierarchy_panel.ts";
import { StatePanel } from "../src/panels/state_panel.ts";
import type { Session } from "../src/protocol/session.ts";
import { missingText } from "../src/scene/mesh_library.ts";
import { fakePage, type FakeElement } from "./fake_page.ts";

const header = { scenario: "walk", description: "on flat ground", seed: 1, stack: "paper", robot: { name: "anymal_b", mass: 30 }, estimation: "truth", command: "" };

function about(session: object, progress: Partial<Progress> = {}): [string, string][] {
  const whole = { header, version: "0.1.0", source: "run.mcap", cut: "", damage: [], ...session } as unknown as Session;
  return aboutRun(whole, { recording: "", hasEnded: true, ended: "goal reached", isSteered: false, missing: "", ...progress });
}

test("of a log without its end the head keeps that, and the state says that nobody knows how the run ended", () => {
  const cut = "the log was never closed, or is cut off (at byte 7): what is left of it is shown";
  assert.deepEqual([endFact("", cut), endFact("goal reached", ""), endFact("", "")], ["cut off or never closed: how it ended is not known", "ended: goal reached", ""]);
  assert.deepEqual([about({}), about({ cut }, { ended: "" })].map((rows) => new Map(rows).get("Ended")), ["goal reached", "not known: see Log"]);
});

test("of a log that is whole, though its run was interrupted, it is told how it ended", () => {
  const cut = "the run was interrupted: the log's file is whole, and ends there";
  assert.equal(endFact("interrupted", cut), "ended: interrupted");
  assert.equal(new Map(about({ cut }, { ended: "interrupted" })).get("Ended"), "interrupted");
});

test("why there are no times is said where the log's end is missing, which has them", () => {
  const state = { rows: 2, iterations: 1 };
  assert.equal(effortOf(NaN, NaN, [state], true), "1 iteration · no times: they stand at a log's end, and this one has none");
  assert.equal(effortOf(NaN, NaN, [state]), "1 iteration");
});

test("what is known of a run only later has its row then: meshes that are missing stand there when their message is gone", () => {
  const { root } = fakePage();
  const state = new StatePanel(root as unknown as HTMLElement, about({}), []);
  const [name, text] = ["dt", "dd"].map((kind) => root.all().filter(({ localName }) => localName === kind)[about({}).findIndex(([one]) => one === "Meshes")]) as [FakeElement, FakeElement];
  const isHidden = (one: FakeElement): boolean => (one as unknown as { hidden: boolean }).hidden;
  assert.deepEqual([name.textContent, isHidden(name), isHidden(text)], ["Meshes", true, true]);
  const missing = missingText(new Map([["package://a/base.dae", "the file is not there"]]));
  state.showRun(about({}, { missing }));
  assert.deepEqual([isHidden(name), isHidden(text), text.textContent], [false, false, missing]);
  assert.match(missing, /base\.dae/);
  assert.equal(missingText(), "");
});
