import assert from "node:assert/strict";
import { test } from "node:test";
import { Player } from "../src/data/player.ts";
import type { FrameSource, Mark } from "../src/data/source.ts";
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

test("the list of found channels is closed by who leaves it and its search by the tab key", () => {
  const { root } = fakePage();
  new PlotsPanel(root as unknown as HTMLElement, player, schemaOf({ "state.v_WB": 3 }));
  const search = root.find({ attribute: ["id", "channel-search"] });
  const list = root.find({ attribute: ["aria-label", "channels"] });
  const isOpen = (): boolean => !(list as unknown as HTMLElement).hidden;
  const leaveFor = (next: FakeElement | null): boolean => {
    search.bubble(Object.assign(new Event("focusout"), { relatedTarget: next }));
    return isOpen();
  };
  search.dispatchEvent(new Event("focus"));
  const [channel] = list.all().filter(({ localName }) => localName === "button");
  assert.deepEqual([isOpen(), leaveFor(channel as FakeElement), leaveFor(null)], [true, true, true], "another window is not the next field");
  assert.equal(leaveFor(root.find({ attribute: ["id", "span"] })), false);
});

test("a span that is chosen in the past does not begin before the first frame", () => {
  const { root } = fakePage();
  const live = new Player({ first: 5, last: 60, marks: [] } as unknown as FrameSource, true);
  const panel = new PlotsPanel(root as unknown as HTMLElement, live, schemaOf({ "state.v_WB": 3 }));
  const spans = root.find({ attribute: ["id", "span"] });
  live.seek(6);
  spans.enter("30");
  assert.deepEqual(panel["range"](), [5, 35]);
  live.seek(40);
  spans.enter("10");
  assert.deepEqual(panel["range"](), [35, 45]);
});

test("marks of the time bar are drawn anew where its size or the page's zoom is another one", () => {
  const { root } = fakePage();
  const transport = new Transport(root as unknown as HTMLElement, player, [1], { pause: () => {}, step: () => {}, speed: () => {}, reset: () => {} });
  const canvas = root.all().find(({ localName }) => localName === "canvas") as FakeElement;
  let pictures = 0;
  Object.assign(canvas, { clientWidth: 300, clientHeight: 15, getContext: () => (++pictures, null) });
  const picturesWith = (zoom: number, height = 15): number => {
    Object.assign(globalThis, { devicePixelRatio: zoom });
    Object.assign(canvas, { clientHeight: height });
    transport.update(undefined, false);
    return pictures;
  };
  assert.deepEqual([picturesWith(1), picturesWith(1), picturesWith(2), picturesWith(2, 20)], [1, 1, 2, 3]);
});

test("marks of the time bar are told by their size, too: the more one weighs the higher and wider it is", () => {
  const { root } = fakePage();
  Object.assign(globalThis, { devicePixelRatio: 1, getComputedStyle: () => ({ getPropertyValue: (name: string) => name }) });
  const mark = (time: number, kind: Mark["kind"], text: string): Mark => ({ time, kind, text, leg: "" });
  const marks = [mark(2, "event", "lift-off"), mark(6, "change", "friction"), mark(10, "force", "push"), mark(14, "mode", "damping")];
  const run = new Player({ first: 0, last: 20, marks } as unknown as FrameSource, false);
  const transport = new Transport(root as unknown as HTMLElement, run, [1], { pause: () => {}, step: () => {}, speed: () => {}, reset: () => {} });
  const sizes: [number, number][] = [];
  const context = { scale: () => {}, fillRect: (_x: number, _y: number, wide: number, tall: number) => sizes.push([wide, tall]) };
  const canvas = root.all().find(({ localName }) => localName === "canvas") as FakeElement;
  Object.assign(canvas, { clientWidth: 300, clientHeight: 20, getContext: () => context });
  transport.update(undefined, false);
  assert.equal(sizes.length, 4);
  for (const side of [0, 1] as const) sizes.slice(1).forEach((size, k) => assert.ok(size[side] > (sizes[k] as [number, number])[side], `${sizes}`));
});
