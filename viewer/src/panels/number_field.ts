import { Wish } from "../data/wish.ts";
import { h } from "./dom.ts";

/** The number in a field; undefined where it is empty or no number. */
export function numberIn(text: string): number | undefined {
  const value = text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : undefined;
}

/** The field's number; where it has none, `kept` comes back. */
export function takeNumber(input: Pick<HTMLInputElement, "value">, kept: number): number | undefined {
  const value = numberIn(input.value);
  if (value === undefined) input.value = String(kept);
  return value;
}

export interface NumberFieldActions {
  /** A number was given; the field is to drop one that is not taken. */
  ask: (value: number, field: NumberField) => void;
  /** What was given is no number, and the field says again what it said. */
  reject: (kept: string) => void;
}

/** A number of the run. What is being typed stays there, whatever changes meanwhile; what was asked for, until it is so or is not taken. */
export class NumberField {
  readonly input: HTMLInputElement;
  private readonly wish = new Wish<number>();
  /** That of the run. */
  private now = NaN;
  /** What the field said before somebody typed. */
  private said = "";

  constructor(attributes: Record<string, string | number>, private readonly actions: NumberFieldActions) {
    this.input = h("input", { type: "number", ...attributes, onchange: () => this.take() });
  }

  private take(): void {
    const value = takeNumber(this.input, this.now);
    this.said = this.input.value;
    if (value === undefined) return this.actions.reject(this.said);
    this.wish.ask(value);
    this.actions.ask(value, this);
  }

  /** The number of the run is this one. */
  show(now: number): void {
    this.now = now;
    this.refresh();
  }

  /** `held`: what was asked for can't come to effect yet. */
  refresh(held = false): void {
    const typing = document.activeElement === this.input && this.input.value !== this.said;
    if (!typing) this.say(this.wish.or(this.now, held));
  }

  /** Nothing is asked for any more. */
  drop(): void {
    this.wish.drop();
    this.say(this.now);
  }

  private say(value: number): void {
    this.said = String(value);
    if (this.input.value !== this.said) this.input.value = this.said;
  }
}
