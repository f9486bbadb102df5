import assert from "node:assert/strict";
import { test } from "node:test";
import { keeps, listenToKeys } from "../src/input/keys.ts";

const ELEMENTS = {
  page: { localName: "body" }, button: { localName: "button" }, tab: { localName: "div", role: "tab" }, menu: { localName: "select" },
  number: { localName: "input", type: "number" }, search: { localName: "input", type: "search" }, box: { localName: "input", type: "checkbox" },
  slider: { localName: "input", type: "range" }, time: { localName: "input", type: "range", id: "scrub" },
} as const;

function focusOf(name: keyof typeof ELEMENTS) {
  const attributes: Record<string, string> = ELEMENTS[name];
  return { localName: ELEMENTS[name].localName, id: attributes["id"] ?? "", getAttribute: (one: string) => attributes[one] ?? null };
}

/** Which of these elements need the key themselves. */
const keepers = (key: string): string[] => (Object.keys(ELEMENTS) as (keyof typeof ELEMENTS)[]).filter((name) => keeps(focusOf(name), key));

test("keys belong to what has the focus where it needs them: a box is ticked, a slider moved, a field typed into", () => {
  assert.deepEqual(keepers("w"), ["menu", "number", "search"]);
  assert.deepEqual(keepers(" "), ["button", "tab", "menu", "number", "search", "box"]);
  assert.deepEqual(keepers("ArrowLeft"), ["tab", "menu", "number", "search", "slider"], "the time bar's arrows go 0.1 s, as on all of the page");
  assert.deepEqual(keepers("PageUp"), ["menu", "number", "search", "slider", "time"], "who moves a slider does not lift the torso");
});

interface Press { repeat?: boolean; ctrlKey?: boolean; altKey?: boolean; altGraph?: boolean }

/** Presses keys on the page; what they did. */
function pressed(...presses: [key: string, how?: Press][]): string[] {
  const did: string[] = [];
  const page = Object.assign(new EventTarget(), { querySelector: () => null, matches: () => false, ...focusOf("page") });
  Object.defineProperty(globalThis, "document", { value: page, configurable: true });
  listenToKeys(Object.fromEntries(["r", "w", "["].map((key) => [key, () => did.push(key)])));
  for (const [key, { altGraph = false, ...how } = {}] of presses)
    page.dispatchEvent(Object.assign(new Event("keydown", { cancelable: true }), { key, ...how, getModifierState: (name: string) => altGraph && name === "AltGraph" }));
  return did;
}

test("a key that is held walks ever faster, and does not begin the run again and again", () => {
  assert.deepEqual(pressed(["w"], ["w", { repeat: true }], ["r"], ["r", { repeat: true }], ["R"]), ["w", "w", "r", "r"]);
});

test("keys of the browser are left alone; brackets that need AltGr are none", () => {
  assert.deepEqual(pressed(["r", { ctrlKey: true }], ["[", { ctrlKey: true, altKey: true, altGraph: true }], ["w", { altKey: true }]), ["["]);
});
