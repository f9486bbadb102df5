/** A picture that keeps the browser busy for less than this needs no rest behind it [ms]. */
const QUICK = 40;
/** Longer than this was no picture, but a machine that slept [ms]. */
const SLEPT = 3000;
/** No rest is longer than this [ms]. */
const LONGEST_REST = 1000;

/**
 * When the next picture may be drawn. While the processor draws one the page hears nothing: where that takes long, as long
 * a rest comes behind it, for what the program sends and for the run itself, which share the machine.
 */
export class Pace {
  /** How long the last picture kept the browser busy [ms]. */
  took = NaN;
  private drawn = NaN;
  private ready = -Infinity;

  /** `page`: says when it is hidden or seen again; no picture comes while it is hidden, however quick they are. */
  constructor(page?: EventTarget) {
    page?.addEventListener("visibilitychange", () => {
      this.drawn = NaN;
      this.ready = -Infinity;
    });
  }

  /** At the beginning of a frame at `now` [ms]: whether a picture may be drawn. */
  begin(now: number): boolean {
    if (!Number.isNaN(this.drawn)) {
      const took = now - this.drawn;
      this.drawn = NaN;
      if (took < SLEPT) this.took = took;
      this.ready = took > QUICK && took < SLEPT ? now + restAfter(took) : now;
    }
    return now >= this.ready;
  }

  /** A picture was drawn in the frame that began at `now` [ms]. */
  drew(now: number): void {
    this.drawn = now;
  }

  /** From a picture to the next, with the rest [ms]. */
  get period(): number {
    return this.took > QUICK ? this.took + restAfter(this.took) : this.took;
  }
}

function restAfter(took: number): number {
  return Math.min(took, LONGEST_REST);
}
