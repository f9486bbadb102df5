/** Finds, in the generations that the program tells, where a run that was reset begins. */
export class Generations {
  private newest = -1;
  private oldest = -1;
  private awaited = false;

  /** A reset was asked for: the next generation is the new run's. */
  awaitReset(): void {
    this.awaited = true;
  }

  /** The reset was refused. */
  stay(): void {
    this.awaited = false;
  }

  /** Whether the awaited run begins with this generation. */
  begins(generation: number): boolean {
    const rises = this.newest >= 0 && generation > this.newest;
    this.newest = generation;
    if (!rises || !this.awaited) return false;
    this.awaited = false;
    this.oldest = generation;
    return true;
  }

  /** Whether frames of this generation are of the run before the reset. */
  isOld(generation: number): boolean {
    return generation < this.oldest;
  }

  /** Another program counts anew. */
  clear(): void {
    this.newest = this.oldest = -1;
    this.awaited = false;
  }
}
