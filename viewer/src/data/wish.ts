/** How long a wish stands for what is, unless it comes true before [ms]. */
export const WISH_LASTS = 2000;

/** What was last asked for: it counts until the program says the same, or doesn't for a while. */
export class Wish<T> {
  private wanted: T | undefined;
  private asked = -Infinity;

  constructor(private readonly clock: () => number = () => performance.now()) {}

  ask(value: T): void {
    this.wanted = value;
    this.asked = this.clock();
  }

  drop(): void {
    this.wanted = undefined;
  }

  /** The wish while it stands, otherwise what `is`; `held`: it can't come true yet, and stands meanwhile. */
  or<U>(is: T | U, held = false): T | U {
    if (this.wanted === undefined) return is;
    if (held) this.asked = this.clock();
    const late = this.clock() - this.asked > WISH_LASTS;
    if (late || JSON.stringify(is) === JSON.stringify(this.wanted)) this.wanted = undefined;
    return this.wanted ?? is;
  }
}
