/** Shortest time between two announcements, in which one can be read out [ms]. */
const PERIOD = 3000;

/** Announces changes to screen readers, and skips those that are over before they could be read out. */
export class Announcer {
  private said = "";
  private at = -Infinity;

  constructor(private readonly say: (text: string) => void) {}

  /** Called regularly with the present state; `now` [ms]. */
  tell(text: string, now: number): void {
    if (text === this.said || now - this.at < PERIOD) return;
    this.said = text;
    this.at = now;
    this.say(text);
  }
}
