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
