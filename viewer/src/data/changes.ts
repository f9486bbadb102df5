/** Something that was changed from outside. */
export interface Change {
  time: number;
  text: string;
}

/** What was changed in a run, told twice: each change as it comes to effect, and all so far where one asks. Either may come first; the
 * same change twice at one time is two. */
export class Changes {
  all: Change[] = [];
  /** Those that were asked for and may still be told by themselves. */
  private unheard: Change[] = [];

  /** `most`: as many as are kept, the latest. */
  constructor(private readonly most: number) {}

  hear(change: Change): void {
    if (!takeOut(this.unheard, change)) this.keep([...this.all, change]);
  }

  recall(told: Change[]): void {
    const known = [...this.all];
    const more = told.filter((change) => !takeOut(known, change));
    this.unheard.push(...more);
    this.keep([...more, ...this.all].sort((a, b) => a.time - b.time));
  }

  clear(): void {
    this.all = [];
    this.unheard = [];
  }

  private keep(changes: Change[]): void {
    this.all = changes.slice(-this.most);
  }
}

/** What is steered by a key again and again is one change, told as it ended: those that follow each other within this [s]. */
const ONE_STEERING = 1;
const STEERED = /^the operator commands: /;

/** The changes without those that the next one makes old. */
export function folded(changes: readonly Change[]): Change[] {
  return changes.filter(({ time, text }, k) => {
    const next = changes[k + 1];
    return next === undefined || next.time - time > ONE_STEERING || !STEERED.test(text) || !STEERED.test(next.text);
  });
}

/** Whether the change was among these; it is not any more. */
function takeOut(changes: Change[], { time, text }: Change): boolean {
  const at = changes.findIndex((one) => one.time === time && one.text === text);
  if (at >= 0) changes.splice(at, 1);
  return at >= 0;
}
