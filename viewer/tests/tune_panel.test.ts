import assert from "node:assert/strict";
import { test } from "node:test";
import { worldDirection } from "../src/data/change_words.ts";
import { DrivePanel } from "../src/panels/drive_panel.ts";
import { TunePanel } from "../src/panels/tune_panel.ts";
import type { Commands } from "../src/protocol/commands.ts";
import type { Status } from "../src/protocol/connection.ts";
import type { Limits, Session } from "../src/protocol/session.ts";
import { FakeElement, fakePage } from "./fake_page.ts";

const limits = { friction_min: 0.05, friction_max: 2, changes: 200, walk_velocity: 0.5, walk_yaw_rate: 0.6, walk_height: 0.1, push_newton_seconds: 60, push_seconds: 1 } as Limits;

const sessionOf = (kp: number, friction = 0.5): Session =>
  ({
    limits, friction, orders: [], header: { level_names: ["com"] },
    tasks: [{ level: 0, level_name: "com", task: "com", keeps_physics: false, choices: {}, numbers: [{ name: "kp", value: kp, unit: "1/s²", about: "", min: 0, max: 1000 }] }],
  }) as unknown as Session;

/** Commands that are all taken, or all refused. */
function commandsOf(refused = false): { commands: Commands; sent: string[] } {
  const sent: string[] = [];
  const send = async (type: string): Promise<void> => {
    sent.push(type);
    if (refused) throw new Error("5 is too much");
  };
  return { commands: { send } as unknown as Commands, sent };
}

function panelOf(refused = false): { panel: TunePanel; gain: FakeElement; friction: FakeElement; sent: string[]; told: string[] } {
  const { root } = fakePage();
  const { commands, sent } = commandsOf(refused);
  const told: string[] = [];
  const panel = new TunePanel(root as unknown as HTMLElement, commands, limits.changes, (text) => told.push(text));
  panel.show(sessionOf(100));
  const field = (name: string, value: string): FakeElement => root.find({ attribute: [name, value] });
  return { panel, gain: field("data-gain", "com.com.kp"), friction: field("id", "friction"), sent, told };
}

const valueOf = (field: FakeElement): string => (field as unknown as { value: string }).value;
const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

test("a number that was undone before any tick took it is not shown any more", () => {
  const { panel, gain, sent } = panelOf();
  gain.enter("150");
  panel.showStatus({ undo: 1, pending: "com kp 100 → 150" });
  assert.equal(valueOf(gain), "150");
  panel.undo();
  panel.showStatus({ undo: 0, pending: "" });
  assert.deepEqual([valueOf(gain), sent], ["100", ["gain", "undo"]]);
});

test("numbers of a run that begins again are its scenario's, whatever was asked just before", () => {
  const { panel, gain, friction } = panelOf();
  gain.enter("150");
  friction.enter("0.3");
  panel.restart();
  panel.show(sessionOf(100));
  assert.deepEqual([gain, friction].map(valueOf), ["100", "0.5"]);
});

test("a number that is refused is taken out of its field, also while it has the focus", async () => {
  const { gain, friction, told } = panelOf(true);
  for (const [field, before] of [[gain, "100"], [friction, "0.5"]] as const) {
    field.focus();
    field.enter("5");
    await settled();
    assert.equal(valueOf(field), before);
  }
  assert.deepEqual(told, ["5 is too much", "5 is too much"]);
});

test("what is being typed stays, whatever comes meanwhile; no number is told, and undone", () => {
  const { panel, friction, told, sent } = panelOf();
  friction.focus();
  Object.assign(friction, { value: "0.4" });
  panel.show(sessionOf(100, 0.7));
  panel.showStatus({ undo: 0, pending: "" });
  assert.equal(valueOf(friction), "0.4");
  friction.enter("");
  assert.deepEqual([valueOf(friction), told, sent], ["0.7", ["No change: the friction was no number. It is 0.7 again."], []]);
});

test("the direction of a push is told in words, also to those who hear", () => {
  const { root } = fakePage();
  new DrivePanel(root as unknown as HTMLElement, commandsOf().commands, limits, () => {});
  const slider = root.find({ attribute: ["id", "push-direction"] });
  const told = [90, -180].map((degrees) => {
    Object.assign(slider, { value: String(degrees) });
    slider.dispatchEvent(new Event("input"));
    return slider.getAttribute("aria-valuetext");
  });
  assert.deepEqual(told, [90, -180].map((degrees) => worldDirection(degrees)));
});

test("what was asked to walk does not go on in a run that begins again", () => {
  const { root } = fakePage();
  const drive = new DrivePanel(root as unknown as HTMLElement, commandsOf().commands, limits, () => {});
  drive.nudge("forward", 3);
  drive.restart();
  drive.show({ command: { walk: false, velocity: [0, 0], yaw_rate: 0, height: 0, by: "scenario" }, ended: null, push: null, pull: null, newton_seconds_left: 60 } as unknown as Status);
  assert.deepEqual(drive.walk.velocity, [0, 0]);
});
