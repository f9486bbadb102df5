import type { Commands } from "../protocol/commands.ts";
import { orderOf, type Session, type TaskInfo, type TaskNumber } from "../protocol/session.ts";
import { LEGS } from "../data/schema.ts";
import { changeText } from "../data/change_words.ts";
import { Wish } from "../data/wish.ts";
import type { Status } from "../protocol/connection.ts";
import { ChangeList } from "./change_list.ts";
import { h, plain, say } from "./dom.ts";
import { takeNumber } from "./number_field.ts";

export type Report = (text: string, kind?: "error" | "plain") => void;

/** What the grip has made, foot by foot, of the friction that the operator gave; "" where it is not known. */
export function beliefText(friction: number[], given: number): string {
  if (friction.some((mu) => Number.isNaN(mu))) return "";
  if (friction.every((mu) => Math.abs(mu - given) < 0.005)) return `The controller believes μ = ${given.toFixed(2)} of every foot now.`;
  return `The controller believes now, after slips: ${LEGS.map((leg, k) => `${leg} ${friction[k]?.toFixed(2)}`).join(", ")}.`;
}

/** Numbers of the tasks, the friction that the controller assumes, and undo. */
export class TunePanel {
  onUndo: () => void = () => {};
  private readonly tables = h("div", { class: "gains" });
  private readonly tasks = new Map<string, TaskTable>();
  private readonly undoButton: HTMLButtonElement;
  private readonly controls: HTMLFieldSetElement;
  readonly changes: ChangeList;
  private readonly friction: HTMLInputElement;
  private readonly belief = h("p", { class: "soft", id: "friction-belief" });
  private frictionNow = NaN;
  private readonly frictionWish = new Wish<number>();
  /** Something is wanted that no tick has taken yet. */
  private waits = false;

  constructor(root: HTMLElement, private readonly commands: Commands, mostChanges: number, private readonly report: Report) {
    this.changes = new ChangeList(mostChanges);
    this.undoButton = h("button", { id: "undo", title: "undo the last change (u)", onclick: () => this.undo() }, "Undo");
    this.friction = h("input", {
      type: "number", id: "friction", step: 0.05, "aria-label": "friction coefficient that the controller assumes of ground it has not felt yet",
      onchange: () => this.askFriction(),
    });
    this.controls = h("fieldset", { class: "controls" },
      h("div", { class: "row" }, h("label", { class: "field" }, "Friction μ", this.friction), this.undoButton),
      this.belief,
      h("h2", {}, "Changes"), this.changes.root,
      h("h2", {}, "Gains"), this.tables,
    );
    root.append(this.controls);
  }

  allow(allowed: boolean): void {
    this.controls.disabled = !allowed;
  }

  private askFriction(): void {
    const value = takeNumber(this.friction, this.frictionNow);
    if (value === undefined) return this.report(`No change: the friction was no number. It is ${this.frictionNow} again.`, "error");
    this.frictionWish.ask(value);
    this.send("friction", { value }, () => this.frictionWish.drop());
  }

  undo(): void {
    this.onUndo();
    this.frictionWish.drop();
    for (const task of this.tasks.values()) task.dropWishes();
    this.send("undo", {});
  }

  private send(type: string, fields: object, failed: () => void = () => {}): void {
    this.commands.send(type, fields).catch((error: Error) => {
      this.report(changeText(error.message), "error");
      failed();
    });
  }

  show(session: Session): void {
    this.friction.min = String(session.limits.friction_min);
    this.friction.max = String(session.limits.friction_max);
    this.frictionNow = session.friction;
    this.showFriction();
    const order = orderOf(session);
    const tables = session.tasks.filter(({ numbers }) => numbers.length > 0).map((task) => this.table(task, order.indexOf(task.level_name) + 1));
    tables.sort((a, b) => a.place - b.place);
    // Elements that are put in again lose the focus.
    if (tables.some(({ root }, k) => this.tables.children[k] !== root)) this.tables.replaceChildren(...tables.map(({ root }) => root));
  }

  private showFriction(): void {
    if (document.activeElement !== this.friction) this.friction.value = String(this.frictionWish.or(this.frictionNow, this.waits));
  }

  /** `friction`: that each foot is believed to find. */
  showBelief(friction: number[]): void {
    say(this.belief, beliefText(friction, this.frictionNow));
  }

  showStatus({ undo, pending }: Pick<Status, "undo" | "pending">): void {
    say(this.undoButton, undo > 0 ? `Undo (${undo})` : "Undo");
    this.undoButton.disabled = undo === 0;
    this.waits = pending !== "";
    this.changes.wait(pending);
    this.showFriction();
  }

  private table(task: TaskInfo, place: number): TaskTable {
    const key = `${task.level_name}.${task.task}`;
    const known = this.tasks.get(key);
    const table = known ?? new TaskTable(task, (gain, failed) => this.send("gain", gain, failed), (text) => this.report(text, "error"));
    this.tasks.set(key, table);
    table.show(task, place);
    return table;
  }
}

type SendGain = (gain: object, failed: () => void) => void;
type Tell = (text: string) => void;

/** The numbers of a task. */
class TaskTable {
  readonly root: HTMLElement;
  place = 0;
  private readonly title = h("span", {});
  private readonly gains: GainField[];

  constructor(task: TaskInfo, send: SendGain, tell: Tell) {
    const detail = task.task === task.level_name ? undefined : h("span", { class: "soft" }, ` ${plain(task.task)}`);
    this.gains = task.numbers.map((number) => new GainField(task, number, send, tell));
    this.root = h("section", { class: "task" }, h("h3", {}, this.title, detail), ...this.gains.map(({ root }) => root));
  }

  /** `place`: of its level in the order, from 1. */
  show(task: TaskInfo, place: number): void {
    this.place = place;
    say(this.title, `${place} ${plain(task.level_name)}`);
    this.gains.forEach((gain, k) => gain.show(task.numbers[k]?.value ?? NaN));
  }

  dropWishes(): void {
    for (const gain of this.gains) gain.wish.drop();
  }
}

/** A task as the program calls it in what it says of changes. */
const taskTitle = ({ level_name: level, task }: TaskInfo): string => (level === task ? plain(level) : `${plain(level)}, ${plain(task)}`);

/** Of a ratio the catalogue says "–", which reads like a number that is not known. */
function unitText(unit: string): string {
  return unit === "–" ? "(ratio)" : unit;
}

/** A number in a field. What is being typed stays there, whatever changes meanwhile. */
class GainField {
  readonly root: HTMLElement;
  readonly wish = new Wish<number>();
  private readonly input: HTMLInputElement;
  private now: number;
  /** What the field said before somebody typed. */
  private said = "";

  constructor(task: TaskInfo, number: TaskNumber, send: SendGain, tell: Tell) {
    this.now = number.value;
    const range = `from ${number.min} to ${number.max} ${number.unit === "–" ? "" : number.unit}`.trimEnd();
    const hint = [number.about, range].filter((text) => text !== "").join("; ");
    this.input = h("input", {
      type: "number", min: number.min, max: number.max, step: "any",
      "data-gain": `${task.level_name}.${task.task}.${number.name}`,
      title: hint,
      onchange: () => {
        const value = takeNumber(this.input, this.now);
        this.said = this.input.value;
        if (value === undefined) return tell(`No change: ${taskTitle(task)} ${plain(number.name)} was no number. It is ${this.said}${number.unit === "–" ? "" : ` ${number.unit}`} again.`);
        this.wish.ask(value);
        send({ level: task.level_name, task: task.task, name: number.name, value }, () => this.refuse());
      },
    });
    const name = h("span", {}, plain(number.name), h("small", { class: "hint" }, hint));
    this.root = h("label", { class: "field" }, name, h("span", { class: "with-unit" }, this.input, h("span", { class: "unit" }, unitText(number.unit))));
  }

  show(value: number): void {
    this.now = value;
    const typing = document.activeElement === this.input && this.input.value !== this.said;
    if (!typing) this.say(this.wish.or(value));
  }

  private refuse(): void {
    this.wish.drop();
    this.say(this.now);
  }

  private say(value: number): void {
    this.said = String(value);
    if (this.input.value !== this.said) this.input.value = this.said;
  }
}
