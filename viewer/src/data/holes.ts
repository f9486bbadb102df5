/** Ticks `first` to `end - 1`. */
export interface Stretch {
  first: number;
  end: number;
}

/** Stretches of a run's ticks that did not come, in their order. */
export class Holes {
  private stretches: Stretch[] = [];

  /** Behind all that are known. */
  add(first: number, end: number): void {
    this.stretches.push({ first, end });
  }

  clear(): void {
    this.stretches = [];
  }

  /** What is before this tick is too old. */
  forget(before: number): void {
    while (this.stretches[0] !== undefined && this.stretches[0].end <= before) this.stretches.shift();
  }

  /** Of what is missing in [from, to) the last piece of at most so many ticks; it is no hole any more. */
  take(from: number, to: number, most: number): Stretch | undefined {
    const at = this.stretches.findLastIndex(({ first, end }) => first < to && end > from);
    const hole = this.stretches[at];
    if (hole === undefined) return undefined;
    const end = Math.min(hole.end, Math.max(Math.ceil(to), hole.first + most));
    const piece = { first: Math.max(hole.first, end - most), end };
    const rest = [{ first: hole.first, end: piece.first }, { first: end, end: hole.end }];
    this.stretches.splice(at, 1, ...rest.filter((one) => one.first < one.end));
    return piece;
  }

  /** It did not come this time either. */
  giveBack(piece: Stretch): void {
    this.stretches = [...this.stretches, piece].sort((a, b) => a.first - b.first);
  }
}
