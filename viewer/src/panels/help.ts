import { h, part } from "./dom.ts";

export const KEYS: [keys: string, does: string][] = [
  ["space", "pause or go on"],
  [", .", "one tick back or on"],
  ["← →", "0.1 s back or on; with shift 1 s"],
  ["[ ]", "slower or faster"],
  ["l", "to the newest picture of a live run"],
  ["r", "begin the run again"],
  ["f", "the camera follows the robot, or stays"],
  ["h", "back to the first view"],
  ["1 … 9, 0, −", "overlays on or off, in the order of their menu"],
  ["o", "the estimator's ghost on or off"],
  ["w s a d", "walk forward, backward, to the left, to the right"],
  ["q e", "turn to the left, to the right"],
  ["PgUp PgDn", "torso higher or lower"],
  ["x", "stand on four feet"],
  ["g", "back to the scenario's commands"],
  ["p", "push, as the panel Drive says"],
  ["u", "undo the last change"],
  ["t", "light or dark"],
  ["?", "this help"],
];

/** Fills the help dialogue; returns what opens and closes it. */
export function makeHelp(): () => void {
  const dialog = part<HTMLDialogElement>("help");
  const close = h("button", { class: "small", "aria-label": "close", onclick: () => dialog.close() }, "×");
  dialog.append(
    h("div", { class: "row" }, h("h2", {}, "Keys"), close),
    h("dl", { class: "keys" }, ...KEYS.flatMap(([keys, does]) => [h("dt", {}, h("kbd", {}, keys)), h("dd", {}, does)])),
    h("h2", {}, "Mouse and fingers"),
    h("p", {}, "Drag turns the view, with the right button or two fingers it moves, the wheel zooms. Drag the robot of a live run to pull it; with shift the drag turns the view there, too. Press in a plot to go to that time; the wheel zooms there."),
    h("h2", {}, "Gamepad"),
    h("p", {}, "Left stick: walk. Right stick: turn. First button: stand. Second button: the scenario commands again."),
  );
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  const toggle = (): void => (dialog.open ? dialog.close() : dialog.showModal());
  part("help-open").addEventListener("click", toggle);
  return toggle;
}
