/** How a plot's line is drawn; the colour by the name of its variable in the style sheet. */
export interface LineStyle {
  colour: string;
  /** Lengths of dashes and gaps [pixels]; none: a line without gaps. */
  dash: number[];
}

/** The first four are those of the legs in the picture. */
const COLOURS = ["--c0", "--c1", "--c2", "--c3", "--c5", "--soft"];
const DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3]];

/** More lines than these can't be told apart. */
export const MOST_LINES = COLOURS.length * DASHES.length;

const style = (colour: number, dash: number): LineStyle => ({ colour: COLOURS[colour] as string, dash: DASHES[dash] as number[] });

/** Styles of lines of which no two are the same. Where all belong to legs, by their numbers, and to several of them, each leg has its colour,
 * and dashes tell its lines apart; otherwise each line has its colour for as long as there are any. */
export function stylesOf(legs: (number | undefined)[]): LineStyle[] {
  const before = legs.map((leg, k) => legs.slice(0, k).filter((other) => other === leg).length);
  const byLeg = new Set(legs).size > 1 && !legs.includes(undefined) && Math.max(...before) < DASHES.length;
  if (byLeg) return legs.map((leg, k) => style(leg as number, before[k] as number));
  return legs.map((_, k) => style(k % COLOURS.length, Math.floor(k / COLOURS.length) % DASHES.length));
}
