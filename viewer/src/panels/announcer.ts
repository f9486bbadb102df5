/** What is new is said no more often than this, in which it can be read out [ms]. */
const PERIOD = 3000;

/** Says to screen readers what has changed: of what changes faster than it can be read out, only how it is then. */
export class Announcer {
  private said = "";
  private at = -Infinity;

  constructor(private readonly say: (text: string) => void) {}

  /** Called again and again with how it is; `now` [ms]. */
  tell(text: string, now: number): void {
    if (text === this.said || now - this.at < PERIOD) return;
    this.said = text;
    this.at = now;
    this.say(text);
  }
}
