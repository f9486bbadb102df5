/** Style of a plot's line; the colour is a variable of the style sheet. */
export interface LineStyle {
  colour: string;
  /** Lengths of dashes and gaps [pixels]; none: a solid line. */
  dash: number[];
}

const LEG_COLOURS = ["--c0", "--c1", "--c2", "--c3", "--c4", "--c5"];
const COLOURS = ["--c0", "--c1", "--c2", "--c3", "--c6", "--soft"];
const DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3]];

/** Number of distinct styles. */
export const MOST_LINES = COLOURS.length * DASHES.length;

const style = (colour: number, dash: number, colours = COLOURS): LineStyle => ({ colour: colours[colour] as string, dash: DASHES[dash] as number[] });

/** Distinct styles for lines with these legs. If all lines belong to legs, and to several, each leg has its colour and its lines differ by dashes;
 * otherwise lines differ by colour first. */
export function stylesOf(legs: (number | undefined)[]): LineStyle[] {
  const before = legs.map((leg, k) => legs.slice(0, k).filter((other) => other === leg).length);
  const byLeg = new Set(legs).size > 1 && !legs.includes(undefined) && Math.max(...before) < DASHES.length;
  if (byLeg) return legs.map((leg, k) => style(leg as number, before[k] as number, LEG_COLOURS));
  return legs.map((_, k) => style(k % COLOURS.length, Math.floor(k / COLOURS.length) % DASHES.length));
}
