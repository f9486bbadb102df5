import type { Commands } from "../protocol/commands.ts";
import type { Session, TaskInfo, TaskNumber } from "../protocol/session.ts";
import { h, plain } from "./dom.ts";
import { takeNumber } from "./number_field.ts";

export type Report = (text: string, kind?: "error" | "plain") => void;

/** Numbers of the tasks, the friction that the controller assumes, and undo. */
export class TunePanel {
  onUndo: () => void = () => {};
  private readonly tables = h("div", { class: "gains" });
  private readonly undoButton: HTMLButtonElement;
  private readonly list = h("ol", { class: "changes", "aria-label": "changes so far, the latest first" });
  private readonly none = h("p", { class: "soft" }, "No change so far.");
  private readonly friction: HTMLInputElement;
  private frictionNow = NaN;

  constructor(root: HTMLElement, private readonly commands: Commands, private readonly report: Report) {
    this.undoButton = h("button", { id: "undo", title: "undo the last change (u)", onclick: () => this.undo() }, "Undo");
    this.friction = h("input", {
      type: "number", id: "friction", step: 0.05, "aria-label": "friction coefficient that the controller assumes",
      onchange: () => this.askFriction(),
    });
    root.append(
      h("div", { class: "row" }, h("label", { class: "field" }, "Friction μ", this.friction), this.undoButton),
      h("h2", {}, "Gains"), this.tables,
      h("h2", {}, "Changes"), this.none, this.list,
    );
  }

  private askFriction(): void {
    const value = takeNumber(this.friction, this.frictionNow);
    if (value !== undefined) this.send("friction", { value });
  }

  undo(): void {
    this.onUndo();
    this.send("undo", {});
  }

  private send(type: string, fields: object, failed: () => void = () => {}, done: () => void = () => {}): void {
    this.commands.send(type, fields).then(done, (error: Error) => {
      this.report(error.message, "error");
      failed();
    });
  }

  show(session: Session): void {
    this.friction.min = String(session.limits.friction_min);
    this.friction.max = String(session.limits.friction_max);
    this.tables.replaceChildren(...session.tasks.map((task) => this.table(task)));
    if (session.tasks.length === 0) this.tables.append(h("p", { class: "soft" }, "The numbers of a log's tasks stand in its options."));
    for (const input of this.tables.querySelectorAll("input")) input.disabled = !this.commands.allowed;
    this.friction.disabled = !this.commands.allowed;
    this.undoButton.disabled = !this.commands.allowed;
  }

  showFriction(mu: number): void {
    if (Number.isNaN(mu)) return;
    this.frictionNow = Number(mu.toFixed(3));
    if (document.activeElement !== this.friction) this.friction.value = String(this.frictionNow);
  }

  showUndo(steps: number): void {
    const text = steps > 0 ? `Undo (${steps})` : "Undo";
    if (this.undoButton.textContent !== text) this.undoButton.textContent = text;
    this.undoButton.disabled = !this.commands.allowed || steps === 0;
  }

  private table(task: TaskInfo): HTMLElement {
    const rows = task.numbers.map((number) => this.row(task, number));
    return h("section", { class: "task" }, h("h3", {}, `${task.level + 1} ${plain(task.level_name)}`,
      task.task === task.level_name ? "" : h("span", { class: "soft" }, ` ${plain(task.task)}`)), ...rows);
  }

  private row(task: TaskInfo, number: TaskNumber): HTMLElement {
    const input = h("input", {
      type: "number", value: number.value, min: number.min, max: number.max, step: "any",
      "data-gain": `${task.level_name}.${task.task}.${number.name}`,
      title: `${number.min} to ${number.max} ${number.unit}`,
      onchange: () => ask(),
    });
    let kept = number.value;
    const ask = (): void => {
      const value = takeNumber(input, kept);
      if (value === undefined) return;
      const gain = { level: task.level_name, task: task.task, name: number.name, value };
      this.send("gain", gain, () => (input.value = String(kept)), () => (kept = value));
    };
    return h("label", { class: "field" }, plain(number.name), h("span", { class: "with-unit" }, input, h("span", { class: "unit" }, number.unit)));
  }

  addChange(time: number, text: string): void {
    this.none.hidden = true;
    this.list.prepend(h("li", {}, h("span", { class: "soft" }, `${time.toFixed(2)} s `), text));
    while (this.list.children.length > 200) this.list.lastElementChild?.remove();
  }
}
