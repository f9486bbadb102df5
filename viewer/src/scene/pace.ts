/** A picture that keeps the browser busy for less than this needs no rest [ms]. */
const QUICK = 40;
/** A longer interval means that the machine slept [ms]. */
const SLEPT = 3000;
/** Longest rest [ms]. */
const LONGEST_REST = 1000;

/**
 * Decides when the next picture may be drawn. While the processor draws, the page receives nothing. A slow picture is therefore followed by a rest of
 * the same length, for received data and for the run on the same machine.
 */
export class Pace {
  /** How long the last picture kept the browser busy [ms]. */
  took = NaN;
  private drawn = NaN;
  private ready = -Infinity;

  /** `page`: reports when it is hidden or visible; a hidden page draws nothing, which is not slowness. */
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
