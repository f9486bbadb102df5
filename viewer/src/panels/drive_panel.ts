import { asSentence } from "../data/log_words.ts";
import { fixed } from "../data/numbers.ts";
import { Wish } from "../data/wish.ts";
import { VIEW_ONLY, type Ask } from "../protocol/commands.ts";
import type { Status } from "../protocol/connection.ts";
import type { Limits } from "../protocol/session.ts";
import { h, setText } from "./dom.ts";
import { takeNumber } from "./number_field.ts";
import type { Report } from "./tune_panel.ts";

/** Steps of a key: m/s, m/s, rad/s, m. */
const WALK_STEPS = { forward: 0.01, left: 0.01, turn: 0.02, height: 0.005 };

export type Axis = keyof typeof WALK_STEPS;

/** Steps of a key where there are gaits to run with. */
const FAST = 5;

/** A command of the walk, in these units; `gait`: "" where there is no choice. */
export type Walk = Record<Axis, number> & { walk: boolean; gait: string };

/** Changes one axis of a command, within its limits. */
export function nudged(walk: Walk, axis: Axis, steps: number, limits: Record<Axis, number>): Walk {
  const value = Math.min(Math.max(walk[axis] + steps * WALK_STEPS[axis], -limits[axis]), limits[axis]);
  return { ...walk, walk: true, [axis]: Number(value.toFixed(4)) };
}

/** A direction in the plane, from the world's x towards its y; along an axis with its name. */
export function worldDirection(degrees: number): string {
  const axis = ["+x", "+y", "−x", "−y"][(((degrees / 90) % 4) + 4) % 4];
  return `${String(degrees).replace("-", "−")}°${axis === undefined ? "" : ` (${axis})`}`;
}

/** Who commands the walk, and what. */
function askedText({ by, walk, gait }: Status["command"]): string {
  const how = gait === "" ? "" : `, gait ${gaitText(gait)}`;
  return `${by === "operator" ? "You command" : "The scenario commands"}: ${walk ? "walk" : "stand"}${walk ? how : ""}.`;
}

/** A gait's name as text. */
export function gaitText(gait: string): string {
  return gait.replaceAll("_", " ");
}

/** Pushes, and commands of the walk. */
export class DrivePanel {
  /** Called before each command. */
  onAct: () => void = () => {};
  walk: Walk = { walk: false, forward: 0, left: 0, turn: 0, height: 0, gait: "" };
  private readonly most: Record<Axis, number>;
  private readonly wish = new Wish<Walk>();
  private readonly asked = h("p", { id: "asked", class: "asked" });
  private readonly values = new Map<Axis, HTMLElement>();
  private readonly gaitButtons: HTMLButtonElement[];
  private readonly impulse: HTMLInputElement;
  private readonly direction: HTMLInputElement;
  private readonly directionText = h("output", {});
  private readonly duration: HTMLInputElement;
  private readonly controls: HTMLFieldSetElement;
  private readonly viewOnly = h("p", { class: "soft view-only", hidden: true }, asSentence(VIEW_ONLY));

  constructor(root: HTMLElement, private readonly askRun: Ask, limits: Limits, private readonly report: Report, private readonly gaits: string[] = []) {
    this.gaitButtons = gaits.map((gait, i) =>
      h("button", { class: "small", title: `gait ${gaitText(gait)} (${i + 1})`, "aria-pressed": "false", "data-gait": gait, onclick: () => this.chooseGait(i) }, `${i + 1} ${gaitText(gait)}`));
    this.most = { forward: limits.walk_velocity, left: limits.walk_velocity, turn: limits.walk_yaw_rate, height: limits.walk_height };
    const number = (id: string, value: number, max: number, step: number): HTMLInputElement =>
      h("input", { type: "number", id, value, min: 0, max, step });
    this.impulse = number("push-impulse", Math.max(1, Math.round(limits.push_newton_seconds / 4)), limits.push_newton_seconds, 1);
    this.duration = number("push-duration", 0.2, limits.push_seconds, 0.05);
    this.direction = h("input", { type: "range", id: "push-direction", min: -180, max: 180, step: 5, value: 90, oninput: () => this.showDirection() });
    this.showDirection();
    this.controls = h("fieldset", { class: "controls" },
      h("h2", {}, "Push"),
      h("p", { class: "soft" }, `Pushes the base: at most ${limits.push_newton_seconds} N·s, and ${limits.push_newtons} N at one time.`),
      this.field("Impulse", this.impulse, "N·s"), this.field("Duration", this.duration, "s"),
      h("label", { class: "field" }, "Direction in the world", h("span", { class: "with-unit" }, this.direction, this.directionText)),
      h("button", { id: "push", class: "primary", title: "push (p)", onclick: () => this.push() }, "Push"),
      h("h2", {}, "Walk"), this.asked,
      h("div", { class: "gaits", role: "group", "aria-label": "gait" }, ...this.gaitButtons),
      this.axis("forward", "Forward", "m/s", "w", "s"), this.axis("left", "To the left", "m/s", "a", "d"),
      this.axis("turn", "Turn left", "rad/s", "q", "e"), this.axis("height", "Torso height", "m", "PgUp", "PgDn"),
      h("div", { class: "row" },
        h("button", { id: "stand", title: "stand on all feet (x)", onclick: () => this.stand() }, "Stand"),
        h("button", { id: "give-back", title: "the scenario commands again (g)", onclick: () => this.giveBack() }, "Back to the scenario")),
    );
    root.append(this.viewOnly, this.controls);
  }

  /** `allowed`: this page may command; `now`: there is a run to command. */
  allow(allowed: boolean, now: boolean): void {
    this.viewOnly.hidden = allowed;
    this.controls.disabled = !allowed || !now;
  }

  private field(label: string, input: HTMLInputElement, unit: string): HTMLElement {
    return h("label", { class: "field" }, label, h("span", { class: "with-unit" }, input, h("span", { class: "unit" }, unit)));
  }

  private axis(axis: Axis, label: string, unit: string, more: string, less: string): HTMLElement {
    const value = h("output", { "data-axis": axis });
    this.values.set(axis, value);
    const button = (text: string, steps: number, key: string): HTMLButtonElement =>
      h("button", { class: "small", "aria-label": `${label} ${steps > 0 ? "more" : "less"}`, title: key, onclick: () => this.nudge(axis, steps) }, text);
    return h("div", { class: "field" }, label,
      h("span", { class: "with-unit" }, button("−", -1, less), value, h("span", { class: "unit" }, unit), button("+", 1, more)));
  }

  private showDirection(): void {
    const text = worldDirection(Number(this.direction.value));
    setText(this.directionText, text);
    this.direction.setAttribute("aria-valuetext", text);
  }

  push(): void {
    const angle = (Number(this.direction.value) * Math.PI) / 180;
    const size = this.take(this.impulse, "impulse", "N·s", ", its direction is chosen below");
    const duration = size === undefined ? undefined : this.take(this.duration, "duration", "s");
    if (size === undefined || duration === undefined) return;
    const impulse = [size * Math.cos(angle), size * Math.sin(angle), 0].map((part) => Number(part.toFixed(6)));
    this.send("push", { body: "base", impulse, duration });
  }

  /** The number in a field of the push; undefined, with a message, where it is not positive. */
  private take(field: HTMLInputElement, name: string, unit: string, help = ""): number | undefined {
    const given = field.value;
    const value = takeNumber(field, Number(field.defaultValue));
    if (value !== undefined && value > 0) return value;
    field.value = field.defaultValue;
    const wrong = value === undefined ? "was no number" : `can't be ${given.replace("-", "−")} ${unit}${help}`;
    this.report(`No push: its ${name} ${wrong}. It is ${field.value} ${unit} again.`, "error");
    return undefined;
  }

  nudge(axis: Axis, steps: number): void {
    const fast = this.gaits.length > 0 && axis !== "height" ? FAST : 1;
    this.ask(nudged(this.walk, axis, steps * fast, this.most));
  }

  /** The gait at this place of the list, if there is one. */
  chooseGait(place: number): void {
    const gait = this.gaits[place];
    if (gait !== undefined) this.ask({ ...this.walk, walk: true, gait });
  }

  /** The gait before or after the present one. */
  stepGait(by: 1 | -1): void {
    const place = this.gaits.indexOf(this.walk.gait) + by;
    this.chooseGait((place + this.gaits.length) % Math.max(1, this.gaits.length));
  }

  /** Walks with shares of the fastest command, as the sticks of a gamepad give them. */
  drive(shares: Record<"forward" | "left" | "turn", number>): void {
    const of = (axis: "forward" | "left" | "turn"): number => Number((shares[axis] * this.most[axis]).toFixed(2));
    this.ask({ ...this.walk, walk: true, forward: of("forward"), left: of("left"), turn: of("turn") });
  }

  stand(): void {
    this.ask({ ...this.walk, walk: false, forward: 0, left: 0, turn: 0 });
  }

  private ask(command: Walk): void {
    const { walk, forward, left, turn, height, gait } = (this.walk = command);
    this.wish.ask(command);
    this.send("walk", { walk, velocity: [forward, left], yaw_rate: turn, height, ...(gait === "" ? {} : { gait }) }, this.wish);
    this.showValues();
  }

  /** The run begins again, with its scenario's commands. */
  restart(): void {
    this.wish.drop();
  }

  giveBack(): void {
    this.wish.drop();
    this.send("walk", { by: "scenario" });
  }

  private send(type: string, fields: object, wish?: Wish<Walk>): void {
    this.onAct();
    this.askRun(type, fields, wish);
  }

  show(status: Status): void {
    const { command } = status;
    const [forward = 0, left = 0] = command.velocity;
    this.walk = this.wish.or({ walk: command.walk, forward, left, turn: command.yaw_rate, height: command.height, gait: command.gait });
    if (status.ended !== null) setText(this.asked, "The run has ended: a reset begins it again.");
    else setText(this.asked, askedText(command));
    this.showValues();
  }

  private showValues(): void {
    for (const button of this.gaitButtons) button.setAttribute("aria-pressed", String(button.dataset["gait"] === this.walk.gait));
    for (const [axis, element] of this.values) setText(element, fixed(this.walk[axis], axis === "height" ? 3 : 2));
  }
}
