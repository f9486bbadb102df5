import { read, scalar, word, type Frame } from "../data/frame.ts";
import { accountAt, type Account } from "../data/hierarchy.ts";
import { baseChannel, type LegChannels } from "../data/schema.ts";
import { pushesOf } from "../data/pushes.ts";
import { pyramidUse } from "../data/pyramid_use.ts";
import { yawOf } from "../math/geometry.ts";
import { digits, fixed, secondsText, seen } from "../data/numbers.ts";
import { commandText, faultsText } from "../data/stop.ts";
import { wishesText } from "../data/wished_forces.ts";
import { percent } from "../math/friction.ts";
import { h, setText } from "./dom.ts";

/** Texts of a phase: as planned, and with the foot in the air. */
const PHASES: Record<string, [as_planned: string, in_the_air: string]> = {
  stance: ["stands", "should stand, is in the air"],
  unloading: ["unloads", "should unload, is in the air"],
  swing: ["swings", "swings"],
  search: ["searches for ground", "searches for ground"],
};

/** Modes whose command is not the solution's: the plan does not apply to the feet. */
const WITHOUT_PLAN = ["hold", "sit", "damping", "lifted", "rise"];

/** Size of the force on a foot that touches the ground. */
function sizeText(frame: Frame, leg: LegChannels): string {
  const force = [0, 0, 0];
  return read(frame, leg.trueForce, force) ? `, |f| ${digits(Math.hypot(...force))} N` : "";
}

/** What a foot should do and does. */
function footText(frame: Frame, leg: LegChannels): string {
  const [asPlanned, inTheAir] = PHASES[word(frame, leg.phase)] ?? ["is not known", "is in the air"];
  const { name } = leg, touching = scalar(frame, leg.touching);
  if (Number.isNaN(touching)) return `${name} ${asPlanned}`;
  if (touching === 0) return `${name} ${inTheAir}`;
  return `${name} ${asPlanned}${asPlanned === "swings" ? ", touches" : ""}${sizeText(frame, leg)}`;
}

/** What the feet should do and do, or that the mode asks nothing of them. */
function feetText(frame: Frame): string {
  const mode = word(frame, "command.mode");
  if (!WITHOUT_PLAN.includes(mode)) return frame.schema.legs.map((leg) => footText(frame, leg)).join("; ");
  const touching = frame.schema.legs.map((leg) => scalar(frame, leg.touching));
  const asked = `nothing is asked of them (${mode})`;
  if (touching.some(Number.isNaN)) return asked;
  if (!touching.some((one) => one > 0)) return `${asked}; all are in the air`;
  return [asked, ...frame.schema.legs.map((leg, k) => `${leg.name} ${(touching[k] as number) > 0 ? `touches${sizeText(frame, leg)}` : "is in the air"}`)].join("; ");
}

/** Velocity of the base in the plane. */
function speedText(frame: Frame, topic: string): string {
  const v = [0, 0];
  return read(frame, baseChannel(topic, "v"), v) ? `${digits(seen(Math.hypot(...v), "m/s"))} m/s` : "";
}

/** Position and heading of a base; "": not known. */
function whereabouts(frame: Frame, topic: string): string {
  const p = [0, 0, 0];
  const q = [1, 0, 0, 0];
  if (!read(frame, baseChannel(topic, "p"), p) || !read(frame, baseChannel(topic, "q"), q)) return "";
  const [x, y, z] = p.map((one) => fixed(one, 3));
  return `x ${x} m, y ${y} m, z ${z} m, heading ${fixed((yawOf(q) * 180) / Math.PI, 2)}°`;
}

/** Drift of the estimate since the first tick. */
function estimateError(frame: Frame): string {
  const [distance, heading] = [scalar(frame, "estimate.position_error"), scalar(frame, "estimate.heading_error")];
  if (Number.isNaN(distance + heading)) return "";
  return `${digits(100 * distance)} cm and ${digits((Math.abs(heading) * 180) / Math.PI)}° in heading since the start`;
}

/** Distance of the true centre of mass from the planned one. */
function comError(frame: Frame): string {
  const off = [0, 0];
  if (!read(frame, "alignment.com_error", off)) return "";
  return `${digits(1000 * Math.hypot(...off))} mm, (${off.map((part) => fixed(1000 * part, 1)).join(", ")}) mm in W, the controller's world`;
}

/** Friction use of each foot that carries. */
function pyramidUses(frame: Frame): string {
  const uses = frame.schema.legs.map((leg) => [leg.name, pyramidUse(frame, leg)] as const);
  return uses.filter(([, use]) => !Number.isNaN(use)).map(([leg, use]) => `${leg} ${percent(use)}`).join(", ");
}

/** Outside forces on the robot; "": not known. */
function pushText(frame: Frame): string {
  const pushes = pushesOf(frame);
  if (pushes === undefined) return "";
  const forces = pushes.map(({ body, force }) =>
    `${digits(Math.hypot(...force))} N on ${frame.schema.bodies[body] ?? `body ${body + 1}`}, (${force.map((part) => fixed(part, 1)).join(", ")}) N in S, the simulator's world`);
  return forces.length === 0 ? "nothing" : `${forces.join("; ")} (truth: the controller is not told)`;
}

/** The state in sentences, as the picture shows it; "": there is nothing to say of this now. */
export function sentences(frame: Frame, account = accountAt(frame)): [string, string][] {
  const truth = whereabouts(frame, "truth");
  return [
    ["Time", `${secondsText(frame.time)}, tick ${frame.tick}`],
    ["Feet", feetText(frame)],
    ["Pyramid used", pyramidUses(frame)],
    [truth === "" ? "Base, believed" : "Base, true", truth || whereabouts(frame, "state")],
    ["Estimate drifted by", estimateError(frame)],
    ["Centre of mass off plan", comError(frame)],
    ["Velocity, true", speedText(frame, "truth")],
    ["Velocity, believed", speedText(frame, "state")],
    ["Pushed by", pushText(frame)],
    ["Command", commandText(frame) + wishesText(frame)],
    ["Sensors now", faultsText(frame)],
    ["Hierarchy", account.line],
  ];
}

/** Names with texts; a name whose text is "" is hidden and keeps its place. */
class TextList {
  readonly root: HTMLElement;
  private readonly rows = new Map<string, { name: HTMLElement; text: HTMLElement }>();

  constructor(attributes: Record<string, string> = {}) {
    this.root = h("dl", attributes);
  }

  show(name: string, text: string): void {
    const row = this.rows.get(name) ?? this.add(name);
    row.name.hidden = row.text.hidden = text === "";
    setText(row.text, text);
  }

  clear(): void {
    this.rows.clear();
    this.root.replaceChildren();
  }

  private add(name: string): { name: HTMLElement; text: HTMLElement } {
    const row = { name: h("dt", {}, name), text: h("dd", {}) };
    this.rows.set(name, row);
    this.root.append(row.name, row.text);
    return row;
  }
}

/** The state in words, and what the run is. */
export class StatePanel {
  private readonly state = new TextList({ id: "state", "aria-live": "off" });
  private readonly run = new TextList();

  constructor(root: HTMLElement, facts: [string, string][], notes: string[]) {
    this.showRun(facts);
    root.append(h("h2", {}, "Now"), this.state.root, h("h2", {}, "Run"), this.run.root);
    if (notes.length > 0) root.append(h("h2", {}, "Notes"), h("ul", {}, ...notes.map((note) => h("li", {}, note))));
  }

  /** What the run is, some of which becomes known only later. */
  showRun(facts: [string, string][]): void {
    for (const [name, text] of facts) this.run.show(name, text);
  }

  clear(): void {
    this.state.clear();
  }

  show(frame: Frame, account: Account): void {
    for (const [name, text] of sentences(frame, account)) this.state.show(name, text);
  }
}
