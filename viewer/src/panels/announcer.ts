/** Shortest time between two announcements, in which one can be read out [ms]. */
const PERIOD = 3000;

/** Announces changes to screen readers, and skips those that are over before they could be read out. */
export class Announcer {
  private announced = "";
  private at = -Infinity;

  constructor(private readonly announce: (text: string) => void) {}

  /** Called regularly with the present state; `now` [ms]. */
  update(text: string, now: number): void {
    if (text === this.announced || now - this.at < PERIOD) return;
    this.announced = text;
    this.at = now;
    this.announce(text);
  }
}
