import assert from "node:assert/strict";
import { test } from "node:test";
import { DrivePanel, worldDirection } from "../src/panels/drive_panel.ts";
import { TunePanel } from "../src/panels/tune_panel.ts";
import type { Ask } from "../src/protocol/commands.ts";
import type { Status } from "../src/protocol/connection.ts";
import type { Limits, Session } from "../src/protocol/session.ts";
import { FakeElement, fakePage } from "./fake_page.ts";

const limits = { friction_min: 0.05, friction_max: 2, walk_velocity: 0.5, walk_yaw_rate: 0.6, walk_height: 0.1, push_newton_seconds: 60, push_newtons: 300, push_seconds: 1, speeds: [1] } as Limits;

const sessionOf = (kp: number, friction = 0.5): Session =>
  ({
    limits, friction, orders: [], header: { level_names: ["com"] },
    tasks: [{ level: 0, level_name: "com", task: "com", numbers: [{ name: "kp", value: kp, unit: "1/s²", about: "", min: 0, max: 1000 }] }],
  }) as unknown as Session;

/** What is asked of a run, which takes all or refuses all. */
function askOf(refused = false): { ask: Ask; sent: string[] } {
  const sent: string[] = [];
  const ask: Ask = (type, _, wish) => {
    sent.push(type);
    if (refused) wish?.drop();
  };
  return { ask, sent };
}

function panelOf(refused = false): { panel: TunePanel; gain: FakeElement; friction: FakeElement; sent: string[]; told: string[] } {
  const { root } = fakePage();
  const { ask, sent } = askOf(refused);
  const told: string[] = [];
  const panel = new TunePanel(root as unknown as HTMLElement, ask, (text) => told.push(text));
  panel.show(sessionOf(100));
  const field = (name: string, value: string): FakeElement => root.find({ attribute: [name, value] });
  return { panel, gain: field("data-gain", "com.com.kp"), friction: field("id", "friction"), sent, told };
}

const valueOf = (field: FakeElement): string => (field as unknown as { value: string }).value;

test("a number that was asked of a paused run stands until a tick has it", () => {
  const { panel, gain, sent } = panelOf();
  gain.enter("150");
  panel.showStatus({ paused: true });
  assert.deepEqual([valueOf(gain), sent], ["150", ["gain"]]);
});

test("numbers of a run that begins again are its scenario's, whatever was asked just before", () => {
  const { panel, gain, friction } = panelOf();
  gain.enter("150");
  friction.enter("0.3");
  panel.restart();
  panel.show(sessionOf(100));
  assert.deepEqual([gain, friction].map(valueOf), ["100", "0.5"]);
});

test("a number that is refused is taken out of its field, also while it has the focus", () => {
  const { gain, friction } = panelOf(true);
  for (const [field, before] of [[gain, "100"], [friction, "0.5"]] as const) {
    field.focus();
    field.enter("5");
    assert.equal(valueOf(field), before);
  }
});

test("what is being typed stays, whatever comes meanwhile; no number is told, and undone", () => {
  const { panel, friction, told, sent } = panelOf();
  friction.focus();
  Object.assign(friction, { value: "0.4" });
  panel.show(sessionOf(100, 0.7));
  panel.showStatus({ paused: false });
  assert.equal(valueOf(friction), "0.4");
  friction.enter("");
  assert.deepEqual([valueOf(friction), told, sent], ["0.7", ["No change: the friction was no number. It is 0.7 again."], []]);
});

test("the direction of a push is told in words, also to those who hear", () => {
  const { root } = fakePage();
  new DrivePanel(root as unknown as HTMLElement, askOf().ask, limits, () => {});
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
  const drive = new DrivePanel(root as unknown as HTMLElement, askOf().ask, limits, () => {});
  drive.nudge("forward", 3);
  drive.restart();
  drive.show({ command: { walk: false, velocity: [0, 0], yaw_rate: 0, height: 0, gait: "", by: "scenario" }, ended: null } as unknown as Status);
  assert.deepEqual([drive.walk.forward, drive.walk.left], [0, 0]);
});
