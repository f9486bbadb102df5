const minus = (text: string): string => text.replace("-", "−");

/** With so many decimals; 0 has no sign. */
export function fixed(value: number, decimals: number): string {
  return minus(value.toFixed(decimals).replace(/^-(?=[0.]*$)/, ""));
}

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function withPower(value: number): string {
  const [factor = "", power = ""] = value.toExponential(1).split("e");
  const raised = power.replace("+", "").replace("-", "⁻").replace(/\d/g, (digit) => RAISED[Number(digit)] ?? "");
  return `${minus(factor)}·10${raised}`;
}

/** Two to four significant digits; very small and large numbers as powers of ten. */
export function digits(value: number): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-6 || size >= 1e7) return withPower(value);
  const decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : size >= 1e-3 ? 3 : 1 - Math.floor(Math.log10(Number(size.toPrecision(2))));
  return minus(value.toFixed(decimals));
}

/** Smaller values are round-off. */
const ROUND_OFF = 1e-9;

export function withoutRoundOff(value: number): number {
  return Math.abs(value) < ROUND_OFF ? 0 : value;
}

/** Smaller lengths, angles, forces and derived quantities are shown as 0. */
const LEAST_SEEN = 1e-6;
const MECHANICAL = /^(m|rad|N)(?!\p{L})/u;

/** A value in this unit; 0 where it is negligible. */
export function seen(value: number, unit: string): number {
  return MECHANICAL.test(unit) && Math.abs(value) < LEAST_SEEN ? 0 : withoutRoundOff(value);
}

export function quantity(value: number, unit: string): string {
  return unit === "" ? digits(value) : `${digits(value)} ${unit}`;
}

/** A time of the run, as in the terminal and in exports; exact for ticks of 400 Hz and 1 kHz. */
export function secondsText(time: number): string {
  return `${time.toFixed(4)} s`;
}

/** "1 row", "2 rows". */
export function counted(count: number, what: string): string {
  return `${count} ${what}${count === 1 ? "" : "s"}`;
}
