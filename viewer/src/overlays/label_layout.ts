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
/** Size of what lies over the picture in its upper left corner: under it nothing is seen [pixels]. */
export interface Corner {
  width: number;
  height: number;
}

/** A place for each text in a picture of this size so that none covers another and all of it is seen; undefined for those that find no free one near their point. */
export function spread(wanted: Wanted[], width: number, height: number, corner: Corner): (Place | undefined)[] {
  const places = new Array<Place | undefined>(wanted.length);
  const order = wanted.map((_, k) => k).sort((a, b) => (wanted[a] as Wanted).rank - (wanted[b] as Wanted).rank);
  const taken: { one: Wanted; place: Place }[] = [];
  for (const k of order) {
    const one = wanted[k] as Wanted;
    const near = ([dx, dy]: Place): Place => {
      const x = inside(one.x + dx * one.width, one.width, 0, width);
      return [x, inside(one.y + (dy - OVER) * one.height, one.height, 2 * x - one.width < 2 * corner.width ? corner.height : 0, height)];
    };
    const place = STEPS.map(near).find(([x, y]) => 2 * x + one.width <= 2 * width && 2 * y + one.height <= 2 * height && taken.every((other) => isFree(x, y, one, other)));
    if (place === undefined) continue;
    places[k] = place;
    taken.push({ one, place });
  }
  return places;
}

/** The middle of a text nearest to `at` with which it does not go beyond `most`; where it can't but go beyond one of both, beyond `most`. */
function inside(at: number, size: number, least: number, most: number): number {
  return Math.max(least + 0.5 * size, Math.min(at, most - 0.5 * size));
}

function isFree(x: number, y: number, { width, height }: Wanted, { one, place }: { one: Wanted; place: Place }): boolean {
  return 2 * Math.abs(x - place[0]) >= width + one.width || 2 * Math.abs(y - place[1]) >= height + one.height;
}
