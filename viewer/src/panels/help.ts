import { h, part } from "./dom.ts";

type Key = [keys: string, does: string];

const LOOKING: Key[] = [
  ["space", "pause or go on"],
  [", .", "one tick back or on"],
  ["← →", "0.1 s back or on; with shift 1 s; on a tab, the panel beside it"],
  ["[ ]", "slower or faster"],
  ["r", "begin again"],
  ["f", "the camera follows the robot, or stays"],
  ["h", "back to the first view"],
  ["1 … 9, 0, −, =", "overlays on or off, in the order of their menu"],
  ["o", "the estimator's ghost on or off"],
  ["t", "light or dark"],
  ["Esc", "leave the plots' search, or close this help"],
  ["?", "this help"],
];

const DRIVING: Key[] = [
  ["l", "from the past, where space stops only what is shown, back to now"],
  ["w s a d", "walk forward, backward, to the left, to the right: 0.01 m/s a press, held on and on"],
  ["q e", "turn to the left, to the right"],
  ["PgUp PgDn", "torso higher or lower"],
  ["x", "stand on all feet"],
  ["g", "back to the scenario's commands"],
  ["p", "push, as the panel Drive says"],
];

/** Keys of a live run or a log; with gaits the digits choose them. */
function keysOf(live: boolean, gaits: number): Key[] {
  if (gaits === 0) return [...LOOKING, ...(live ? DRIVING : [])];
  const looking = LOOKING.map(([keys, does]): Key => (keys.startsWith("1") ? ["shift 1 … 0, −, =", does] : [keys, does]));
  return [...looking, ...DRIVING, [`1 … ${gaits}`, "gaits, in the order of the panel Drive"]];
}

/** Fills the help dialogue; returns its toggle. */
export function makeHelp(live: boolean, gaits: readonly string[] = []): () => void {
  const dialog = part<HTMLDialogElement>("help");
  const close = h("button", { class: "small", "aria-label": "close", onclick: () => dialog.close() }, "×");
  dialog.append(
    h("div", { class: "row" }, h("h2", {}, "Keys"), close),
    h("dl", { class: "keys" }, ...keysOf(live, live ? gaits.length : 0).flatMap(([keys, does]) => [h("dt", {}, h("kbd", {}, keys)), h("dd", {}, does)])),
    ...(live ? [h("h2", {}, "Gamepad"), h("p", {}, "The left stick walks, the right one turns; A pushes, B stands, the shoulders change the gait.")] : []),
    h("h2", {}, "Mouse and fingers"),
    h("p", {}, "Drag turns the view, with the right button or two fingers it moves, the wheel or two fingers zoom. Press in a plot to go to that time; the wheel zooms its time."),
  );
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  const toggle = (): void => (dialog.open ? dialog.close() : dialog.showModal());
  part("help-open").addEventListener("click", toggle);
  return toggle;
}
