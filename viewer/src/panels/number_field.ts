import { Wish } from "../data/wish.ts";
import { h } from "./dom.ts";

/** The number in a field; undefined where it is empty or no number. */
export function numberIn(text: string): number | undefined {
  const value = text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : undefined;
}

/** The field's number; where it has none, the field gets `kept`. */
export function takeNumber(input: Pick<HTMLInputElement, "value">, kept: number): number | undefined {
  const value = numberIn(input.value);
  if (value === undefined) input.value = String(kept);
  return value;
}

export interface NumberFieldActions {
  /** Sends a number; the field drops its wish if that is refused. */
  ask: (value: number, field: NumberField) => void;
  /** The input was no number; the field has its old text again. */
  reject: (kept: string) => void;
}

/** A number of the run. It keeps what is being typed, and what was sent until it takes effect or is refused. */
export class NumberField {
  readonly input: HTMLInputElement;
  private readonly wish = new Wish<number>();
  /** Present number of the run. */
  private now = NaN;
  /** Last text that the page wrote. */
  private written = "";

  constructor(attributes: Record<string, string | number>, private readonly actions: NumberFieldActions) {
    this.input = h("input", { type: "number", ...attributes, onchange: () => this.take() });
  }

  private take(): void {
    const value = takeNumber(this.input, this.now);
    this.written = this.input.value;
    if (value === undefined) return this.actions.reject(this.written);
    this.wish.ask(value);
    this.actions.ask(value, this);
  }

  /** Shows the present number of the run. */
  show(now: number): void {
    this.now = now;
    this.refresh();
  }

  /** `held`: changes can't take effect yet. */
  refresh(held = false): void {
    const typing = document.activeElement === this.input && this.input.value !== this.written;
    if (!typing) this.write(this.wish.or(this.now, held));
  }

  /** Drops the wish. */
  drop(): void {
    this.wish.drop();
    this.write(this.now);
  }

  private write(value: number): void {
    this.written = String(value);
    if (this.input.value !== this.written) this.input.value = this.written;
  }
}
