/** A text of this size wants to stand over a point [pixels]. */
export interface Wanted {
  x: number;
  y: number;
  width: number;
  height: number;
  /** Those with a smaller one choose first. */
  rank: number;
}

/** Middle of a text [pixels]. */
export type Place = [x: number, y: number];

/** Steps from the usual place, over the point, to others near it: in widths and heights of the text. */
const STEPS: readonly Place[] = [
  [0, 0], [0, 1.9], [0.6, 0.95], [-0.6, 0.95], [0.6, 0], [-0.6, 0], [0, -1.1], [0.6, -1.1], [-0.6, -1.1], [0, 3], [1.1, 0.95], [-1.1, 0.95],
];

/** From a point to the middle of the text over it, in heights of the text. */
const OVER = 0.7;

/** A place for each text so that none covers another; undefined for those that find no free one near their point. */
export function spread(wanted: Wanted[]): (Place | undefined)[] {
  const places = new Array<Place | undefined>(wanted.length);
  const order = wanted.map((_, k) => k).sort((a, b) => (wanted[a] as Wanted).rank - (wanted[b] as Wanted).rank);
  const taken: { one: Wanted; place: Place }[] = [];
  for (const k of order) {
    const one = wanted[k] as Wanted;
    const place = STEPS.map(([dx, dy]): Place => [one.x + dx * one.width, one.y + (dy - OVER) * one.height])
      .find(([x, y]) => taken.every((other) => isFree(x, y, one, other)));
    if (place === undefined) continue;
    places[k] = place;
    taken.push({ one, place });
  }
  return places;
}

function isFree(x: number, y: number, { width, height }: Wanted, { one, place }: { one: Wanted; place: Place }): boolean {
  return 2 * Math.abs(x - place[0]) >= width + one.width || 2 * Math.abs(y - place[1]) >= height + one.height;
}
