/** A pull is renewed this often, and lasts at least this long [ms]; the server ends one that is older than 1.5 s, so that a slow picture does not. */
const RENEWAL = 60;
/** Less than this is none yet [N]. */
const WORTH = 0.5;

/** When a pull is sent, from the moment the robot is held until it is let go: at once, again and again, however short it is. */
export class Grip {
  private readonly timer: ReturnType<typeof setInterval>;
  private acts = false;
  private lasted = true;
  private open = true;
  private released = false;

  constructor(
    private readonly force: () => number[],
    private readonly send: (force: number[]) => void,
    /** Whether the robot may still be pulled. */
    private readonly allowed: () => boolean,
    /** It is no longer allowed. */
    private readonly onRefused: () => void,
  ) {
    this.timer = setInterval(() => this.renew(), RENEWAL);
  }

  /** The pointer moved: the first force that is worth the name is not waited for. */
  moved(): void {
    if (!this.acts) this.renew();
  }

  private renew(): void {
    if (!this.open) return; // let go while this call was on its way
    if (!this.allowed()) return this.onRefused();
    const force = this.force();
    this.send(force);
    if (this.acts || Math.hypot(...force) < WORTH) return;
    this.acts = true;
    this.lasted = false;
    setTimeout(() => {
      this.lasted = true;
      if (!this.open) this.release();
    }, RENEWAL);
  }

  /** Lets go; a pull that began only just now lasts as long as one renewal. */
  end(): void {
    if (!this.open) return;
    this.open = false;
    clearInterval(this.timer);
    if (this.lasted) this.release();
  }

  /** Another pull begins in the place of this one, which may still last. */
  drop(): void {
    this.released = true;
  }

  private release(): void {
    if (!this.released) this.send([0, 0, 0]);
    this.released = true;
  }
}
