/** A text of this size wants to stand over a point, or under it [pixels]. */
export interface Wanted {
  x: number;
  y: number;
  width: number;
  height: number;
  /** Those with a smaller one choose first. */
  rank: number;
  /** Its usual place is under the point. */
  under?: boolean;
}

/** Middle of a text [pixels]. */
export type Place = [x: number, y: number];

/** Steps from the usual place, over the point, to others near it: in widths and heights of the text. */
const STEPS: readonly Place[] = [
  [0, 0], [0, 1.9], [0.6, 0.95], [-0.6, 0.95], [0.6, 0], [-0.6, 0], [0, -1.1], [0.6, -1.1], [-0.6, -1.1], [0, 3], [1.1, 0.95], [-1.1, 0.95],
];

/** The same of a text under its point: further down first, so that several stand there in lines. */
const STEPS_UNDER: readonly Place[] = [
  [0, 0], [0, 1.1], [0.6, 0], [-0.6, 0], [0.6, 1.1], [-0.6, 1.1], [0, 2.2], [1.1, 0], [-1.1, 0], [0.6, -0.95], [-0.6, -0.95], [0, -1.9],
];

/** From a point to the middle of the text over it, in heights of the text. */
const OVER = 0.7;
const usualHeight = ({ y, height, under = false }: Wanted): number => y + (under ? OVER : -OVER) * height;
/** A part of the picture [pixels]. */
export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/**
 * A place for each text in a picture of this size so that none covers another and all of it is seen; undefined for those that find no free one near
 * their point. Under `covers`, which hang from the upper edge, nothing is seen; what is in `marks` is to be seen itself, where there is another place.
 */
export function spread(wanted: Wanted[], width: number, height: number, covers: Box[], marks: Box[] = []): (Place | undefined)[] {
  const places = new Array<Place | undefined>(wanted.length);
  const order = wanted.map((_, k) => k).sort((a, b) => (wanted[a] as Wanted).rank - (wanted[b] as Wanted).rank);
  const taken: { one: Wanted; place: Place }[] = [];
  for (const k of order) {
    const one = wanted[k] as Wanted;
    const near = ([dx, dy]: Place): Place => {
      const x = inside(one.x + dx * one.width, one.width, 0, width);
      return [x, inside(usualHeight(one) + dy * one.height, one.height, ceiling(x, one.width, covers), height)];
    };
    const free = (one.under ? STEPS_UNDER : STEPS).map(near).filter(([x, y]) => 2 * x + one.width <= 2 * width && 2 * y + one.height <= 2 * height && taken.every((other) => isFree(x, y, one, other)));
    const place = beside(marks, free, one);
    if (place === undefined) continue;
    places[k] = place;
    taken.push({ one, place });
  }
  return places;
}

/** From the edge of a text that is not at its usual place to its point: where the line begins, from the text's middle, and how it goes. */
export interface Leader {
  x: number;
  y: number;
  /** [pixels] */
  length: number;
  /** Clockwise from the right [rad]. */
  angle: number;
}

/** A text that is nearer to its point than this has no line to it, in heights of the text. */
const NEAR = 1;

/** The line from a text to its point; undefined where that is beside it. */
export function leaderOf({ x, y, width, height }: Wanted, [left, top]: Place): Leader | undefined {
  const dx = x - left, dy = y - top;
  const inside = Math.min(1, (0.5 * width) / Math.abs(dx), (0.5 * height) / Math.abs(dy));
  const length = (1 - inside) * Math.hypot(dx, dy);
  return length > NEAR * height ? { x: inside * dx, y: inside * dy, length, angle: Math.atan2(dy, dx) } : undefined;
}

/** The first of these places; where that covers a mark, the nearest of those that cover none, if there are any. */
function beside(marks: Box[], free: Place[], one: Wanted): Place | undefined {
  const isBeside = (at: Place): boolean => marks.every((mark) => isOff(at, one, mark));
  const [first] = free;
  if (first === undefined || isBeside(first)) return first;
  const way = ([x, y]: Place): number => Math.hypot(x - one.x, y - usualHeight(one));
  return free.filter(isBeside).sort((a, b) => way(a) - way(b))[0] ?? first;
}

/** The middle of a text nearest to `at` with which it does not go beyond `most`; where it can't but go beyond one of both, beyond `most`. */
function inside(at: number, size: number, least: number, most: number): number {
  return Math.max(least + 0.5 * size, Math.min(at, most - 0.5 * size));
}

/** Where the picture begins for a text with its middle at `x`. */
function ceiling(x: number, width: number, covers: Box[]): number {
  return Math.max(0, ...covers.filter(({ left, right }) => 2 * x - width < 2 * right && 2 * x + width > 2 * left).map(({ bottom }) => bottom));
}

function isOff([x, y]: Place, { width, height }: Wanted, { left, right, top, bottom }: Box): boolean {
  return 2 * x + width <= 2 * left || 2 * x - width >= 2 * right || 2 * y + height <= 2 * top || 2 * y - height >= 2 * bottom;
}

function isFree(x: number, y: number, { width, height }: Wanted, { one, place }: { one: Wanted; place: Place }): boolean {
  return 2 * Math.abs(x - place[0]) >= width + one.width || 2 * Math.abs(y - place[1]) >= height + one.height;
}
