import type { Ask } from "../protocol/commands.ts";
import { orderOf, type Session, type TaskInfo, type TaskNumber } from "../protocol/session.ts";
import type { Status } from "../protocol/connection.ts";
import { h, plain, setText } from "./dom.ts";
import { NumberField } from "./number_field.ts";

export type Report = (text: string, kind?: "error" | "plain") => void;

/** The controller's friction estimate of a leg's foot. */
export interface Belief {
  name: string;
  friction: number;
}

/** The estimates of all feet, starting from the operator's; "": not known. */
export function beliefText(feet: Belief[], given: number): string {
  if (feet.some(({ friction }) => Number.isNaN(friction))) return "";
  if (feet.every(({ friction: mu }) => Math.abs(mu - given) < 0.005)) return `The controller believes μ = ${given.toFixed(2)} of every foot now.`;
  return `The controller believes now, after slips: ${feet.map(({ name, friction }) => `${name} ${friction.toFixed(2)}`).join(", ")}.`;
}

/** Gains of the tasks, and the friction that the controller assumes. */
export class TunePanel {
  private readonly tables = h("div", { class: "gains" });
  private readonly tasks = new Map<string, TaskTable>();
  private readonly controls: HTMLFieldSetElement;
  private readonly friction: NumberField;
  private readonly belief = h("p", { class: "soft", id: "friction-belief" });
  private frictionNow = NaN;

  constructor(root: HTMLElement, private readonly ask: Ask, private readonly report: Report) {
    this.friction = new NumberField({ id: "friction", step: 0.05, "aria-label": "friction coefficient that the controller assumes of ground it has not felt yet" }, {
      ask: (value, field) => this.ask("friction", { value }, field),
      reject: (kept) => this.report(`No change: the friction was no number. It is ${kept} again.`, "error"),
    });
    this.controls = h("fieldset", { class: "controls" },
      h("label", { class: "field" }, "Friction μ", this.friction.input),
      this.belief,
      h("h2", {}, "Gains"), this.tables,
    );
    root.append(this.controls);
  }

  allow(allowed: boolean): void {
    this.controls.disabled = !allowed;
  }

  /** The run begins again, with the numbers of its scenario. */
  restart(): void {
    for (const field of this.fields()) field.drop();
  }

  private fields(): NumberField[] {
    return [this.friction, ...[...this.tasks.values()].flatMap((task) => task.fields)];
  }

  show(session: Session): void {
    this.friction.input.min = String(session.limits.friction_min);
    this.friction.input.max = String(session.limits.friction_max);
    this.frictionNow = session.friction;
    this.friction.show(session.friction);
    const order = orderOf(session);
    const tables = session.tasks.filter(({ numbers }) => numbers.length > 0).map((task) => this.table(task, order.indexOf(task.level_name) + 1));
    tables.sort((a, b) => a.place - b.place);
    // Elements that are inserted again lose the focus.
    if (tables.some(({ root }, k) => this.tables.children[k] !== root)) this.tables.replaceChildren(...tables.map(({ root }) => root));
  }

  showBelief(feet: Belief[]): void {
    setText(this.belief, beliefText(feet, this.frictionNow));
  }

  /** In a paused run, changes stay shown until they take effect. */
  showStatus({ paused }: Pick<Status, "paused">): void {
    for (const field of this.fields()) field.refresh(paused);
  }

  private table(task: TaskInfo, place: number): TaskTable {
    const key = `${task.level_name}.${task.task}`;
    const known = this.tasks.get(key);
    const table = known ?? new TaskTable(task, this.ask, (text) => this.report(text, "error"));
    this.tasks.set(key, table);
    table.show(task, place);
    return table;
  }
}

type Reject = (text: string) => void;

/** The numbers of a task. */
class TaskTable {
  readonly root: HTMLElement;
  place = 0;
  private readonly title = h("span", {});
  readonly fields: NumberField[];

  constructor(task: TaskInfo, ask: Ask, reject: Reject) {
    const detail = task.task === task.level_name ? undefined : h("span", { class: "soft" }, ` ${plain(task.task)}`);
    const gains = task.numbers.map((number) => new GainField(task, number, ask, reject));
    this.fields = gains.map(({ field }) => field);
    this.root = h("section", { class: "task" }, h("h3", {}, this.title, detail), ...gains.map(({ root }) => root));
  }

  /** `place`: of the level in the order, from 1. */
  show(task: TaskInfo, place: number): void {
    this.place = place;
    setText(this.title, `${place} ${plain(task.level_name)}`);
    this.fields.forEach((field, k) => field.show(task.numbers[k]?.value ?? NaN));
  }
}

/** A task's name, as in the program's messages. */
const taskTitle = ({ level_name: level, task }: TaskInfo): string => (level === task ? plain(level) : `${plain(level)}, ${plain(task)}`);

/** The catalogue marks ratios by "–", which would look like an unknown number. */
function unitText(unit: string): string {
  return unit === "–" ? "(ratio)" : unit;
}

/** A number of a task, with its name, unit and range. */
class GainField {
  readonly root: HTMLElement;
  readonly field: NumberField;

  constructor(task: TaskInfo, number: TaskNumber, ask: Ask, reject: Reject) {
    const unit = number.unit === "–" ? "" : ` ${number.unit}`;
    const range = `from ${number.min} to ${number.max}${unit}`.trimEnd();
    const hint = [number.about, range].filter((text) => text !== "").join("; ");
    this.field = new NumberField({ min: number.min, max: number.max, step: "any", "data-gain": `${task.level_name}.${task.task}.${number.name}`, title: hint }, {
      ask: (value, field) => ask("gain", { level: task.level_name, task: task.task, name: number.name, value }, field),
      reject: (kept) => reject(`No change: ${taskTitle(task)} ${plain(number.name)} was no number. It is ${kept}${unit} again.`),
    });
    const name = h("span", {}, plain(number.name), h("small", { class: "hint" }, hint));
    this.root = h("label", { class: "field" }, name, h("span", { class: "with-unit" }, this.field.input, h("span", { class: "unit" }, unitText(number.unit))));
  }
}
