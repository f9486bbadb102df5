import { h, setText } from "./dom.ts";

type Attributes = Record<string, string>;

/** A menu of numbers that can also show another number. */
export class NumberMenu {
  readonly select: HTMLSelectElement;
  private readonly other = h("option", { hidden: true });

  /** `textOf`: text of a number; `ask`: called with a chosen number. */
  constructor(attributes: Attributes, private readonly numbers: readonly number[], private readonly textOf: (value: number) => string, ask: (value: number) => void) {
    this.select = h("select", { ...attributes, onchange: () => ask(this.value) },
      ...numbers.map((value) => h("option", { value }, textOf(value))), this.other);
  }

  get value(): number {
    return Number(this.select.value);
  }

  show(value: number): void {
    this.other.hidden = this.numbers.includes(value);
    if (!this.other.hidden) {
      this.other.value = String(value);
      setText(this.other, this.textOf(value));
    }
    this.select.value = String(value);
  }
}
