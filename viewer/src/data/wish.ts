/** How long a wish is shown instead of the state [ms]. */
export const WISH_LASTS = 2000;

/** The last request: shown until the program reports the same, or for a while. */
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

  /** The wish while it lasts, otherwise `is`; `held`: it can't take effect yet, and lasts meanwhile. */
  or<U>(is: T | U, held = false): T | U {
    if (this.wanted === undefined) return is;
    if (held) this.asked = this.clock();
    const late = this.clock() - this.asked > WISH_LASTS;
    if (late || JSON.stringify(is) === JSON.stringify(this.wanted)) this.wanted = undefined;
    return this.wanted ?? is;
  }
}
