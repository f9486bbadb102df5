import assert from "node:assert/strict";
import { test } from "node:test";
import { Player } from "../src/data/player.ts";
import type { FrameSource } from "../src/data/source.ts";
import { PlotsPanel } from "../src/panels/plots_panel.ts";
import { Transport } from "../src/panels/transport.ts";
import { type FakeElement, fakePage } from "./fake_page.ts";
import { schemaOf } from "./make.ts";

Object.defineProperty(globalThis, "ResizeObserver", { value: class { observe(): void {} }, configurable: true });

const player = new Player({ first: 0, last: 20, marks: [] } as unknown as FrameSource, false);

const valueOf = (field: FakeElement): string => (field as unknown as { value: string }).value;

test("the menu of the time that plots show says what the wheel made of it, and can be chosen again", () => {
  const { root } = fakePage();
  const panel = new PlotsPanel(root as unknown as HTMLElement, player, schemaOf({ "state.v_WB": 3 }));
  const menu = root.find({ attribute: ["id", "span"] });
  assert.equal(valueOf(menu), "0");
  player.time = 10;
  panel["plots"][0]?.onZoom(0.25, 10);
  assert.deepEqual([valueOf(menu), menu.lastElementChild?.textContent], ["5", "5.00 s"]);
  menu.enter("2");
  assert.equal(valueOf(menu), "2");
});

test("lines for which a plot has no room come into one of their own", () => {
  const { root } = fakePage();
  const panel = new PlotsPanel(root as unknown as HTMLElement, player, schemaOf({ big: 20, more: 5 }));
  const seriesOf = (channel: string, count: number) => Array.from({ length: count }, (_, index) => ({ channel, index }));
  for (const series of [seriesOf("big", 20), seriesOf("more", 2), seriesOf("more", 5)]) panel["choose"](series);
  assert.deepEqual(panel["plots"].map(({ series }) => series.length), [22, 3]);
});

test("numbers that change ten times a second are not read out by themselves", () => {
  const { root } = fakePage();
  new PlotsPanel(root as unknown as HTMLElement, player, schemaOf({ "state.v_WB": 3 }));
  new Transport(root as unknown as HTMLElement, player, [1], { pause: () => {}, step: () => {}, speed: () => {}, reset: () => {} });
  const outputs = root.all().filter(({ localName }) => localName === "output");
  assert.deepEqual(outputs.map((one) => one.getAttribute("aria-live")), Array(4).fill("off"));
});
