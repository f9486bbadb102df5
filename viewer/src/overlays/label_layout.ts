/** A text to be placed over or under a point [pixels]. */
export interface Wanted {
  x: number;
  y: number;
  width: number;
  height: number;
  /** Smaller ranks are placed first. */
  rank: number;
  /** Its usual place is under the point. */
  under?: boolean;
}

/** Middle of a text [pixels]. */
export type Place = [x: number, y: number];

/** Offsets from the usual place over the point, in widths and heights of the text. */
const STEPS: readonly Place[] = [
  [0, 0], [0, 1.9], [0.6, 0.95], [-0.6, 0.95], [0.6, 0], [-0.6, 0], [0, -1.1], [0.6, -1.1], [-0.6, -1.1], [0, 3], [1.1, 0.95], [-1.1, 0.95],
];

/** The same for a text under its point: downwards first, so that several stack. */
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
 * Places texts in a picture of this size so that none overlaps another or leaves the picture; undefined: no free place near the point.
 * `covers` hang from the upper edge and hide texts. `marks` are kept free where possible.
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
    const place = pickPlace(marks, free, one);
    if (place === undefined) continue;
    places[k] = place;
    taken.push({ one, place });
  }
  return places;
}

/** A line from a text's edge to its point; x and y from the text's middle [pixels]. */
export interface Leader {
  x: number;
  y: number;
  /** [pixels] */
  length: number;
  /** Clockwise from the right [rad]. */
  angle: number;
}

/** A text nearer to its point than this needs no line, in heights of the text. */
const NEAR = 1;

/** The line from a text to its point; undefined where the text is near enough. */
export function leaderOf({ x, y, width, height }: Wanted, [left, top]: Place): Leader | undefined {
  const dx = x - left, dy = y - top;
  const inside = Math.min(1, (0.5 * width) / Math.abs(dx), (0.5 * height) / Math.abs(dy));
  const length = (1 - inside) * Math.hypot(dx, dy);
  return length > NEAR * height ? { x: inside * dx, y: inside * dy, length, angle: Math.atan2(dy, dx) } : undefined;
}

/** The first place; if it covers a mark, the nearest place that covers none, if there is one. */
function pickPlace(marks: Box[], free: Place[], one: Wanted): Place | undefined {
  const isClear = (at: Place): boolean => marks.every((mark) => isOff(at, one, mark));
  const [first] = free;
  if (first === undefined || isClear(first)) return first;
  const way = ([x, y]: Place): number => Math.hypot(x - one.x, y - usualHeight(one));
  return free.filter(isClear).sort((a, b) => way(a) - way(b))[0] ?? first;
}

/** Moves the middle of a text into [least, most]; a text that is too large exceeds `most`. */
function inside(at: number, size: number, least: number, most: number): number {
  return Math.max(least + 0.5 * size, Math.min(at, most - 0.5 * size));
}

/** Upper edge of the free picture for a text with its middle at `x`. */
function ceiling(x: number, width: number, covers: Box[]): number {
  return Math.max(0, ...covers.filter(({ left, right }) => 2 * x - width < 2 * right && 2 * x + width > 2 * left).map(({ bottom }) => bottom));
}

function isOff([x, y]: Place, { width, height }: Wanted, { left, right, top, bottom }: Box): boolean {
  return 2 * x + width <= 2 * left || 2 * x - width >= 2 * right || 2 * y + height <= 2 * top || 2 * y - height >= 2 * bottom;
}

function isFree(x: number, y: number, { width, height }: Wanted, { one, place }: { one: Wanted; place: Place }): boolean {
  return 2 * Math.abs(x - place[0]) >= width + one.width || 2 * Math.abs(y - place[1]) >= height + one.height;
}
